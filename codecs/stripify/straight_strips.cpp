#include "codecs/stripify/straight_strips.h"

#include "codecs/stripify/free_triangles.h"

namespace pstrips::inline codecs {
namespace {

class StraightStrips {
 public:
  explicit StraightStrips(const DualGraph& graph)
      : graph_(graph),
        free_(graph),
        links_(graph.half_edge_count()),
        walk_of_(graph.triangle_count()) {}

  Links run() {
    for (Index seed; (seed = free_.lowest()) != kNone;) {
      Index best = 3 * seed, longest = 0;
      for (Index h = 3 * seed; h < 3 * seed + 3; ++h) {
        const Index length = walk<false>(h);
        if (length <= longest) continue;
        best = h;
        longest = length;
      }
      walk<true>(best);
    }
    return std::move(links_);
  }

 private:
  // The strip that passes the triangle of h over h and the edge after it; its length.
  template <bool kTake>
  Index walk(Index h) {
    const Index seed = triangle_of(h);
    walk_of_[seed] = ++walk_;
    if constexpr (kTake) free_.take(seed);
    // Seen along the strip, it came in over the edge after h and left over the edge before that.
    const Index ahead = half_walk<kTake>(h, true);
    return 1 + ahead + half_walk<kTake>(next_in_triangle(h), false);
  }

  template <bool kTake>
  Index half_walk(Index exit, bool left_before_entry) {
    for (Index length = 0;; ++length) {
      const Index entry = graph_.opposite[exit];
      if (entry == kNone) return length;
      const Index t = triangle_of(entry);
      if (!free_.contains(t) || walk_of_[t] == walk_) return length;
      walk_of_[t] = walk_;
      if constexpr (kTake) {
        free_.take(t);
        set_link(graph_, links_, exit, true);
      }
      exit = left_before_entry ? next_in_triangle(entry) : previous_in_triangle(entry);
      left_before_entry = !left_before_entry;
    }
  }

  const DualGraph& graph_;
  FreeTriangles free_;
  Links links_;
  std::vector<Index> walk_of_;  // the last walk that came by
  Index walk_ = 0;
};

}  // namespace

Links straight_strips(const DualGraph& graph) { return StraightStrips(graph).run(); }

}  // namespace pstrips::inline codecs
