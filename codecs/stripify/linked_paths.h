#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "codecs/stripify/emit.h"

namespace pstrips::inline codecs {

/// A stripification under change: which edges are linked, what changing one costs, and whether it
/// keeps the strips free of cycles.
///
/// A strip is a path of linked triangles, an end a triangle with fewer than two links. Three linked
/// edges in a row around a vertex are a swap, at the one in the middle, and nothing else is; so the
/// cost of a link is known from eight edges near it.
///
/// Half-edges are numbered 4 t + k here, so that triangle and neighbours take no division.
class LinkedPaths {
 public:
  using HalfEdge = Index;

  LinkedPaths(const DualGraph& graph, const Links& links,
              std::span<const std::uint8_t> step_cost = {});
  Links links() const;

  Index triangle_count() const { return static_cast<Index>(linked_.size()); }
  static constexpr Index triangle_of(HalfEdge h) { return h >> 2; }
  static constexpr HalfEdge half_edge(Index t, Index k) { return 4 * t + k; }

  static constexpr HalfEdge next(HalfEdge h) { return h + ((h & 3) == 2 ? ~Index{1} : 1); }
  static constexpr HalfEdge previous(HalfEdge h) { return h + ((h & 3) == 0 ? 2 : ~Index{0}); }

  bool has_opposite(HalfEdge h) const { return opposite_[h] != kNone; }
  HalfEdge opposite(HalfEdge h) const { return opposite_[h]; }
  bool is_linked(HalfEdge h) const { return (linked_[h >> 2] >> (h & 3) & 1) != 0; }
  bool is_single(Index t) const { return linked_[t] == 0; }
  bool is_end(Index t) const { return (linked_[t] & (linked_[t] - 1)) == 0; }
  /// The lowest link of t. Precondition: !is_single(t).
  HalfEdge first_link(Index t) const {
    return 4 * t + static_cast<Index>(std::countr_zero(linked_[t]));
  }
  /// The link of h's triangle that is not h, or kNone.
  HalfEdge other_link(HalfEdge h) const {
    const auto rest = static_cast<std::uint8_t>(linked_[h >> 2] & ~(1u << (h & 3)));
    return rest == 0 ? kNone : (h & ~Index{3}) + static_cast<Index>(std::countr_zero(rest));
  }

  /// Links an edge that is not linked, or cuts it. Precondition: has_opposite(h).
  void flip(HalfEdge h) {
    const HalfEdge o = opposite_[h];
    linked_[h >> 2] ^= static_cast<std::uint8_t>(1u << (h & 3));
    linked_[o >> 2] ^= static_cast<std::uint8_t>(1u << (o & 3));
  }

  /// What a link over h costs, whether it is there or not: the swaps that it takes part in, at most
  /// 6, and the step over it.
  int link_cost(HalfEdge h) const {
    const HalfEdge o = opposite_[h];
    const int swaps = swaps_around(h, o) + swaps_around(o, h);
    return step_cost_.empty() ? swaps : swaps + step_cost_[h];
  }

  /// Whether the path that leaves a triangle over its link `exit` comes to t. Follows two paths at
  /// once, from there and from t, so that the shorter one decides the cost. True as well when
  /// neither has ended after max_steps.
  /// Precondition: is_end(t), and t is not the triangle of `exit`.
  bool leads_to(HalfEdge exit, Index t, std::uint32_t max_steps = ~0u) const {
    if (linked_[t] == 0) return false;
    const Index start = exit >> 2;
    HalfEdge ahead = opposite_[exit], from_t = opposite_[first_link(t)];
    for (; max_steps > 0; --max_steps) {
      if (ahead >> 2 == t) return true;
      if (from_t >> 2 == start) return from_t == exit;
      const HalfEdge next = other_link(ahead), next_from_t = other_link(from_t);
      if (next == kNone || next_from_t == kNone) return false;
      ahead = opposite_[next];
      from_t = opposite_[next_from_t];
    }
    return true;
  }
  /// Precondition: s and t are ends.
  bool on_same_path(Index s, Index t, std::uint32_t max_steps = ~0u) const {
    return s == t || (linked_[s] != 0 && leads_to(first_link(s), t, max_steps));
  }

 private:
  // Around the origin of h: the two edges on either side of it.
  int swaps_around(HalfEdge h, HalfEdge o) const {
    const HalfEdge before = previous(h), after = next(o);
    const bool has_before = is_linked(before), has_after = is_linked(after);
    int swaps = has_before && has_after;
    if (has_before) swaps += is_linked(previous(opposite_[before]));
    if (has_after) swaps += is_linked(next(opposite_[after]));
    return swaps;
  }

  std::vector<HalfEdge> opposite_;       // 4 a triangle, the last unused
  std::vector<std::uint8_t> step_cost_;  // of the edge, 4 a triangle, or empty
  std::vector<std::uint8_t> linked_;     // a bit for each half-edge of a triangle
};

}  // namespace pstrips::inline codecs
