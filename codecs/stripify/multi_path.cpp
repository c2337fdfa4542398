#include "codecs/stripify/multi_path.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "codecs/stripify/path_index.h"
#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

/// Triangles in queues, each in one at most. Every operation is O(1), but that `first` looks
/// through a bit a queue.
class Queues {
 public:
  Queues(Index triangles, Index queues)
      : queue_of_(triangles, kNone),
        head_(triangles),
        next_(triangles + queues),
        previous_(triangles + queues),
        filled_end_(queues) {
    for (Index q = 0; q < queues; ++q) next_[head_ + q] = previous_[head_ + q] = head_ + q;
    filled_.reset(queues + 1);
    filled_.set(filled_end_, true);
  }

  /// At the back of `queue`; where it is already, it keeps its place.
  void place(Index t, Index queue) {
    if (queue_of_[t] == queue) return;
    remove(t);
    queue_of_[t] = queue;
    next_[t] = head_ + queue;
    previous_[t] = previous_[head_ + queue];
    next_[previous_[t]] = previous_[next_[t]] = t;
    filled_.set(queue, true);
  }

  void remove(Index t) {
    const Index queue = queue_of_[t];
    if (queue == kNone) return;
    next_[previous_[t]] = next_[t];
    previous_[next_[t]] = previous_[t];
    if (next_[head_ + queue] == head_ + queue) filled_.set(queue, false);
    queue_of_[t] = kNone;
  }

  /// The front of the lowest queue that is not empty; kNone when all are.
  Index first() const {
    const Index queue = filled_.first_from(0);
    return queue == filled_end_ ? kNone : next_[head_ + queue];
  }

 private:
  std::vector<Index> queue_of_;
  Index head_;                          // of queue 0; the others follow
  std::vector<Index> next_, previous_;  // rings through triangles and one head each
  BreakSet filled_;                     // queues, and one past the last
  Index filled_end_;
};

// `cost`: one below `costs` a half-edge, the same for both of an edge; empty for none.
class MultiPath {
 public:
  MultiPath(const DualGraph& graph, std::span<const std::uint16_t> cost, Index costs)
      : graph_(graph),
        cost_(cost),
        costs_(costs),
        queues_(graph.triangle_count(), kClasses * costs),
        links_(graph.half_edge_count()),
        open_(graph.half_edge_count()),
        degree_(graph.triangle_count()),
        has_link_(graph.triangle_count()),
        mate_(graph.triangle_count()) {
    for (Index h = 0; h < graph.half_edge_count(); ++h) {
      open_[h] = graph.opposite[h] != kNone;
      degree_[triangle_of(h)] += open_[h];
    }
    for (Index t = 0; t < graph.triangle_count(); ++t) {
      mate_[t] = t;
      file(t);
    }
  }

  Links run() {
    for (Index t; (t = queues_.first()) != kNone;) link(cheapest(t));
    return std::move(links_);
  }

 private:
  static constexpr Index kClasses = 5;

  Index cost(Index h) const { return cost_.empty() ? 0 : cost_[h]; }

  // The first of the open edges of t that cost least. Precondition: degree_[t] > 0.
  Index cheapest(Index t) const {
    Index best = kNone;
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (open_[h] && (best == kNone || cost(h) < cost(best))) best = h;
    return best;
  }

  void file(Index t) {
    if (degree_[t] == 0) return queues_.remove(t);
    const Index rank = 2 * degree_[t] - (has_link_[t] ? 1 : 2);
    queues_.place(t, rank * costs_ + cost(cheapest(t)));
  }

  void close(Index h) {
    const Index o = graph_.opposite[h];
    open_[h] = open_[o] = false;
    --degree_[triangle_of(h)];
    --degree_[triangle_of(o)];
  }

  void link(Index h) {
    const Index a = triangle_of(h), b = graph_.neighbor(h);
    set_link(graph_, links_, h, true);
    close(h);
    count_link(a);
    count_link(b);
    const Index end = mate_[a], other_end = mate_[b];
    mate_[end] = other_end;
    mate_[other_end] = end;
    for (Index g = 3 * end; g < 3 * end + 3; ++g)
      if (open_[g] && graph_.neighbor(g) == other_end) close(g);
    for (const Index t : {a, b, end, other_end}) file(t);
  }

