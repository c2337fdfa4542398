// Quadric-ordered half-edge collapses on any triangle complex.
//
// [Garland97] the quadric error metric, [Hoppe99] its wedge attributes, [Kim04 §5] its use as the
// order of strip-edge collapses; [Lindstrom98] the metric without a history.
#include "codecs/simplify/half_edge.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "codecs/simplify/collapse_loop.h"
#include "codecs/simplify/complex.h"
#include "codecs/simplify/guards.h"
#include "codecs/simplify/initial_quadrics.h"
#include "codecs/simplify/vertex_heap.h"
#include "codecs/simplify/wedges.h"

namespace pstrip {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Share of the kept vertex's own error in the order. All of it is the classic sum of quadrics.
constexpr float kKeptShare = 1.f;
// Shares of the squared length of the collapse, times the weight of what moves, in the order:
// always, so that flat places keep round triangles; per carried wedge; when a guard refused.
constexpr float kLengthShare = 1e-9f;
constexpr float kCarriedShare = 1e-2f;
constexpr float kForcedShare = 1;

// Guard checks of one large ring in a row.
constexpr int kMostGuardChecks = 16;

// The error of a vertex as it counts in the order. That of a large ring moves in powers of two, or
// each collapse onto it would change the order of all its neighbours.
float rounded_down(float error) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(error) & 0xff80'0000u);
}

class HalfEdgeSimplifier {
 public:
  HalfEdgeSimplifier(const SimplifyInput& input, const SimplifyOptions& options)
      : input_(input),
        options_(options),
        memoryless_(options.metric == Metric::memoryless),
        complex_(input.positions, input.wedge_vertex, input.triangles) {
    if (!input.wedge_vertex.empty() || input.attribute_count > 0)
      wedges_.emplace(input, complex_.diagonal);
    out_.triangles_left = input.triangles.size() / 3;
    if (options.max_error >= 0) {
      const double limit = options.max_error * complex_.scale[0] * complex_.scale[1];
      most_error_ = static_cast<float>(std::min(limit * limit, 1e30));
    }
    has_extras_ = wedges_ || most_error_ < kInfinity;
  }

  CollapseSequence run(const Progress& progress);

 private:
  void fill_heap();
  bool is_on_line() const;
  void refresh(Index q);
  float evaluate(Index q);
  // A vertex that is to move, copied so that the compiler can keep it in registers.
  struct Mover {
    Quadric quadric;
    Vec3f position;
    float error;
  };
  struct Price {
    float cost;   // by which collapses are ordered
    float error;  // what the kept vertex takes over
  };
  Mover mover_of(Index q) const;
  static Price plain_price(const Mover& mover, const VertexPoint& to);
  float plain_cost(Index q, Index p) const;
  void price(const Mover& mover, StarEdge& edge);
  void price_extras(const Mover& mover, StarEdge& edge);
  void price_wedges(Vec3f offset, StarEdge& edge);
  StarEdge* next_edge(Index q, float limit);
  StarEdge* choose(Index q, float limit);
  void refuse(Index q, StarEdge& edge, Guard guard);
  void gather(Index q);
  Guard check(const StarEdge& edge);
  void collapse(Index q, const StarEdge& edge);
  void renew(Index p);
  void touch(Index x, Index q, Index p);
  void reconsider(Index x);
  void set_key(Index x, float key);

  const SimplifyInput& input_;
  const SimplifyOptions& options_;
  const bool memoryless_;
  Complex complex_;
  Guards guards_{complex_};
  std::optional<WedgeTable> wedges_;  // none when each vertex has one wedge and no attributes
  std::optional<QuadricBuilder> builder_;
  std::optional<VertexHeap> heap_;
  float most_error_ = kInfinity;  // squared, in the complex's units
  bool has_extras_ = false;       // prices need more than quadrics

  Star star_;
  float live_weight_ = 0;     // of the wedges that the star uses
  std::vector<Index> moved_;  // corners
  float last_error_ = 0;
  CollapseSequence out_;
};

CollapseSequence HalfEdgeSimplifier::run(const Progress& progress) {
  if (out_.triangles_left <= options_.target_triangles) return std::move(out_);
  fill_heap();
  collapse_until(out_, *heap_, options_.target_triangles, most_error_ < kInfinity, progress,
                 [&](Index q) {
                   const StarEdge* const edge = next_edge(q, heap_->second_key());
                   if (edge) collapse(q, *edge);
                   return edge != nullptr;
                 });
  return std::move(out_);
}

