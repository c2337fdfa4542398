#include "codecs/stripify/dstrips.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "codecs/stripify/dual_graph.h"
#include "codecs/stripify/emit.h"

namespace pstrips::inline codecs {
namespace {

enum class Heuristic { greedy, greedy_no_swap, adjacency };

class Queue {
 public:
  void push(Index t) { triangles_.push_back(t); }
  bool empty() const { return next_ == triangles_.size(); }
  Index pop() { return triangles_[next_++]; }

 private:
  std::vector<Index> triangles_;
  std::size_t next_ = 0;
};

template <Heuristic kHeuristic>
class DStrips {
 public:
  explicit DStrips(const DualGraph& graph)
      : graph_(graph), links_(graph.half_edge_count()), is_taken_(graph.triangle_count()) {}

  Links run() {
    for (Index seed; (seed = next_seed()) != kNone;) walk(seed);
    return std::move(links_);
  }

 private:
  static constexpr bool kByAdjacency = kHeuristic == Heuristic::adjacency;

  // Triangles that were taken while they waited are passed over.
  Index next_seed() {
    for (Queue& queue : work_list_)
      while (!queue.empty())
        if (const Index t = queue.pop(); !is_taken_[t]) return t;
    while (lowest_ < graph_.triangle_count() && is_taken_[lowest_]) ++lowest_;
    return lowest_ < graph_.triangle_count() ? lowest_ : kNone;
  }

  bool is_free_over(Index h) const {
    const Index t = graph_.neighbor(h);
    return t != kNone && !is_taken_[t];
  }

  // Free neighbours of the triangle over h.
  unsigned adjacency_over(Index h) const {
    const Index first = 3 * graph_.neighbor(h);
    return unsigned{is_free_over(first)} + is_free_over(first + 1) + is_free_over(first + 2);
  }

  void put_off(Index h) {
    work_list_[kByAdjacency ? adjacency_over(h) : 0].push(graph_.neighbor(h));
  }

  void walk(Index seed) {
    is_taken_[seed] = true;
    Index exit = first_exit(seed);
    bool alternates_to_before = true;
    for (Index length = 2; exit != kNone; ++length) {
      set_link(graph_, links_, exit, true);
      const Index entry = graph_.opposite[exit];
      is_taken_[triangle_of(entry)] = true;
      Index onward = previous_in_triangle(entry), swapping = next_in_triangle(entry);
      if (!alternates_to_before) std::swap(onward, swapping);
      if (kByAdjacency && length > 2 && are_dead_ends(onward, swapping))
        return join_over(entry, onward, swapping);
      exit = choose(onward, swapping);
      alternates_to_before = exit == next_in_triangle(entry);
    }
  }

  Index first_exit(Index seed) {
    Index best = kNone;
    for (Index h = 3 * seed; h < 3 * seed + 3; ++h)
      if (is_free_over(h) &&
          (best == kNone || (kByAdjacency && adjacency_over(h) < adjacency_over(best))))
        best = h;
    for (Index h = 3 * seed; h < 3 * seed + 3; ++h)
      if (h != best && is_free_over(h)) put_off(h);
    return best;
  }

  Index choose(Index onward, Index swapping) {
    const bool can_go_on = is_free_over(onward), can_swap = is_free_over(swapping);
    const bool swaps = can_swap && prefers_swap(onward, swapping, can_go_on);
    if (can_go_on && swaps) put_off(onward);
    if (can_swap && !swaps) put_off(swapping);
    return swaps ? swapping : can_go_on ? onward : kNone;
  }

  bool prefers_swap(Index onward, Index swapping, bool can_go_on) const {
    if constexpr (kHeuristic == Heuristic::greedy_no_swap) return false;
    if (!can_go_on) return true;
    return kByAdjacency && adjacency_over(swapping) < adjacency_over(onward);
  }

  // Whichever the strip takes, the other one would be a strip by itself.
  bool are_dead_ends(Index a, Index b) const {
    return is_free_over(a) && is_free_over(b) && adjacency_over(a) == 0 && adjacency_over(b) == 0 &&
           graph_.neighbor(a) != graph_.neighbor(b);
  }

  void join_over(Index entry, Index a, Index b) {
    set_link(graph_, links_, entry, false);
    for (const Index h : {a, b}) {
      set_link(graph_, links_, h, true);
      is_taken_[graph_.neighbor(h)] = true;
    }
  }

  const DualGraph& graph_;
  Links links_;
  std::vector<std::uint8_t> is_taken_;
  std::array<Queue, 4> work_list_;  // greedy uses the first alone
  Index lowest_ = 0;                // no triangle below it is free
};

template <Heuristic kHeuristic>
Strips stripify(const StripInput& input) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, DStrips<kHeuristic>(graph).run());
}

}  // namespace

Strips dstrips_greedy(const StripInput& input, const StripOptions&) {
  return stripify<Heuristic::greedy>(input);
}

Strips dstrips_greedy_no_swap(const StripInput& input, const StripOptions&) {
  return stripify<Heuristic::greedy_no_swap>(input);
}

Strips dstrips_adjacency(const StripInput& input, const StripOptions&) {
  return stripify<Heuristic::adjacency>(input);
}

}  // namespace pstrips::inline codecs
