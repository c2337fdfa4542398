// Quadric-ordered half-edge collapses on any triangle complex.
//
// [Garland97] the quadric error metric, [Hoppe99b] its wedge attributes, [Kim04 §5] its use as the
// order of strip-edge collapses; [Lindstrom98] the metric without a history.
#include "codecs/simplify/half_edge_collapse.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "codecs/simplify/collapse_loop.h"
#include "codecs/simplify/complex.h"
#include "codecs/simplify/constraints.h"
#include "codecs/simplify/initial_quadrics.h"
#include "codecs/simplify/new_face_distance.h"
#include "codecs/simplify/vertex_buckets.h"
#include "codecs/simplify/wedges.h"
#include "core/parallel.h"

namespace pstrips::inline codecs {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Shares of the squared length of the collapse, times the weight of what moves, in the order:
// always, so that flat places keep round triangles; per reassigned wedge; when a constraint
// refused.
constexpr float kLengthShare = 1e-9f;
constexpr float kReassignedShare = 1e-2f;
constexpr float kForcedShare = 1;

constexpr float kMaxCost = std::numeric_limits<float>::max();

// CollapseConstraint checks of one large ring in a row.
constexpr int kMaxConstraintChecks = 16;

class HalfEdgeSimplifier {
 public:
  HalfEdgeSimplifier(const SimplifyInput& input, const SimplifyOptions& options)
      : input_(input),
        options_(options),
        memoryless_(options.metric == Metric::memoryless),
        complex_(input.positions, input.wedge_vertex, input.triangles),
        wedges_(wedge_table(input, complex_.diagonal)) {
    out_.triangles_left = input.triangles.size() / 3;
    if (options.max_error >= 0) {
      const double limit = options.max_error * complex_.scale[0] * complex_.scale[1];
      most_error_ = static_cast<float>(std::min(limit * limit, 1e30));
    }
  }

  CollapseSequence run(const Progress& progress);

 private:
  // A vertex and what its collapses cost.
  struct Candidate {
    Star star;
    Quadric quadric;     // what counts for the vertex now
    float constant = 0;  // and its constant term
  };

  void fill_queue();
  bool start_plain(Index v, Candidate& at);
  void start(Index v, Candidate& at);
  bool is_one_group(const Star& star) const;
  void gather(Index q, Candidate& at);
  void weigh(Candidate& at, bool is_plain) const;
  void evaluate(Candidate& at);
  void price(Candidate& at) const;
  void price_wedges(Candidate& at);
  void apply_limit(Candidate& at) const;
  StarEdge* cheapest(Candidate& at) const;
  const StarEdge* choose(float limit);
  CollapseConstraint check(const StarEdge& edge);
  void collapse(const StarEdge& edge);
  void note_collapse(Index p, std::size_t first_move);

  const SimplifyInput& input_;
  const SimplifyOptions& options_;
  const bool memoryless_;
  Complex complex_;
  CollapseConstraints constraints_{complex_};
  std::optional<WedgeTable> wedges_;
  QuadricBuilder builder_{complex_, input_, wedges_ ? &*wedges_ : nullptr};
  std::optional<VertexBuckets> queue_;
  float most_error_ = kInfinity;  // squared, in the complex's units

