#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrip {

/// Vertices by key, least first; equal keys by vertex. Keys are non-negative. A heap of four
/// children a node: half the cache misses of two.
class VertexHeap {
 public:
  /// Takes the vertices whose key is finite.
  explicit VertexHeap(std::span<const float> keys) : place_(keys.size(), kNone) {
    for (Index v = 0; v < keys.size(); ++v)
      if (keys[v] < std::numeric_limits<float>::infinity()) {
        place_[v] = static_cast<Index>(nodes_.size());
        nodes_.push_back(node(v, keys[v]));
      }
    for (Index i = size() / 4 + 1; i-- > 0;)
      if (i < size()) sink(i, nodes_[i]);
  }

  bool empty() const { return nodes_.empty(); }
  Index top() const { return vertex_of(nodes_[0]); }
  float top_key() const { return key_of(nodes_[0]); }
  /// The least key but the top's; infinity when there is none.
  float second_key() const {
    std::uint64_t least = node(0, std::numeric_limits<float>::infinity());
    for (Index i = 1; i < 5 && i < size(); ++i) least = std::min(least, nodes_[i]);
    return key_of(least);
  }

  bool contains(Index vertex) const { return place_[vertex] != kNone; }
  float key(Index vertex) const { return key_of(nodes_[place_[vertex]]); }

  /// Precondition: not contains(vertex), finite key.
  void insert(Index vertex, float key) {
    nodes_.push_back(0);
    rise(size() - 1, node(vertex, key));
  }
  /// Precondition: contains(vertex).
  void update(Index vertex, float key) {
    const Index i = place_[vertex];
    const std::uint64_t moved = node(vertex, key);
    if (moved < nodes_[i])
      rise(i, moved);
    else
      sink(i, moved);
  }
  void remove(Index vertex) {
    const Index i = place_[vertex];
    place_[vertex] = kNone;
    const std::uint64_t last = nodes_.back();
    nodes_.pop_back();
    if (i == size()) return;
    if (i > 0 && last < nodes_[(i - 1) / 4])
      rise(i, last);
    else
      sink(i, last);
  }

 private:
  // The bits of a non-negative float order as it does, so a node compares as one number.
  static std::uint64_t node(Index vertex, float key) {
    assert(key >= 0);
    return std::uint64_t{std::bit_cast<std::uint32_t>(key)} << 32 | vertex;
  }
  static Index vertex_of(std::uint64_t node) { return static_cast<Index>(node); }
  static float key_of(std::uint64_t node) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(node >> 32));
  }
  Index size() const { return static_cast<Index>(nodes_.size()); }

  void put(Index i, std::uint64_t node) {
    nodes_[i] = node;
    place_[vertex_of(node)] = i;
  }
  void rise(Index i, std::uint64_t node) {
    for (; i > 0 && node < nodes_[(i - 1) / 4]; i = (i - 1) / 4) put(i, nodes_[(i - 1) / 4]);
    put(i, node);
  }
  void sink(Index i, std::uint64_t node) {
    for (;;) {
      const std::uint64_t first = std::uint64_t{4} * i + 1;
      if (first >= size()) break;
      Index least = static_cast<Index>(first);
      const Index end = static_cast<Index>(std::min<std::uint64_t>(first + 4, size()));
      for (Index k = least + 1; k < end; ++k) least = nodes_[k] < nodes_[least] ? k : least;
      if (nodes_[least] >= node) break;
      put(i, nodes_[least]);
      i = least;
    }
    put(i, node);
  }

  std::vector<std::uint64_t> nodes_;
  std::vector<Index> place_;
};

}  // namespace pstrip
