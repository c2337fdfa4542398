#include "formats/ply/ply_wedges.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/group_by.h"

namespace pstrips::inline formats::ply {
namespace {

class WedgeBuilder {
 public:
  WedgeBuilder(std::size_t corners, ByteView pairs, std::size_t pair_bytes)
      : pairs_(pairs), pair_bytes_(pair_bytes) {
    out_.corners.resize(corners);
  }

  void add_vertex(Index vertex, std::span<const Index> corners) {
    constexpr std::size_t kFewCorners = 32;  // comparing all is quicker than sorting
    if (corners.empty()) {
      out_.wedge_vertex.push_back(vertex);
      out_.pairs.resize(out_.pairs.size() + pair_bytes_);
    } else if (corners.size() <= kFewCorners) {
      compare_all(vertex, corners);
    } else {
      sort_first(vertex, corners);
    }
  }
  CornerWedges take() && { return std::move(out_); }

 private:
  int compare(Index a, Index b) const {
    return std::memcmp(&pairs_[a * pair_bytes_], &pairs_[b * pair_bytes_], pair_bytes_);
  }
  void new_wedge(Index vertex, Index corner) {
    out_.corners[corner] = static_cast<Index>(out_.wedge_vertex.size());
    out_.wedge_vertex.push_back(vertex);
    const ByteView pair = pairs_.subspan(corner * pair_bytes_, pair_bytes_);
    out_.pairs.insert(out_.pairs.end(), pair.begin(), pair.end());
  }

  void compare_all(Index vertex, std::span<const Index> corners) {
    std::size_t distinct = 0;
    Index firsts[32];
    for (const Index corner : corners) {
      const Index* const same =
          std::find_if(firsts, firsts + distinct, [&](Index f) { return compare(f, corner) == 0; });
      if (same != firsts + distinct) {
        out_.corners[corner] = out_.corners[*same];
        continue;
      }
      firsts[distinct++] = corner;
      new_wedge(vertex, corner);
    }
  }

  void sort_first(Index vertex, std::span<const Index> corners) {
    sorted_.assign(corners.begin(), corners.end());
    std::ranges::sort(sorted_, [&](Index a, Index b) {
      const int order = compare(a, b);
      return order != 0 ? order < 0 : a < b;
    });
    // Each corner first learns the first corner of its pair; that one is then met before it.
    for (std::size_t i = 0, start = 0; i < sorted_.size(); ++i) {
      if (compare(sorted_[start], sorted_[i]) != 0) start = i;
      out_.corners[sorted_[i]] = sorted_[start];
    }
    for (const Index corner : corners) {
      const Index first = out_.corners[corner];
      if (first == corner)
        new_wedge(vertex, corner);
      else
        out_.corners[corner] = out_.corners[first];
    }
  }

  ByteView pairs_;
  std::size_t pair_bytes_;
  CornerWedges out_;
  std::vector<Index> sorted_;
};

}  // namespace

CornerWedges wedges_of_corners(std::span<const Index> corner_vertices, Index vertex_count,
                               ByteView pairs, std::size_t pair_bytes) {
  assert(pairs.size() == corner_vertices.size() * pair_bytes);
  const Grouped<Index> by_vertex =
      group_by(vertex_count, corner_vertices.size(), [&](Index c) { return corner_vertices[c]; });
  WedgeBuilder builder(corner_vertices.size(), pairs, pair_bytes);
  for (Index v = 0; v < vertex_count; ++v) builder.add_vertex(v, by_vertex[v]);
  return std::move(builder).take();
}

}  // namespace pstrips::inline formats::ply
