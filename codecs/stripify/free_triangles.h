#pragma once

#include <array>
#include <vector>

#include "codecs/stripify/dual_graph.h"

namespace pstrips::inline codecs {

/// The triangles that no strip has taken yet, by number of free neighbours. Every operation is
/// O(1), amortized for `lowest`: a triangle is filed anew at each loss of a neighbour, and stale
/// entries are dropped when they come up.
class FreeTriangles {
 public:
  explicit FreeTriangles(const DualGraph& graph) : graph_(graph), degree_(graph.triangle_count()) {
    for (Index t = graph.triangle_count(); t-- > 0;) {  // backwards, so that the lowest is on top
      for (Index h = 3 * t; h < 3 * t + 3; ++h) degree_[t] += graph.opposite[h] != kNone;
      buckets_[degree_[t]].push_back(t);
    }
  }

  bool contains(Index t) const { return degree_[t] != kTaken; }
  /// Edges over which a free triangle follows. Precondition: contains(t).
  unsigned degree(Index t) const { return degree_[t]; }

  void take(Index t) {
    degree_[t] = kTaken;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Index n = graph_.neighbor(h);
      if (n == kNone || !contains(n)) continue;
      buckets_[--degree_[n]].push_back(n);
    }
  }

  /// A free triangle of lowest degree, the one filed last; kNone when none is left.
  Index lowest() {
    for (unsigned d = 0; d < buckets_.size(); ++d)
      for (std::vector<Index>& bucket = buckets_[d]; !bucket.empty(); bucket.pop_back())
        if (degree_[bucket.back()] == d) return bucket.back();
    return kNone;
  }

 private:
  static constexpr std::uint8_t kTaken = 4;
  const DualGraph& graph_;
  std::vector<std::uint8_t> degree_;
  std::array<std::vector<Index>, 4> buckets_;
};

}  // namespace pstrips::inline codecs