void HalfEdgeSimplifier::gather(Index q) {
  if (complex_.states[q].regular && !wedges_)
    complex_.gather_regular(q, star_);
  else
    complex_.gather(q, star_);
  // A ring that was large may not be any more.
  if (complex_.vertices[q].ring_size > kLargeRing) return;
  if (memoryless_)
    refresh(q);
  else
    complex_.points[q].error = complex_.states[q].error;
}

// Replaces the history of q by what is around it now.
void HalfEdgeSimplifier::refresh(Index q) {
  VertexState& state = complex_.states[q];
  if (!state.stale) return;
  state.stale = false;
  Quadric sum;
  for (const Spoke& spoke : star_.spokes) {
    const Vec3f n = cross(complex_.offset(q, spoke.next), complex_.offset(q, spoke.previous));
    const float length = std::sqrt(dot(n, n));
    if (length > 0) sum.add_plane(n * (1 / length), length / 2);
  }
  if (!state.regular) {
    for (const Spoke& spoke : star_.spokes) builder_->update(spoke.corner / 4);
    builder_->add_edges(star_, sum);
  }
  complex_.vertices[q].quadric = sum;
}

// Whether edges of the star count besides its faces.
bool HalfEdgeSimplifier::is_on_line() const {
  const auto group = [&](const Spoke& s) { return input_.group[s.corner / 4]; };
  if (star_.open_edges > 0 ||
      std::ranges::any_of(star_.edges, [](const StarEdge& e) { return e.outgoing != 1; }))
    return true;
  return memoryless_ && !input_.group.empty() &&
         std::ranges::any_of(star_.spokes,
                             [&](const Spoke& s) { return group(s) != group(star_.spokes[0]); });
}

void HalfEdgeSimplifier::fill_heap() {
  builder_.emplace(complex_, input_, wedges_ ? &*wedges_ : nullptr);
  std::vector<float> keys(complex_.vertex_count(), kInfinity);
  for (Index v = 0; v < keys.size(); ++v) {
    VertexRecord& record = complex_.vertices[v];
    complex_.gather(v, star_);
    complex_.states[v].regular = !is_on_line();
    builder_->add_edges(star_);
    // No vertex has an error yet, so the other ends need not be complete.
    if (!complex_.is_locked(v)) keys[v] = evaluate(v);
    record.key = keys[v];
  }
  heap_.emplace(keys);
  if (!memoryless_) builder_.reset();
}

// Fills the costs of the star's edges, guards aside; returns the least.
float HalfEdgeSimplifier::evaluate(Index q) {
  VertexRecord& record = complex_.vertices[q];
  if (wedges_) live_weight_ = wedges_->live_weight(star_);
  const Mover mover = mover_of(q);
  float least = kInfinity, others = kInfinity;
  Index best = kNone;
  for (StarEdge& edge : star_.edges) {
    price(mover, edge);
    if (edge.cost < least) {
      others = least;
      best = edge.vertex;
      least = edge.cost;
    } else {
      others = std::min(others, edge.cost);
    }
  }
  // With wedges, plain_cost() of one edge does not tell whether the others are still dearer.
  record.best = wedges_ ? kNone : best;
  record.others = wedges_ ? least : others;
  complex_.states[q].touches = 0;
  return least;
}

HalfEdgeSimplifier::Mover HalfEdgeSimplifier::mover_of(Index q) const {
  const VertexRecord& record = complex_.vertices[q];
  const VertexPoint& point = complex_.points[q];
  // The states are another cache line, and differ in large rings only.
  const float error =
      record.ring_size > kLargeRing && !memoryless_ ? complex_.states[q].error : point.error;
  return {record.quadric, point.position, error};
}

// Wedges and the limit aside.
inline HalfEdgeSimplifier::Price HalfEdgeSimplifier::plain_price(const Mover& mover,
                                                                 const VertexPoint& to) {
  const Vec3f offset = to.position - mover.position;
  const float error = std::max(mover.error + mover.quadric.at(offset), 0.f);
  const float length = kLengthShare * mover.quadric.weight * dot(offset, offset);
  return {error + length + kKeptShare * to.error, error};
}

float HalfEdgeSimplifier::plain_cost(Index q, Index p) const {
  return plain_price(mover_of(q), complex_.points[p]).cost;
}

inline void HalfEdgeSimplifier::price(const Mover& mover, StarEdge& edge) {
  const Price plain = plain_price(mover, complex_.points[edge.vertex]);
  edge.cost = plain.cost < kInfinity ? plain.cost : kInfinity;
  edge.error = plain.error;
  if (has_extras_) price_extras(mover, edge);
}