  Candidate now_;
  std::vector<Index> moved_;  // corners
  float last_error_ = 0;
  CollapseSequence out_;
};

CollapseSequence HalfEdgeSimplifier::run(const Progress& progress) {
  if (out_.triangles_left <= options_.target_triangles) return std::move(out_);
  fill_queue();
  const auto try_collapse = [&](Index q) {
    gather(q, now_);
    evaluate(now_);
    const StarEdge* const edge = choose(queue_->limit());
    if (edge) collapse(*edge);
    return edge != nullptr;
  };
  collapse_until(out_, complex_, *queue_, options_.target_triangles, most_error_ < kInfinity,
                 progress, try_collapse);
  return std::move(out_);
}

// Vertices without anything special are many, and do not need one another's scratch memory.
void HalfEdgeSimplifier::fill_queue() {
  constexpr std::size_t kGrain = 4096;
  if (wedges_) builder_.add_attributes();
  std::vector<float> keys(complex_.vertex_count(), kInfinity);
  const auto least_cost = [&](Candidate& at) {
    const StarEdge* const edge = cheapest(at);
    return edge ? edge->cost : kInfinity;
  };
  constexpr float kNotYet = -1;
  parallel_for(options_.threads, keys.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Candidate at;
    for (Index v = static_cast<Index>(begin); v < end; ++v)
      if (!complex_.is_locked(v)) keys[v] = start_plain(v, at) ? least_cost(at) : kNotYet;
  });
  for (Index v = 0; v < keys.size(); ++v)
    if (keys[v] == kNotYet) {
      start(v, now_);
      keys[v] = least_cost(now_);
    }
  queue_.emplace(keys);
}

// Prepares a vertex whose faces alone count. False if it is not one.
bool HalfEdgeSimplifier::start_plain(Index v, Candidate& at) {
  if (wedges_) return false;
  complex_.gather_regular(v, at.star);
  if (!at.star.is_regular() || !is_one_group(at.star)) return false;
  at.quadric = at.star.measure();
  VertexRecord& record = complex_.vertices[v];
  if (memoryless_) {
    record.quadric.weight = at.quadric.weight;
  } else {
    if (QuadricBuilder::may_fold(at.star)) return false;
    record.quadric = at.quadric;
  }
  record.regular = true;
  evaluate(at);
  return true;
}

// The same for any vertex. None has an error yet, so the other ends need not be complete.
void HalfEdgeSimplifier::start(Index v, Candidate& at) {
  VertexRecord& record = complex_.vertices[v];
  complex_.gather(v, at.star);
  record.regular =
      at.star.open_edges == 0 && (!memoryless_ || is_one_group(at.star)) &&
      std::ranges::all_of(at.star.edges, [](const StarEdge& e) { return e.outgoing == 1; });
  const Quadric faces = at.star.measure();
  if (memoryless_) {
    record.quadric.weight += faces.weight;
  } else {
    record.quadric.add_matrix(faces);
    builder_.add_edges(at.star, record.quadric);
  }
  weigh(at, record.regular && !wedges_);
  evaluate(at);
}

bool HalfEdgeSimplifier::is_one_group(const Star& star) const {
  const auto group = [&](const IncidentCorner& s) { return input_.group[s.corner / 4]; };
  return input_.group.empty() || std::ranges::all_of(star.corners, [&](const IncidentCorner& s) {
           return group(s) == group(star.corners[0]);
         });
}

void HalfEdgeSimplifier::gather(Index q, Candidate& at) {
  const bool is_plain = complex_.vertices[q].regular && !wedges_;
  if (is_plain)
    complex_.gather_regular(q, at.star);
  else
    complex_.gather(q, at.star);
  weigh(at, is_plain);
}

// What counts: the faces that there are and what attributes demand, or all that the vertex stands
// for.
void HalfEdgeSimplifier::weigh(Candidate& at, bool is_plain) const {
  const VertexRecord& record = complex_.vertices[at.star.vertex];
  at.quadric = at.star.measure();
  if (!memoryless_) {
    at.quadric = record.quadric;
    at.constant = complex_.points[at.star.vertex].error + record.extra_error;
    return;
  }
  if (!is_plain) builder_.add_edges(at.star, at.quadric);
  at.constant = record.extra_error;
  if (input_.attribute_count == 0) return;
  const float weight = at.quadric.weight;
  at.quadric.add(record.quadric, {});
  at.quadric.weight = weight;
}

// Fills the costs of the star's edges, constraints aside.
void HalfEdgeSimplifier::evaluate(Candidate& at) {
  price(at);
  if (wedges_) price_wedges(at);
  if (most_error_ < kInfinity) apply_limit(at);
}

