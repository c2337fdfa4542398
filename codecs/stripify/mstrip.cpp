#include "codecs/stripify/mstrip.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "codecs/stripify/emit.h"
#include "codecs/stripify/free_triangles.h"

namespace pstrips::inline codecs {
namespace {

enum class Turn : std::uint8_t { none, before, after };

Turn turn(Index entry, Index exit) {
  if (entry == kNone) return Turn::none;
  return exit == previous_in_triangle(entry) ? Turn::before : Turn::after;
}
Turn reversed(Turn t) {
  return t == Turn::before ? Turn::after : t == Turn::after ? Turn::before : t;
}

class MStrip {
 public:
  MStrip(const DualGraph& graph, StripGoal goal)
      : graph_(graph),
        goal_(goal),
        free_(graph),
        links_(graph.half_edge_count()),
        mate_(graph.triangle_count()) {}

  Links run() {
    for (;;) {
      for (std::size_t i = 0; i < heads_.size(); i += 2)
        if (!grows(i) && !grows(i + 1)) start(i);
      stop_dead_ends();
      const Choice best = best_choice();
      if (best.exit != kNone)
        advance(best);
      else if (free_.lowest() == kNone)
        return std::move(links_);
    }
  }

 private:
  // An end that grows: a triangle, the half-edge it was entered over (kNone: no strip yet) and how
  // the strip turned in the triangle before it.
  struct Head {
    Index triangle = kNone;  // kNone: grows no more
    Index entry = kNone;
    Turn last = Turn::none;
  };
  using Rank = std::tuple<unsigned, unsigned, unsigned>;
  struct Choice {
    std::size_t head = 0;
    Index exit = kNone;
    Rank rank{};
    bool beats(const Choice& other) const {
      return exit != kNone && (other.exit == kNone || rank < other.rank);
    }
  };

  bool grows(std::size_t i) const { return heads_[i].triangle != kNone; }

  void start(std::size_t i) {
    const Index seed = free_.lowest();
    if (seed == kNone) return;
    free_.take(seed);
    mate_[seed] = seed;
    heads_[i] = heads_[i + 1] = {.triangle = seed};
  }

  void stop_dead_ends() {
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (grows(i) && choose(i).exit == kNone) join(std::exchange(heads_[i], {}).triangle);
  }

  Choice best_choice() const {
    Choice best;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (!grows(i)) continue;
      const Choice choice = choose(i);
      if (choice.beats(best)) best = choice;
    }
    return best;
  }

  void advance(const Choice& choice) {
    Head& head = heads_[choice.head];
    Head& other = heads_[choice.head ^ 1];
    const Turn turned = turn(head.entry, choice.exit);
    // Seen from the other end, the start is entered over the edge it is left by here.
    if (other.triangle == head.triangle)
      other.entry = choice.exit;
    else if (other.last == Turn::none)
      other.last = reversed(turned);
    link(choice.exit, graph_.neighbor(choice.exit));
    head = {graph_.neighbor(choice.exit), graph_.opposite[choice.exit], turned};
    free_.take(head.triangle);
  }

  // A walled-in end is linked to an end of another strip, if one is next to it.
  void join(Index t) {
    if (!is_end(t)) return;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Index n = graph_.neighbor(h);
      if (n == kNone || free_.contains(n) || !is_end(n) || mate_[t] == n) continue;
      stop_growth_over(graph_.opposite[h]);
      return link(h, mate_[n]);
    }
  }

  // Of the end in whose triangle the half-edge `entry` is, if it grows.
  void stop_growth_over(Index entry) {
    const Index t = triangle_of(entry);
    for (std::size_t i = 0; i < heads_.size(); i += 2) {
      Head &a = heads_[i], &b = heads_[i + 1];
      if (a.triangle == t && b.triangle == t)  // an isolated triangle keeps its other end
        b.entry = entry;
      else if (b.triangle == t)
        b = {};
      if (a.triangle == t) a = {};
    }
  }

  // `far` is the end of the strip over h that h does not touch.
  void link(Index h, Index far) {
    set_link(graph_, links_, h, true);
    const Index mate = mate_[triangle_of(h)];
    mate_[mate] = far;
    mate_[far] = mate;
  }

  Choice choose(std::size_t i) const {
    Choice best;
    const Index t = heads_[i].triangle;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (!is_free_over(h)) continue;
      const Choice choice{i, h, rank_of(heads_[i], h)};
      if (choice.beats(best)) best = choice;
    }
    return best;
  }

  Rank rank_of(const Head& head, Index exit) const {
    const Turn turned = turn(head.entry, exit);
    const unsigned swaps = turned != Turn::none && head.last == turned;
    const unsigned degree = free_.degree(graph_.neighbor(exit));
    const unsigned beyond = lowest_degree_beyond(exit);
    if (goal_ == StripGoal::indices) return {degree, swaps, beyond};
    return {degree, beyond, swaps};
  }

  bool is_free_over(Index h) const {
    const Index n = graph_.neighbor(h);
    return n != kNone && free_.contains(n);
  }

  // The fewest free neighbours among the free neighbours of the triangle over h.
  unsigned lowest_degree_beyond(Index h) const {
    const Index n = graph_.neighbor(h);
    unsigned lowest = 4;
    for (Index g = 3 * n; g < 3 * n + 3; ++g)
      if (is_free_over(g)) lowest = std::min(lowest, free_.degree(graph_.neighbor(g)));
    return lowest;
  }

  bool is_end(Index t) const { return links_[3 * t] + links_[3 * t + 1] + links_[3 * t + 2] < 2; }

  const DualGraph& graph_;
  StripGoal goal_;
  FreeTriangles free_;
  Links links_;
  std::vector<Index> mate_;      // of the end of a strip: its other end
  std::array<Head, 4> heads_{};  // two strips, two ends each, which stand in one triangle at first
};

}  // namespace

Strips mstrip(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, MStrip(graph, options.goal).run());
}

}  // namespace pstrips::inline codecs