void HalfEdgeSimplifier::price_extras(const Mover& mover, StarEdge& edge) {
  if (wedges_) price_wedges(complex_.points[edge.vertex].position - mover.position, edge);
  const float weight = mover.quadric.weight + complex_.vertices[edge.vertex].quadric.weight;
  const float before = memoryless_ ? complex_.states[star_.vertex].error : 0;
  if (before + edge.error + complex_.states[edge.vertex].error > most_error_ * weight)
    edge.cost = kInfinity;
}

void HalfEdgeSimplifier::price_wedges(Vec3f offset, StarEdge& edge) {
  const WedgeTable::Cost cost = wedges_->cost(star_, edge);
  // The other part is in the quadric: the sum is positive but for rounding.
  const float error = std::max(cost.at(offset), -edge.error);
  edge.error += error;
  edge.cost +=
      error + cost.conflicts +
      kCarriedShare * std::max(0.f, live_weight_ - cost.mapped_weight) * dot(offset, offset);
}

// The edge to collapse now that q is on top of the heap, all others having a key of at least
// `limit`. Null after q was put back under a better bound or dropped.
StarEdge* HalfEdgeSimplifier::next_edge(Index q, float limit) {
  VertexRecord& record = complex_.vertices[q];
  if (record.best == kNone) {
    gather(q);
    evaluate(q);
    return choose(q, limit);
  }
  const float cost = plain_cost(q, record.best);
  if (std::min(cost, record.others) > limit) {
    if (cost > record.others) record.best = kNone;
    set_key(q, std::min(cost, record.others));
    return nullptr;
  }
  const Index best = record.best;
  const bool was_stale = complex_.states[q].stale;
  complex_.prefetch_ring(best);
  gather(q);
  for (const StarEdge& edge : star_.edges) complex_.prefetch_record(edge.vertex);
  complex_.prefetch_triangles(best);
  if (cost <= record.others && !was_stale) {
    const auto edge = std::ranges::find(star_.edges, best, &StarEdge::vertex);
    if (edge != star_.edges.end()) {
      price(mover_of(q), *edge);
      const Guard refused = edge->cost < kInfinity ? check(*edge) : Guard::none;
      if (refused == Guard::none && edge->cost < kInfinity) return &*edge;
      evaluate(q);
      if (refused != Guard::none) refuse(q, *edge, refused);
      return choose(q, limit);
    }
  }
  evaluate(q);
  return choose(q, limit);
}

// Refused edges are made dearer and compared again.
StarEdge* HalfEdgeSimplifier::choose(Index q, float limit) {
  VertexRecord& record = complex_.vertices[q];
  const bool large = star_.spokes.size() > kLargeRing;
  for (int checks = 0;; ++checks) {
    StarEdge* best = nullptr;
    for (StarEdge& edge : star_.edges)
      if (!best || edge.cost < best->cost ||
          (edge.cost == best->cost && edge.vertex < best->vertex))
        best = &edge;
    if (!best || best->cost == kInfinity) {
      heap_->remove(q);
      record.key = kInfinity;
      return nullptr;
    }
    if (best->cost > limit) {
      // A large ring comes up less often when its key is a little too high.
      set_key(q, large ? best->cost * 1.25f : best->cost);
      return nullptr;
    }
    if (best->refused != Guard::none) return best;
    const bool give_up = large && checks == kMostGuardChecks;
    for (StarEdge& edge : star_.edges) {
      if (give_up ? edge.refused != Guard::none : &edge != best) continue;
      const Guard refused = give_up ? Guard::flip : check(edge);
      if (refused == Guard::none) return best;
      refuse(q, edge, refused);
    }
  }
}

// From here on the bound of q holds without guards only.
void HalfEdgeSimplifier::refuse(Index q, StarEdge& edge, Guard guard) {
  VertexRecord& record = complex_.vertices[q];
  if (record.best != kNone) record.others = std::min(record.others, plain_cost(q, record.best));
  record.best = kNone;
  edge.refused = guard;
  const Vec3f offset = complex_.offset(q, edge.vertex);
  edge.cost += kForcedShare * record.quadric.weight * dot(offset, offset);
}

Guard HalfEdgeSimplifier::check(const StarEdge& edge) {
  Guard guard = guards_.check(star_, edge);
  if (guard == Guard::none && wedges_ && wedges_->breaks_texture(star_, edge))
    guard = Guard::texture;
  count(out_.refused, guard);
  return guard;
}