// Wedges and the limit aside.
void HalfEdgeSimplifier::price(Candidate& at) const {
  const Quadric& a = at.quadric;
  const float length_share = kLengthShare * a.weight;
  StarEdge* edge = at.star.edge_buffer.data();  // has room for whole groups
  for (const EdgeGroup& group : at.star.edge_groups) {
    const Vec3x4& d = group.offset;
    const Float4 x = a.xx * d.x + a.xy * d.y + a.xz * d.z + 2 * a.b.x;
    const Float4 y = a.xy * d.x + a.yy * d.y + a.yz * d.z + 2 * a.b.y;
    const Float4 z = a.xz * d.x + a.yz * d.y + a.zz * d.z + 2 * a.b.z;
    const Float4 error = max4(at.constant + (d.x * x + d.y * y + d.z * z), Float4{});
    // With the error that the other end has, the classic sum of quadrics. Without it a locked end
    // must still cost more than any number.
    const Float4 other = memoryless_ ? group.error - group.error : group.error;
    Float4 cost = error + length_share * dot(d, d) + other;
    cost = cost < kInfinity ? cost : all4(kInfinity);
    for (std::size_t i = 0; i < 4; ++i, ++edge) {
      edge->error = error[i];
      edge->cost = cost[i];
    }
  }
}

void HalfEdgeSimplifier::price_wedges(Candidate& at) {
  const float live_weight = wedges_->live_weight(at.star);
  for (StarEdge& edge : at.star.edges) {
    const Vec3f offset = complex_.offset(at.star.vertex, edge.vertex);
    const WedgeTable::Cost cost = wedges_->cost(at.star, edge);
    // The other part is in the quadric: the sum is positive but for rounding.
    const float error = std::max(cost.at(offset), -edge.error);
    edge.error += error;
    edge.cost +=
        error + cost.conflicts +
        kReassignedShare * std::max(0.f, live_weight - cost.mapped_weight) * dot(offset, offset);
  }
}

void HalfEdgeSimplifier::apply_limit(Candidate& at) const {
  const Index q = at.star.vertex;
  const float weight = complex_.vertices[q].quadric.weight;
  const float before = memoryless_ ? complex_.points[q].error - at.constant : 0;
  for (StarEdge& edge : at.star.edges) {
    const float after = before + edge.error + complex_.points[edge.vertex].error;
    if (after > most_error_ * (weight + complex_.vertices[edge.vertex].quadric.weight))
      edge.cost = kInfinity;
  }
}

// The edge that costs least, with its distance to the new faces: that counts for the weight of the
// whole star. These are computed only where they may decide. Null if the star has no edges.
StarEdge* HalfEdgeSimplifier::cheapest(Candidate& at) const {
  const bool large = at.star.corners.size() > kLargeRing;
  for (;;) {
    StarEdge* best = nullptr;
    for (StarEdge& edge : at.star.edges)
      if (!best || edge.cost < best->cost ||
          (edge.cost == best->cost && edge.vertex < best->vertex))
        best = &edge;
    if (!best || best->counts_new_faces || large || best->cost == kInfinity) return best;
    best->counts_new_faces = true;
    best->cost += at.quadric.weight *
                  squared_new_face_distance(at.star, complex_.offset(at.star.vertex, best->vertex));
  }
}

