#include "codecs/stripify/sgi.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "codecs/stripify/free_triangles.h"

namespace pstrips::inline codecs {
namespace {

class Sgi {
 public:
  explicit Sgi(const DualGraph& graph)
      : graph_(graph), free_(graph), links_(graph.half_edge_count()) {}

  // `choose(sgi, triangle, straight)` gives the half-edge to step over next, or kNone. Over
  // `straight` (kNone in the first triangle) the step needs no swap.
  template <class Choose>
  Links run(Choose&& choose) {
    for (Index seed; (seed = free_.lowest()) != kNone;) {
      free_.take(seed);
      bool turns_before = true;  // in the next triangle, for want of a swap: to the edge before
      Index straight = kNone;
      for (Index t = seed, exit; (exit = choose(*this, t, straight)) != kNone;) {
        if (straight != kNone) turns_before = turns_before != (exit == straight);
        set_link(graph_, links_, exit, true);
        const Index entry = graph_.opposite[exit];
        straight = turns_before ? previous_in_triangle(entry) : next_in_triangle(entry);
        t = triangle_of(entry);
        free_.take(t);
      }
    }
    return std::move(links_);
  }

  bool is_free_over(Index h) const {
    const Index n = graph_.neighbor(h);
    return n != kNone && free_.contains(n);
  }
  unsigned degree_over(Index h) const { return free_.degree(graph_.neighbor(h)); }

  // The fewest free neighbours among the free neighbours of the triangle over h.
  unsigned lookahead_over(Index h) const {
    const Index n = graph_.neighbor(h);
    unsigned lowest = 4;
    for (Index g = 3 * n; g < 3 * n + 3; ++g)
      if (is_free_over(g)) lowest = std::min(lowest, degree_over(g));
    return lowest;
  }

 private:
  const DualGraph& graph_;
  FreeTriangles free_;
  Links links_;
};

template <bool kAvoidsSwaps>
Index fewest_neighbors(const Sgi& sgi, Index triangle, Index straight) {
  Index best = kNone;
  std::tuple<unsigned, unsigned, bool> best_rank{};
  for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    if (!sgi.is_free_over(h)) continue;
    const std::tuple rank{sgi.degree_over(h), sgi.lookahead_over(h), kAvoidsSwaps && h != straight};
    if (best != kNone && best_rank <= rank) continue;
    best = h;
    best_rank = rank;
  }
  return best;
}

Index fewest_swaps(const Sgi& sgi, Index triangle, Index straight) {
  if (straight != kNone && sgi.is_free_over(straight)) return straight;
  for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h)
    if (sgi.is_free_over(h)) return h;
  return kNone;
}

}  // namespace

Strips sgi_strips(const StripInput& input, const StripOptions&) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, Sgi(graph).run(fewest_neighbors<false>));
}

Strips sgi_vertices(const StripInput& input, const StripOptions&) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, Sgi(graph).run(fewest_swaps));
}

Links sgi_strips_links(const DualGraph& graph) { return Sgi(graph).run(fewest_neighbors<true>); }

}  // namespace pstrips::inline codecs