void HalfEdgeSimplifier::collapse(Index q, const StarEdge& edge) {
  const Index p = edge.vertex;
  VertexRecord &from = complex_.vertices[q], &to = complex_.vertices[p];
  const Vec3f offset = complex_.offset(q, p);
  const std::size_t first_move = out_.moves.size();

  moved_.clear();
  for (const Spoke& spoke : star_.spokes) {
    if (spoke.next == p || spoke.previous == p) {
      complex_.kill(spoke.corner);
      --out_.triangles_left;
    } else {
      complex_.corner_vertex[spoke.corner] = p;
      moved_.push_back(spoke.corner);
    }
  }
  if (wedges_)
    wedges_->collapse(complex_, star_, p, offset, from.quadric, out_.moves);
  else
    out_.moves.push_back({q, p});
  complex_.append(p, moved_);
  from.ring_size = 0;
  heap_->remove(q);

  to.quadric.add(from.quadric, offset * -1);
  VertexState& state = complex_.states[p];
  state.error += edge.error;
  if (memoryless_)
    state.error += complex_.states[q].error;
  else
    complex_.points[p].error = to.ring_size > kLargeRing ? rounded_down(state.error) : state.error;
  const float weight = to.quadric.weight;
  const float mean = weight > 0 ? std::sqrt(state.error / weight) : 0;
  const double error = mean / complex_.scale[0] / complex_.scale[1];
  last_error_ = std::max(
      last_error_, static_cast<float>(std::min(error, double{std::numeric_limits<float>::max()})));
  out_.collapses.push_back({q, p, last_error_, static_cast<Index>(out_.moves.size() - first_move)});
  count(out_.forced, edge.refused);
  if (edge.refused != Guard::none) {
    state.regular = false;
    for (const StarEdge& other : star_.edges) complex_.states[other.vertex].regular = false;
  }
  state.regular &= complex_.states[q].regular;
  if (memoryless_)
    for (const StarEdge& other : star_.edges) complex_.states[other.vertex].stale = true;
  for (const StarEdge& other : star_.edges)
    if (other.vertex != p) touch(other.vertex, q, p);
  renew(p);
}

// All edges of p are dearer than they were; those it took over, on the star, are new.
void HalfEdgeSimplifier::renew(Index p) {
  VertexRecord& record = complex_.vertices[p];
  if (record.key == kInfinity) return;
  if (record.ring_size <= kLargeRing) {
    gather(p);
    const float least = evaluate(p);
    if (least < kInfinity) return set_key(p, least);
    heap_->remove(p);
    record.key = kInfinity;
    return;
  }
  float bound = record.best == kNone ? record.others : std::min(record.key, record.others);
  for (const StarEdge& edge : star_.edges)
    if (edge.vertex != p) bound = std::min(bound, plain_cost(p, edge.vertex));
  record.best = kNone;
  record.others = bound;
  reconsider(p);
}

// Around x, q has gone to p, which may be a new neighbour. What else was known of x still holds,
// as errors do not fall.
void HalfEdgeSimplifier::touch(Index x, Index q, Index p) {
  VertexRecord& record = complex_.vertices[x];
  if (record.key == kInfinity) return;  // left the heap
  const float cost = plain_cost(x, p);
  if (record.best == kNone) {
    record.others = std::min(record.others, cost);
    reconsider(x);
    return;
  }
  if (record.best == q) {
    record.best = cost <= record.others ? p : kNone;
  } else if (cost < record.key) {
    if (record.best != p) record.others = std::min(record.others, record.key);
    record.best = p;
  } else if (record.best != p) {
    record.others = std::min(record.others, cost);
  }
  if (cost < record.key) set_key(x, cost);
}

// A vertex whose best edge is not known may come up as early as its bound allows, since its guards
// may answer differently now.
void HalfEdgeSimplifier::reconsider(Index x) {
  VertexRecord& record = complex_.vertices[x];
  if (record.key == kInfinity || record.others >= record.key) return;
  VertexState& state = complex_.states[x];
  if (record.ring_size > kLargeRing && ++state.touches < std::min(record.ring_size / 8, 0xffffu))
    return;
  state.touches = 0;
  set_key(x, record.others);
}

void HalfEdgeSimplifier::set_key(Index x, float key) {
  complex_.vertices[x].key = key;
  heap_->update(x, key);
}

}  // namespace

CollapseSequence simplify_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress) {
  return HalfEdgeSimplifier(input, options).run(progress);
}

}  // namespace pstrip
