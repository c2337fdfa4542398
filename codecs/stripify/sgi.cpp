#include "codecs/stripify/sgi.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "codecs/stripify/free_triangles.h"

namespace pstrip {
namespace {

// Where a strip stands: in a triangle entered over `entry` (kNone: it is the first), having turned
// to the edge before or after its entry in the last triangle.
enum class Turn { none, before, after };
struct Head {
  Index triangle;
  Index entry;
  Turn last;
  bool is_seed;
};

class Sgi {
 public:
  explicit Sgi(const DualGraph& graph)
      : graph_(graph), free_(graph), links_(graph.half_edge_count()) {}

  // `choose(head)` gives the half-edge to step over next, or kNone.
  template <class Choose>
  Links run(Choose&& choose) {
    for (Index seed; (seed = free_.lowest()) != kNone;) {
      free_.take(seed);
      const Head start{seed, kNone, Turn::none, true};
      const Index exit = choose(*this, start);
      if (exit == kNone) continue;
      const Turn second = walk(exit, Turn::none, choose);
      // Backwards: the seed was, as it were, entered over the edge it was left by.
      const Index back = choose(*this, Head{seed, exit, reversed(second), true});
      if (back != kNone) walk(back, turn(exit, back), choose);
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

  static Turn turn(Index entry, Index exit) {
    return exit == previous_in_triangle(entry) ? Turn::before : Turn::after;
  }
  static bool swaps(const Head& head, Index exit) {
    return head.entry != kNone && head.last != Turn::none && head.last == turn(head.entry, exit);
  }

 private:
  static Turn reversed(Turn t) {
    return t == Turn::before ? Turn::after : t == Turn::after ? Turn::before : t;
  }

  // Steps over `exit` and on; returns the turn in the first triangle reached.
  template <class Choose>
  Turn walk(Index exit, Turn last, Choose&& choose) {
    Turn first = Turn::none;
    for (bool is_first = true; exit != kNone; is_first = false) {
      set_link(graph_, links_, exit, true);
      const Index entry = graph_.opposite[exit];
      free_.take(triangle_of(entry));
      exit = choose(*this, Head{triangle_of(entry), entry, last, false});
      if (exit == kNone) break;
      last = turn(entry, exit);
      if (is_first) first = last;
    }
    return first;
  }

  const DualGraph& graph_;
  FreeTriangles free_;
  Links links_;
};

Index fewest_neighbors(const Sgi& sgi, const Head& head) {
  Index best = kNone;
  std::tuple<unsigned, unsigned, bool> best_rank{};
  for (Index h = 3 * head.triangle; h < 3 * head.triangle + 3; ++h) {
    if (!sgi.is_free_over(h)) continue;
    const std::tuple rank{sgi.degree_over(h), sgi.lookahead_over(h), Sgi::swaps(head, h)};
    if (best != kNone && best_rank <= rank) continue;
    best = h;
    best_rank = rank;
  }
  return best;
}

Index fewest_swaps(const Sgi& sgi, const Head& head) {
  Index best = kNone;
  std::pair<bool, unsigned> best_rank{};
  for (Index h = 3 * head.triangle; h < 3 * head.triangle + 3; ++h) {
    if (!sgi.is_free_over(h)) continue;
    const std::pair rank{Sgi::swaps(head, h), sgi.degree_over(h)};
    if (rank.first && rank.second > 1 && !head.is_seed) continue;
    if (best != kNone && best_rank <= rank) continue;
    best = h;
    best_rank = rank;
  }
  return best;
}

}  // namespace

Links sgi_strips_links(const DualGraph& graph) { return Sgi(graph).run(fewest_neighbors); }

Strips sgi_strips(const StripInput& input, const StripOptions&) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, sgi_strips_links(graph));
}

Strips sgi_vertices(const StripInput& input, const StripOptions&) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, Sgi(graph).run(fewest_swaps));
}

}  // namespace pstrip