// The edge to collapse now, all others costing at least about `limit`: refused edges are made
// dearer and compared again. Null after the vertex was put back or has no edge left.
const StarEdge* HalfEdgeSimplifier::choose(float limit) {
  const Index q = now_.star.vertex;
  const bool large = now_.star.corners.size() > kLargeRing;
  for (int checks = 0;; ++checks) {
    StarEdge* const best = cheapest(now_);
    if (!best || best->cost == kInfinity) return nullptr;
    if (best->cost > limit) {
      // A large ring comes up less often when its key is too high.
      queue_->put(q, large ? std::min(2 * best->cost, kMaxCost) : best->cost);
      return nullptr;
    }
    if (best->refused != CollapseConstraint::none) return best;
    const bool give_up = large && checks == kMaxConstraintChecks;
    for (StarEdge& edge : now_.star.edges) {
      if (give_up ? edge.refused != CollapseConstraint::none : &edge != best) continue;
      edge.refused = give_up ? CollapseConstraint::flip : check(edge);
      if (edge.refused == CollapseConstraint::none) return best;
      count(out_.refused, edge.refused);
      const Vec3f offset = complex_.offset(q, edge.vertex);
      edge.cost += kForcedShare * now_.quadric.weight * dot(offset, offset);
    }
  }
}

CollapseConstraint HalfEdgeSimplifier::check(const StarEdge& edge) {
  const CollapseConstraint constraint = constraints_.check(now_.star, edge);
  return constraint == CollapseConstraint::none && wedges_ &&
                 wedges_->breaks_texture(now_.star, edge)
             ? CollapseConstraint::texture
             : constraint;
}

// What the vertices around cost now is found when they come up: errors rarely fall.
void HalfEdgeSimplifier::collapse(const StarEdge& edge) {
  const Index q = now_.star.vertex, p = edge.vertex;
  const Vec3f offset = complex_.offset(q, p);
  const std::size_t first_move = out_.moves.size();

  moved_.clear();
  for (const IncidentCorner& incident : now_.star.corners) {
    if (incident.next == p || incident.previous == p) {
      complex_.kill(incident.corner);
      --out_.triangles_left;
    } else {
      complex_.corner_vertex[incident.corner] = p;
      moved_.push_back(incident.corner);
    }
  }
  VertexRecord &from = complex_.vertices[q], &to = complex_.vertices[p];
  if (memoryless_ && input_.attribute_count > 0)
    to.extra_error +=
        from.extra_error + from.quadric.at(offset) + wedges_->cost(now_.star, edge).at(offset);
  if (wedges_)
    wedges_->collapse(complex_, now_.star, p, offset, from.quadric, out_.moves);
  else
    out_.moves.push_back({q, p});
  complex_.append(p, moved_);
  from.ring_size = 0;
  to.quadric.add(from.quadric, offset * -1);
  float& error = complex_.points[p].error;
  if (memoryless_) {  // a history that is not in the quadric
    error += complex_.points[q].error + std::max(edge.error - now_.constant, 0.f);
  } else {
    // What a large ring shows doubles at a time, or each collapse onto it would change the order of
    // all its neighbours.
    to.extra_error += edge.error;
    if (to.ring_size <= kLargeRing || to.extra_error >= error)
      error += std::exchange(to.extra_error, 0.f);
  }
  count(out_.forced, edge.refused);
  if (edge.refused != CollapseConstraint::none)
    for (const StarEdge& other : now_.star.edges) complex_.vertices[other.vertex].regular = false;
  to.regular &= from.regular;
  note_collapse(p, first_move);
}

void HalfEdgeSimplifier::note_collapse(Index p, std::size_t first_move) {
  const float weight = complex_.vertices[p].quadric.weight;
  const float sum = complex_.points[p].error + (memoryless_ ? 0 : complex_.vertices[p].extra_error);
  const float mean = weight > 0 ? std::sqrt(sum / weight) : 0;
  const double error = mean / complex_.scale[0] / complex_.scale[1];
  last_error_ = std::max(
      last_error_, static_cast<float>(std::min(error, double{std::numeric_limits<float>::max()})));
  out_.collapses.push_back(
      {now_.star.vertex, p, last_error_, static_cast<Index>(out_.moves.size() - first_move)});
}

}  // namespace

CollapseSequence simplify_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress) {
  return HalfEdgeSimplifier(input, options).run(progress);
}

}  // namespace pstrips::inline codecs
