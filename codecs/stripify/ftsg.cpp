#include "codecs/stripify/ftsg.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "codecs/stripify/free_triangles.h"
#include "codecs/stripify/linked_paths.h"

namespace pstrips::inline codecs {
namespace {

enum class Preference { first_edge, fewest_neighbors, alternation };

/// A spanning tree of each component.
struct Forest {
  std::vector<Index> order;  ///< triangles, each after its parent
  std::vector<Index> up;     ///< a triangle's half-edge to its parent, or kNone
};

class DepthFirstSearch {
 public:
  DepthFirstSearch(const DualGraph& graph, Preference preference)
      : graph_(graph), preference_(preference), free_(graph) {
    forest_.order.reserve(graph.triangle_count());
    forest_.up.assign(graph.triangle_count(), kNone);
  }

  Forest run() {
    std::vector<Index> stack;
    for (Index root; (root = free_.lowest()) != kNone;) {
      visit(root);
      stack.push_back(root);
      while (!stack.empty()) {
        const Index exit = preferred(stack.back());
        if (exit == kNone) {
          stack.pop_back();
          continue;
        }
        const Index child = graph_.neighbor(exit);
        forest_.up[child] = graph_.opposite[exit];
        visit(child);
        stack.push_back(child);
      }
    }
    return std::move(forest_);
  }

 private:
  using Rank = std::tuple<unsigned, unsigned, unsigned>;

  void visit(Index t) {
    free_.take(t);
    forest_.order.push_back(t);
  }

  bool is_free_over(Index h) const {
    const Index n = graph_.neighbor(h);
    return n != kNone && free_.contains(n);
  }
  unsigned degree_over(Index h) const { return free_.degree(graph_.neighbor(h)); }

  // The half-edge of t over which the search goes on, or kNone.
  Index preferred(Index t) const {
    Index best = kNone;
    Rank best_rank{};
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (!is_free_over(h)) continue;
      const Rank r = rank(h);
      if (best != kNone && best_rank <= r) continue;
      best = h;
      best_rank = r;
    }
    return best;
  }

  Rank rank(Index exit) const {
    switch (preference_) {
      case Preference::first_edge:
        return {};
      case Preference::fewest_neighbors:
        return {degree_over(exit), lookahead_over(exit), swaps(exit)};
      case Preference::alternation:
        return {swaps(exit), degree_over(exit), 0};
    }
    return {};
  }

  // The fewest free neighbours among the free neighbours of the triangle over h.
  unsigned lookahead_over(Index h) const {
    const Index n = graph_.neighbor(h);
    unsigned fewest = 4;
    for (Index g = 3 * n; g < 3 * n + 3; ++g)
      if (is_free_over(g)) fewest = std::min(fewest, degree_over(g));
    return fewest;
  }

  // Whether leaving a triangle over `exit` turns the way that its parent was left.
  bool swaps(Index exit) const {
    const Index entry = forest_.up[triangle_of(exit)];
    if (entry == kNone) return false;
    const Index parent_exit = graph_.opposite[entry];
    const Index parent_entry = forest_.up[triangle_of(parent_exit)];
    return parent_entry != kNone && (exit == previous_in_triangle(entry)) ==
                                        (parent_exit == previous_in_triangle(parent_entry));
  }

  const DualGraph& graph_;
  Preference preference_;
  FreeTriangles free_;
  Forest forest_;
};

/// Cuts trees into the fewest strips and, among those, into strips with the fewest swaps.
class Partition {
 public:
  Partition(const DualGraph& graph, const Forest& forest)
      : graph_(graph),
        forest_(forest),
        costs_(graph.triangle_count()),
        state_(graph.triangle_count(), kCut),
        links_(graph.half_edge_count()) {}

  Links run() {
    for (std::size_t i = forest_.order.size(); i-- > 0;) weigh(forest_.order[i]);
    for (const Index t : forest_.order) link_children(t);
    return std::move(links_);
  }

 private:
  // How a triangle stands to its parent: cut off; or linked, and then an end, or linked on to the
  // child over the edge after the one to the parent, or over the edge before.
  enum State : std::uint8_t { kCut, kEnd, kAfter, kBefore };

  // Of a subtree, for each state of its root. A strip is counted at its triangle next to the root
  // of the tree, a swap at the upper one of the two triangles where it happens.
  using Cost = std::int64_t;
  struct Costs {
    Cost of[4];
  };
  static constexpr Cost kSwap = 1, kStrip = Cost{1} << 32;
  static constexpr Cost kImpossible = std::numeric_limits<Cost>::max() / 4;

  struct TwoLinks {
    Index first = kNone, second = kNone;
  };

  bool leads_to_child(Index h) const {
    const Index o = graph_.opposite[h];
    return o != kNone && forest_.up[triangle_of(o)] == o;
  }
  const Costs& costs_over(Index h) const { return costs_[graph_.neighbor(h)]; }

