#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#include <vector>

#include "core/joined_faces.h"
#include "formats/pstrip/payload/compact/split_models.h"
#include "formats/pstrip/payload/compact/wedge_code.h"

// For formats/pstrip/payload/compact: the face table, once for writing and for reading. Polygons
// are joins of triangles, a bit a pair of neighbours; other faces are listed. [spec/compact.md §11]

namespace pstrips::inline formats {

/// Whether each two neighbours are of one polygon, breadth first, so that what is known of the
/// triangles around tells most bits.
template <class Coder>
class JoinCode {
 public:
  /// opposite  of each half-edge [pair_half_edges()]
  /// joined    to write; a reader joins
  JoinCode(Coder& coder, std::span<const Index> opposite, JoinedFaces& joined)
      : coder_(coder),
        opposite_(opposite),
        joined_(joined),
        triangles_(opposite.size() / 3),
        part_(triangles_.size()) {
    std::iota(part_.begin(), part_.end(), Index{0});
    for (Index h = 0; h < opposite.size(); ++h)
      if (opposite[h] != kNone) ++triangles_[h / 3].open;
  }

  /// cost  O(triangles)
  void run() {
    std::vector<Index> queue;
    queue.reserve(triangles_.size());
    for (Index seed = 0; seed < triangles_.size(); ++seed) {
      reach(seed, queue);
      for (; next_ < queue.size(); ++next_) visit(queue[next_], queue);
    }
  }

 private:
  struct Triangle {
    std::uint8_t open = 0;  ///< pairs of which nothing is known yet
    std::uint8_t joins = 0;
    bool reached = false, visited = false;
  };
  static constexpr unsigned kJoins = 3, kOpen = 4;  // 0 to 2 joins, 1 to 3 pairs that are open

  void reach(Index t, std::vector<Index>& queue) {
    if (triangles_[t].reached) return;
    triangles_[t].reached = true;
    queue.push_back(t);
  }

  void visit(Index t, std::vector<Index>& queue) {
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (opposite_[h] == kNone) continue;
      const Index u = opposite_[h] / 3;
      if (triangles_[u].visited) continue;
      code(h, t, u);
      reach(u, queue);
    }
    triangles_[t].visited = true;
  }

  void code(Index h, Index t, Index u) {
    Triangle &a = triangles_[t], &b = triangles_[u];
    const Index part_a = part_of(t), part_b = part_of(u);
    // Joins have no cycles.
    if (part_a != part_b && coder_.bit(models_[a.joins][b.joins][a.open][b.open],
                                       !Coder::kReads && joined_.is_joined(h))) {
      if constexpr (Coder::kReads) joined_.set_joined(h, true);
      part_[part_b] = part_a;
      a.joins = std::min<std::uint8_t>(a.joins + 1, kJoins - 1);
      b.joins = std::min<std::uint8_t>(b.joins + 1, kJoins - 1);
    }
    --a.open;
    --b.open;
  }

  Index part_of(Index t) {
    while (part_[t] != t) t = part_[t] = part_[part_[t]];
    return t;
  }

  Coder& coder_;
  std::span<const Index> opposite_;
  JoinedFaces& joined_;
  std::vector<Triangle> triangles_;
  std::vector<Index> part_;  // of the polygons so far; its own part: the first of one
  std::size_t next_ = 0;     // in the queue
  std::array<std::array<std::array<std::array<BitModel, kOpen>, kOpen>, kJoins>, kJoins> models_;
};

/// Faces corner by corner. Each face, corner and triangle takes a raw bit at least, so that no more
/// of them are read than there are bits.
template <class Coder>
class FaceListCode {
 public:
  FaceListCode(Coder& coder, Index groups) : coder_(coder), groups_(groups) {}

  /// The faces of a table from one on; a reader appends them.
  ///
  /// errors  corrupt: bytes that end early
  Result<void> run(FaceTable& table, Index first, Index faces) {
    for (Index f = first; faces-- > 0; ++f) {
      if constexpr (Coder::kReads)
        if (coder_.overrun()) return broken(Fault::compact_run);
      const auto of = [&](const std::vector<Index>& bounds) {
        return Coder::kReads ? 0 : bounds[f + 1] - bounds[f];
      };
      const Index corners = code_count(coder_, corners_, of(table.first));
      if (auto ok = code_run(table.corners, at(table.first, f), corners, corner_); !ok) return ok;
      code_group(table, f);
      Index replaced = of(table.replaced_first);
      if (coder_.raw(replaced > 0 ? 1 : 0, 1) != 0)
        replaced = 1 + code_count(coder_, replaced_, replaced - 1);
      if (auto ok = code_run(table.replaced, at(table.replaced_first, f), replaced, triangle_); !ok)
        return ok;
      if constexpr (Coder::kReads) {
        table.first.push_back(static_cast<Index>(table.corners.size()));
        table.replaced_first.push_back(static_cast<Index>(table.replaced.size()));
      }
    }
    return {};
  }

 private:
  /// Numbers that are near the one before.
  struct Near {
    NumberModel model;
    Index last = 0;
  };
  static constexpr std::int64_t kFar = 1 << 20;

  static std::size_t at(const std::vector<Index>& first, Index f) { return first[f]; }

  Result<void> code_run(std::vector<Index>& list, std::size_t first, Index count, Near& near) {
    for (std::size_t i = first; count-- > 0; ++i) {
      if constexpr (Coder::kReads) {
        if (coder_.overrun()) return broken(Fault::compact_run);
        list.push_back(0);
      }
      code_number(list[i], near);
    }
    return {};
  }

  void code_number(Index& number, Near& near) {
    const std::int64_t step = std::int64_t{number} - near.last;
    const bool far = step < -kFar || step > kFar;
    if (coder_.raw(far ? 1 : 0, 1) != 0)
      number = coder_.raw(number, 32);
    else
      number = near.last + static_cast<Index>(near.model.code(
                               coder_, Coder::kReads ? 0 : static_cast<std::int32_t>(step)));
    near.last = number;
  }

  void code_group(FaceTable& table, Index f) {
    if constexpr (Coder::kReads) table.group.push_back(0);
    if (groups_ < 2) return;
    const auto bits = static_cast<unsigned>(std::bit_width(groups_ - 1));
    Index& group = table.group[f];
    if (coder_.bit(same_group_, group == group_))
      group = group_;
    else
      group = coder_.raw(group, bits);
    group_ = group;
  }

  Coder& coder_;
  Index groups_;
  SymbolModel corners_, replaced_;
  BitModel same_group_;
  Near corner_, triangle_;
  Index group_ = 0;
};

}  // namespace pstrips::inline formats
