#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// Vertices to be looked at by key, least first, in steps of about 5 %: of each step by index,
/// those that join it while it is worked through last. What comes next is known well in advance, so
/// that its data can be fetched.
///
/// Keys are non-negative. A vertex is in once; one whose key falls below the present step joins it.
/// Cost O(1) each but for sorting the steps.
class VertexBuckets {
 public:
  /// Takes the vertices whose key is finite.
  explicit VertexBuckets(std::span<const float> keys)
      : bucket_(keys.size(), kNowhere), lists_(kBuckets) {
    for (Index v = 0; v < keys.size(); ++v)
      if (keys[v] < std::numeric_limits<float>::infinity()) put(v, keys[v]);
  }

  /// Takes the next vertex out; kNone when there is none.
  Index pop();
  /// The vertex that comes so many places after the one popped last, kNone past the end of the
  /// step; it may have left since.
  Index ahead(std::size_t places) const {
    return at_ + places <= batch_.size() ? batch_[at_ + places - 1] : kNone;
  }
  /// The greatest key of the step that the vertex popped last belongs to.
  float limit() const { return std::bit_cast<float>(((now_ + 1) << kShift) - 1); }
  /// The greatest key of the step that a finite key belongs to.
  static float limit_of(float key) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(key) | ((1u << kShift) - 1));
  }

  /// Puts a vertex in, or gives it another key. Precondition: finite key.
  void put(Index vertex, float key);
  void remove(Index vertex) { bucket_[vertex] = kNowhere; }

 private:
  // The bits of a non-negative float order as it does. Of the mantissa four are left.
  static constexpr std::uint32_t kShift = 19;
  static constexpr std::uint32_t kBuckets = 0x7f80'0000u >> kShift;
  static constexpr std::uint16_t kNowhere = 0xffff;
  struct List {
    Index first = kNone, last = kNone;  // blocks
    Index size = 0;
  };
  struct Block {
    static constexpr Index kSize = 31;
    Index next = kNone;
    Index vertices[kSize];
  };

  Index new_block();
  void take_list(List& list);

  std::vector<std::uint16_t> bucket_;  // of each vertex; entries of other buckets are out of date
  std::vector<List> lists_;
  std::vector<Block> blocks_;
  Index free_ = kNone;  // first block not in use
  std::uint32_t now_ = 0;
  std::vector<Index> batch_;  // bucket now_, once it is worked through
  std::size_t at_ = 0;        // how many of it have been popped
  bool started_ = false;
};

inline Index VertexBuckets::pop() {
  started_ = true;
  for (;;) {
    while (at_ < batch_.size()) {
      const Index vertex = batch_[at_++];
      if (bucket_[vertex] != now_) continue;
      bucket_[vertex] = kNowhere;
      return vertex;
    }
    std::uint32_t next = now_;
    while (next < kBuckets && lists_[next].size == 0) ++next;
    if (next == kBuckets) return kNone;
    now_ = next;
    take_list(lists_[now_]);
  }
}

inline void VertexBuckets::put(Index vertex, float key) {
  assert(key >= 0 && key < std::numeric_limits<float>::infinity());
  const std::uint32_t bucket = std::max(std::bit_cast<std::uint32_t>(key) >> kShift, now_);
  if (bucket_[vertex] == bucket) return;
  bucket_[vertex] = static_cast<std::uint16_t>(bucket);
  if (started_ && bucket == now_) {
    batch_.push_back(vertex);
    return;
  }
  List& list = lists_[bucket];
  if (list.size % Block::kSize == 0) {
    const Index block = new_block();
    (list.size == 0 ? list.first : blocks_[list.last].next) = block;
    list.last = block;
  }
  blocks_[list.last].vertices[list.size++ % Block::kSize] = vertex;
}

inline Index VertexBuckets::new_block() {
  if (free_ == kNone) {
    blocks_.emplace_back();
    return static_cast<Index>(blocks_.size() - 1);
  }
  return std::exchange(free_, blocks_[free_].next);
}

inline void VertexBuckets::take_list(List& list) {
  batch_.clear();
  at_ = 0;
  Index block = list.first;
  for (Index left = list.size; left > 0;) {
    const Index n = std::min(left, Block::kSize);
    for (const Index v : std::span(blocks_[block].vertices).first(n))
      if (bucket_[v] == now_) batch_.push_back(v);
    left -= n;
    const Index next = std::exchange(blocks_[block].next, free_);
    free_ = std::exchange(block, next);
  }
  list = {};
  std::ranges::sort(batch_);
}

}  // namespace pstrips::inline codecs
