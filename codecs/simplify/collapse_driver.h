#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "codecs/simplify/batch_gate.h"
#include "codecs/simplify/complex.h"
#include "codecs/simplify/component_guard.h"
#include "codecs/simplify/constraints.h"
#include "codecs/simplify/initial_quadrics.h"
#include "codecs/simplify/simplify.h"
#include "codecs/simplify/vertex_buckets.h"
#include "codecs/simplify/wedges.h"

namespace pstrips::inline codecs {

/// Of what is not to be collapsed.
inline constexpr float kInfiniteCost = std::numeric_limits<float>::infinity();

/// Shares of the squared length of a collapse, times the weight of what moves, that count beside
/// its error: always, so that flat places keep round triangles; per reassigned wedge; when a
/// constraint refused.
inline constexpr float kLengthShare = 1e-9f;
inline constexpr float kReassignedShare = 1e-2f;
inline constexpr float kForcedShare = 1;

/// What a sequence of collapses works on and has reached, however they are priced.
struct CollapseState {
  /// Both must outlive it.
  CollapseState(const SimplifyInput& input, const SimplifyOptions& options);
  CollapseState(const CollapseState&) = delete;
  CollapseState& operator=(const CollapseState&) = delete;

  bool is_done() const { return out.triangles_left <= target_triangles; }
  bool is_limited() const { return max_squared_error < kInfiniteCost; }

  /// Removes the triangles between the star's vertex and `kept` and gives the corners of the others
  /// to `kept`: these are `moved_corners`.
  void move_corners(const Star& star, Index kept);
  /// Moves wedges, too, and adds their moves to the sequence. As WedgeTable::collapse().
  void move_wedges(const Star& star, Index kept, Vec3f offset, Quadric& quadric);
  /// Gives `moved_corners` to the ring of the edge's end, and brings regularity and the count of
  /// forced collapses up to date.
  void join_rings(const Star& star, const StarEdge& edge);
  /// Adds a collapse to the sequence, whose wedge moves are there from `first_move` on.
  /// squared_error  of all that the kept vertex stands for, times its weight
  void add_collapse(Index removed, Index kept, float squared_error, std::size_t first_move);