  // Of the child over h in state s, when h is linked and `other` is the other link of its triangle
  // or kNone. Three links in a row around a vertex are a swap.
  Cost cost_over(Index h, Index other, State s) const {
    const bool swaps = other != kNone && ((s == kAfter && other == previous_in_triangle(h)) ||
                                          (s == kBefore && other == next_in_triangle(h)));
    return costs_over(h).of[s] + (swaps ? kSwap : 0);
  }
  State best_state_over(Index h, Index other) const {
    State best = kEnd;
    for (const State s : {kAfter, kBefore})
      if (cost_over(h, other, s) < cost_over(h, other, best)) best = s;
    return best;
  }
  // What changes by linking h.
  Cost change(Index h, Index other) const {
    if (h == kNone) return 0;
    return cost_over(h, other, best_state_over(h, other)) - costs_over(h).of[kCut];
  }
  Cost change(TwoLinks links) const {
    return change(links.first, links.second) + change(links.second, links.first);
  }

  // The best links to children of a triangle that is cut off from its parent.
  TwoLinks best_links(Index t) const {
    TwoLinks best;
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      for (const Index g : {kNone, next_in_triangle(h)}) {
        if (!leads_to_child(h) || (g != kNone && !leads_to_child(g))) continue;
        if (change({h, g}) < change(best)) best = {h, g};
      }
    return best;
  }

  void weigh(Index t) {
    Cost children = 0;
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (leads_to_child(h)) children += costs_over(h).of[kCut];
    Costs& costs = costs_[t];
    costs.of[kCut] = kStrip + children + change(best_links(t));
    costs.of[kEnd] = children;
    const Index up = forest_.up[t];
    if (up == kNone) return;
    const auto linked_on_over = [&](Index h) {
      return leads_to_child(h) ? children + change(h, up) : kImpossible;
    };
    costs.of[kAfter] = linked_on_over(next_in_triangle(up));
    costs.of[kBefore] = linked_on_over(previous_in_triangle(up));
  }

  void link_children(Index t) {
    const Index up = forest_.up[t];
    switch (state_[t]) {
      case kCut: {
        const TwoLinks links = best_links(t);
        link(links.first, links.second);
        link(links.second, links.first);
        break;
      }
      case kEnd:
        break;
      case kAfter:
        link(next_in_triangle(up), up);
        break;
      case kBefore:
        link(previous_in_triangle(up), up);
        break;
    }
  }

  void link(Index h, Index other) {
    if (h == kNone) return;
    set_link(graph_, links_, h, true);
    state_[graph_.neighbor(h)] = best_state_over(h, other);
  }

  const DualGraph& graph_;
  const Forest& forest_;
  std::vector<Costs> costs_;
  std::vector<State> state_;
  Links links_;
};

/// Joins strips whose ends are neighbours.
class Concatenation {
 public:
  explicit Concatenation(LinkedPaths& paths) : paths_(paths), mate_(paths.triangle_count()) {
    for (Index t = 0; t < paths.triangle_count(); ++t)
      if (paths.is_end(t)) mate_[t] = other_end(t);
  }

  void run() {
    constexpr int kMaxSwaps = 6;  // that a link can take part in
    for (int swaps = 0; swaps <= kMaxSwaps; ++swaps)
      for (Index t = 0; t < paths_.triangle_count(); ++t)
        for (Index k = 0; k < 3; ++k) join_over(LinkedPaths::half_edge(t, k), swaps);
  }

 private:
  using HalfEdge = LinkedPaths::HalfEdge;

  Index other_end(Index t) const {
    for (HalfEdge exit = paths_.is_single(t) ? kNone : paths_.first_link(t); exit != kNone;) {
      t = LinkedPaths::triangle_of(paths_.opposite(exit));
      exit = paths_.other_link(paths_.opposite(exit));
    }
    return t;
  }

  void join_over(HalfEdge h, int most_swaps) {
    const Index s = LinkedPaths::triangle_of(h);
    if (!paths_.is_end(s) || !paths_.has_opposite(h) || paths_.is_linked(h)) return;
    const Index t = LinkedPaths::triangle_of(paths_.opposite(h));
    if (!paths_.is_end(t) || mate_[s] == t || paths_.link_cost(h) > most_swaps) return;
    paths_.flip(h);
    const Index end = mate_[s], other_end = mate_[t];
    mate_[end] = other_end;
    mate_[other_end] = end;
  }

  LinkedPaths& paths_;
  std::vector<Index> mate_;  // of an end, the other end of its strip
};

Strips tree_strips(const StripInput& input, Preference preference) {
  const DualGraph graph = make_dual_graph(input);
  const Forest forest = DepthFirstSearch(graph, preference).run();
  LinkedPaths paths(graph, Partition(graph, forest).run());
  Concatenation(paths).run();
  return emit_strips(input, graph, paths.links());
}

}  // namespace

Strips ftsg(const StripInput& input, const StripOptions&) {
  return tree_strips(input, Preference::first_edge);
}

Strips ftsg_sgi(const StripInput& input, const StripOptions&) {
  return tree_strips(input, Preference::fewest_neighbors);
}

Strips ftsg_alt(const StripInput& input, const StripOptions&) {
  return tree_strips(input, Preference::alternation);
}

}  // namespace pstrips::inline codecs