  void count_link(Index t) {
    if (has_link_[t]) {
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        if (!open_[h]) continue;
        close(h);
        file(graph_.neighbor(h));
      }
    }
    has_link_[t] = true;
  }

  const DualGraph& graph_;
  std::span<const std::uint16_t> cost_;
  Index costs_;
  Queues queues_;
  Links links_;
  std::vector<std::uint8_t> open_, degree_, has_link_;
  std::vector<Index> mate_;  // of an end, the other end of its strip
};

// Costs of edges: 0, then 16 octaves in 16 steps each, and the largest.
constexpr float kLeastPart = 0x1p-16f;
constexpr int kMantissaBitsKept = 4;
constexpr Index kCosts = 1 + (16 << kMantissaBitsKept) + 1;

std::vector<std::uint16_t> edge_costs(const DualGraph& graph, std::span<const double> weight) {
  const auto difference = [&](Index h) {  // half of it, which is always finite
    return graph.opposite[h] == kNone
               ? 0
               : std::abs(weight[triangle_of(h)] / 2 - weight[graph.neighbor(h)] / 2);
  };
  double largest = 0;
  for (Index h = 0; h < graph.half_edge_count(); ++h) largest = std::max(largest, difference(h));
  std::vector<std::uint16_t> costs(graph.half_edge_count());
  if (largest == 0) return costs;
  constexpr auto kLeast = std::bit_cast<std::uint32_t>(kLeastPart);
  for (Index h = 0; h < graph.half_edge_count(); ++h) {
    const auto part = std::bit_cast<std::uint32_t>(static_cast<float>(difference(h) / largest));
    if (part < kLeast) continue;
    costs[h] = static_cast<std::uint16_t>(1 + ((part - kLeast) >> (23 - kMantissaBitsKept)));
  }
  return costs;
}

// In edges, of each wedge from the lowest one that triangles join it to.
std::vector<Index> wedge_distances(const StripInput& input) {
  const Grouped<Index> corners_at = group_by(input.wedge_count, input.triangles.size(),
                                             [&](Index c) { return input.triangles[c]; });
  std::vector<Index> distance(input.wedge_count, kNone), queue;
  for (Index start = 0; start < input.wedge_count; ++start) {
    if (distance[start] != kNone) continue;
    distance[start] = 0;
    queue.assign(1, start);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const Index w = queue[i];
      for (const Index corner : corners_at[w])
        for (const Index c : {next_in_triangle(corner), previous_in_triangle(corner)}) {
          Index& reached = distance[input.triangles[c]];
          if (reached != kNone) continue;
          reached = distance[w] + 1;
          queue.push_back(input.triangles[c]);
        }
    }
  }
  return distance;
}

// One a triangle: the largest that `at(wedge)` gives for its corners.
template <class At>
std::vector<double> largest_of_corners(const StripInput& input, At&& at) {
  std::vector<double> weights;
  weights.reserve(input.triangles.size() / 3);
  for (std::size_t c = 0; c < input.triangles.size(); c += 3)
    weights.push_back(
        std::max({at(input.triangles[c]), at(input.triangles[c + 1]), at(input.triangles[c + 2])}));
  return weights;
}

std::vector<double> triangle_weights(const StripInput& input, StripWeight weight) {
  assert(input.positions.empty() || input.positions.size() == std::size_t{3} * input.wedge_count);
  if (weight == StripWeight::axis && !input.positions.empty())
    return largest_of_corners(input, [&](Index w) { return input.positions[std::size_t{3} * w]; });
  const std::vector<Index> distance = wedge_distances(input);
  return largest_of_corners(input, [&](Index w) { return static_cast<double>(distance[w]); });
}

}  // namespace

Links multi_path_links(const DualGraph& graph) { return MultiPath(graph, {}, 1).run(); }

Strips multi_path(const StripInput& input, const StripOptions&) {
  const DualGraph graph = make_dual_graph(input);
  return emit_strips(input, graph, multi_path_links(graph));
}

Strips multi_path_weighted(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  const auto costs = edge_costs(graph, triangle_weights(input, options.weight));
  return emit_strips(input, graph, MultiPath(graph, costs, kCosts).run());
}

}  // namespace pstrips::inline codecs