  const SimplifyInput& input;
  const SimplifyOptions& options;
  const bool memoryless;
  Complex complex;
  CollapseConstraints constraints{complex};
  std::optional<WedgeTable> wedges;
  QuadricBuilder builder{complex, input, wedges ? &*wedges : nullptr};
  std::optional<VertexBuckets> queue;
  std::optional<BatchGate> batches;
  std::optional<ComponentGuard> guard;
  std::uint64_t target_triangles;
  float max_squared_error = kInfiniteCost;  ///< in the complex's units
  std::vector<Index> moved_corners;
  float last_error = 0;
  CollapseSequence out;
};

/// How collapses are priced and carried out.
template <class P>
concept CollapsePricer = requires(P& pricer, Index vertex, const StarEdge& edge, float cost) {
  { pricer.first_keys() } -> std::same_as<std::vector<float>>;  // of all vertices; may be infinite
  { pricer.price(vertex) } -> std::same_as<Star&>;              // gathers a vertex's edges, too
  { pricer.cheapest() } -> std::same_as<StarEdge*>;             // of these; null: there are none
  { pricer.check(edge) } -> std::same_as<CollapseConstraint>;   // of these
  { pricer.is_large() } -> std::same_as<bool>;                  // whether the vertex has too many
  { pricer.weight() } -> std::same_as<float>;                   // of what its collapse moves
  pricer.put_back(vertex, cost);
  pricer.drop(vertex);  // out of the queue until it gets another edge
  pricer.collapse(edge);
  { P::kLargeRingDelay } -> std::convertible_to<float>;  // keys of large rings times this
};

/// Prefetches the data of the vertices that come next: step by step, since where the one is stands
/// in the other. Always inline: GCC takes a function that only prefetches for one without effect
/// and drops its calls.
[[gnu::always_inline]] inline void look_ahead(const Complex& complex, const VertexBuckets& queue) {
  if (const Index v = queue.ahead(12); v != kNone) complex.prefetch_record(v);
  if (const Index v = queue.ahead(9); v != kNone) complex.prefetch_ring(v);
  if (const Index v = queue.ahead(6); v != kNone) complex.prefetch_triangles(v);
  if (const Index v = queue.ahead(3); v != kNone) complex.prefetch_neighbours(v);
}

/// Leaves out the edges of a star that its component cannot do without.
inline void leave_out_needed(const ComponentGuard& guard, const Star& star) {
  for (StarEdge& edge : star.edges)
    if (!guard.can_lose(star.vertex, edge.triangles)) edge.cost = kInfiniteCost;
}

/// Leaves out the edges of a star whose ends the batch has taken; false if there are none.
template <CollapsePricer Pricer>
bool leave_out_taken(BatchGate& batches, Pricer& pricer, const Star& star) {
  const StarEdge* const best = pricer.cheapest();
  batches.set_key(star.vertex, best ? best->cost : kInfiniteCost);
  bool any = false;
  for (StarEdge& edge : star.edges) {
    if (!batches.is_taken(edge.vertex)) continue;
    edge.cost = kInfiniteCost;
    any = true;
  }
  return any;
}

/// The edge at a vertex to collapse now, where no other vertex has a key below the queue's limit.
/// Edges that a constraint refuses are made dearer and compared again. Null after the vertex was
/// put back or dropped.
template <CollapsePricer Pricer>
const StarEdge* choose_edge(CollapseState& state, Pricer& pricer, Index vertex) {
  constexpr int kMaxConstraintChecks = 16;  // of one large ring in a row
  const Star& star = pricer.price(vertex);
  const bool large = pricer.is_large();
  if (state.guard) leave_out_needed(*state.guard, star);
  const bool waits = state.batches && leave_out_taken(*state.batches, pricer, star);
  for (int checks = 0;; ++checks) {
    StarEdge* const best = pricer.cheapest();
    if (!best || best->cost == kInfiniteCost) {
      if (!waits) pricer.drop(vertex);
      return nullptr;
    }
    if (best->cost > state.queue->limit()) {
      // A large ring comes up less often when its key is too high.
      constexpr float kMaxCost = std::numeric_limits<float>::max();
      pricer.put_back(
          vertex, large ? std::min(Pricer::kLargeRingDelay * best->cost, kMaxCost) : best->cost);
      return nullptr;
    }
    if (best->refused != CollapseConstraint::none) return best;
    const bool give_up = large && checks == kMaxConstraintChecks;
    for (StarEdge& edge : star.edges) {
      if (give_up ? edge.refused != CollapseConstraint::none : &edge != best) continue;
      edge.refused = give_up ? CollapseConstraint::flip : pricer.check(edge);
      if (edge.refused == CollapseConstraint::none) return best;
      count(state.out.refused, edge.refused);
      const Vec3f offset = state.complex.offset(vertex, edge.vertex);
      edge.cost += kForcedShare * pricer.weight() * dot(offset, offset);
    }
  }
}

/// The vertex to look at now; kNone when there is none.
inline Index next_vertex(CollapseState& state) {
  for (;;) {
    const Index vertex = state.queue->pop();
    if (!state.batches) return vertex;
    if (vertex == kNone || state.batches->is_full(*state.queue)) {
      if (state.batches->is_empty()) return kNone;
      if (!state.batches->is_stuck()) {
        state.queue.emplace(state.batches->next_batch());
        continue;
      }
      state.queue.emplace(state.batches->keys());
      state.batches.reset();
    } else if (!state.batches->is_taken(vertex)) {
      return vertex;
    }
  }
}

/// Collapses what is next in the queue until one of SimplifyStop's reasons ends the sequence.
template <CollapsePricer Pricer>
void collapse_until_stop(CollapseState& state, Pricer& pricer, const Progress& progress) {
  constexpr std::size_t kProgressInterval = 4096;
  CollapseSequence& out = state.out;
  const std::uint64_t start = out.triangles_left, target = state.target_triangles;
  out.stop = SimplifyStop::exhausted;
  for (Index vertex; (vertex = next_vertex(state)) != kNone;) {
    look_ahead(state.complex, *state.queue);
    const StarEdge* const edge = choose_edge(state, pricer, vertex);
    if (!edge) continue;
    if (state.batches) state.batches->take(vertex, edge->vertex);
    pricer.collapse(*edge);
    if (state.is_done()) {
      out.stop = SimplifyStop::target;
      return;
    }
    if (progress && out.collapses.size() % kProgressInterval == 0 &&
        !progress("simplify", static_cast<double>(start - out.triangles_left) /
                                  static_cast<double>(start - target))) {
      out.stop = SimplifyStop::interrupted;
      return;
    }
  }
  if (out.triangles_left > 0 && state.is_limited()) out.stop = SimplifyStop::max_error;
}

/// simplify() with a pricer of its own.
template <CollapsePricer Pricer>
CollapseSequence collapse_by(const SimplifyInput& input, const SimplifyOptions& options,
                             const Progress& progress) {
  CollapseState state(input, options);
  if (!state.is_done()) {
    Pricer pricer(state);
    std::vector<float> keys = pricer.first_keys();
    if (options.in_batches && options.placement == Placement::subset) {
      state.batches.emplace(BatchSchedule::of(options.order), std::move(keys));
      state.queue.emplace(state.batches->next_batch());
    } else {
      state.queue.emplace(keys);
    }
    collapse_until_stop(state, pricer, progress);
  }
  return std::move(state.out);
}

}  // namespace pstrips::inline codecs
