// Quadric-ordered half-edge collapses on any triangle complex.
//
// [Garland97] the quadric error metric, [Hoppe99] its wedge attributes, [Kim04 §5] its use as the
// order of strip-edge collapses; [Lindstrom98] the metric without a history.
#include "codecs/simplify/half_edge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "codecs/simplify/collapse_loop.h"
#include "codecs/simplify/complex.h"
#include "codecs/simplify/guards.h"
#include "codecs/simplify/initial_quadrics.h"
#include "codecs/simplify/vertex_buckets.h"
#include "codecs/simplify/wedges.h"

namespace pstrip {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Shares of the squared length of the collapse, times the weight of what moves, in the order:
// always, so that flat places keep round triangles; per carried wedge; when a guard refused.
constexpr float kLengthShare = 1e-9f;
constexpr float kCarriedShare = 1e-2f;
constexpr float kForcedShare = 1;

// Guard checks of one large ring in a row.
constexpr int kMostGuardChecks = 16;

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
  void fill_queue();
  bool has_lines() const;
  void gather(Index q);
  void evaluate();
  float least_cost() const;
  void price(std::size_t first, const EdgeGroup& group);
  void price_wedges();
  void apply_limit();
  const StarEdge* choose(float limit);
  Guard check(const StarEdge& edge);
  void collapse(const StarEdge& edge);
  void note_collapse(Index p, std::size_t first_move);

  const SimplifyInput& input_;
  const SimplifyOptions& options_;
  const bool memoryless_;
  Complex complex_;
  Guards guards_{complex_};
  std::optional<WedgeTable> wedges_;
  QuadricBuilder builder_{complex_, input_, wedges_ ? &*wedges_ : nullptr};
  std::optional<VertexBuckets> queue_;
  float most_error_ = kInfinity;  // squared, in the complex's units

  Star star_;
  Quadric quadric_;           // what counts for the star's vertex now
  float constant_ = 0;        // and its constant term
  std::vector<Index> moved_;  // corners
  float last_error_ = 0;
  CollapseSequence out_;
};

CollapseSequence HalfEdgeSimplifier::run(const Progress& progress) {
  if (out_.triangles_left <= options_.target_triangles) return std::move(out_);
  fill_queue();
  const auto try_collapse = [&](Index q) {
    gather(q);
    evaluate();
    const StarEdge* const edge = choose(queue_->limit());
    if (edge) collapse(*edge);
    return edge != nullptr;
  };
  collapse_until(out_, complex_, *queue_, options_.target_triangles, most_error_ < kInfinity,
                 progress, try_collapse);
  return std::move(out_);
}

void HalfEdgeSimplifier::fill_queue() {
  if (wedges_) builder_.add_attributes();
  std::vector<float> keys(complex_.vertex_count(), kInfinity);
  for (Index v = 0; v < keys.size(); ++v) {
    if (complex_.is_locked(v)) continue;
    VertexRecord& record = complex_.vertices[v];
    complex_.gather(v, star_);
    record.regular = !has_lines();
    const Quadric faces = star_.measure();
    if (memoryless_) {
      record.quadric.weight += faces.weight;
    } else {
      record.quadric.add_matrix(faces);
      builder_.add_edges(star_, record.quadric);
    }
    gather(v);
    // No vertex has an error yet, so the other ends need not be complete.
    evaluate();
    keys[v] = least_cost();
  }
  queue_.emplace(keys);
}

// Whether edges of the star count besides its faces.
bool HalfEdgeSimplifier::has_lines() const {
  const auto group = [&](const Spoke& s) { return input_.group[s.corner / 4]; };
  if (star_.open_edges > 0 ||
      std::ranges::any_of(star_.edges, [](const StarEdge& e) { return e.outgoing != 1; }))
    return true;
  return memoryless_ && !input_.group.empty() &&
         std::ranges::any_of(star_.spokes,
                             [&](const Spoke& s) { return group(s) != group(star_.spokes[0]); });
}

// The star of q and its quadric: of the faces that there are and what attributes demand, or of all
// that it stands for.
void HalfEdgeSimplifier::gather(Index q) {
  const VertexRecord& record = complex_.vertices[q];
  const bool is_plain = record.regular && !wedges_;
  if (is_plain)
    complex_.gather_regular(q, star_);
  else
    complex_.gather(q, star_);
  quadric_ = star_.measure();
  if (!memoryless_) {
    quadric_ = record.quadric;
    constant_ = complex_.points[q].error;
    return;
  }
  if (!is_plain) builder_.add_edges(star_, quadric_);
  constant_ = record.attribute_error;
  if (input_.attribute_count == 0) return;
  const float weight = quadric_.weight;
  quadric_.add(record.quadric, {});
  quadric_.weight = weight;
}

// Fills the costs of the star's edges, guards aside.
void HalfEdgeSimplifier::evaluate() {
  for (std::size_t g = 0; g < star_.edge_groups.size(); ++g) price(4 * g, star_.edge_groups[g]);
  if (wedges_) price_wedges();
  if (most_error_ < kInfinity) apply_limit();
}

float HalfEdgeSimplifier::least_cost() const {
  float least = kInfinity;
  for (const StarEdge& edge : star_.edges) least = std::min(least, edge.cost);
  return least;
}

// Wedges and the limit aside.
inline void HalfEdgeSimplifier::price(std::size_t first, const EdgeGroup& group) {
  const Quadric& a = quadric_;
  const Vec3x4& d = group.offset;
  const Float4 x = a.xx * d.x + a.xy * d.y + a.xz * d.z + 2 * a.b.x;
  const Float4 y = a.xy * d.x + a.yy * d.y + a.yz * d.z + 2 * a.b.y;
  const Float4 z = a.xz * d.x + a.yz * d.y + a.zz * d.z + 2 * a.b.z;
  const Float4 error = max4(constant_ + (d.x * x + d.y * y + d.z * z), Float4{});
  // With the error that the other end has, the classic sum of quadrics. Without it a locked end
  // must still cost more than any number.
  const Float4 other = memoryless_ ? group.error - group.error : group.error;
  const Float4 cost = error + kLengthShare * a.weight * dot(d, d) + other;
  const std::size_t n = std::min<std::size_t>(4, star_.edges.size() - first);
  for (std::size_t i = 0; i < n; ++i) {
    StarEdge& edge = star_.edges[first + i];
    edge.error = error[i];
    edge.cost = cost[i] < kInfinity ? cost[i] : kInfinity;
  }
}

void HalfEdgeSimplifier::price_wedges() {
  const float live_weight = wedges_->live_weight(star_);
  for (StarEdge& edge : star_.edges) {
    const Vec3f offset = complex_.offset(star_.vertex, edge.vertex);
    const WedgeTable::Cost cost = wedges_->cost(star_, edge);
    // The other part is in the quadric: the sum is positive but for rounding.
    const float error = std::max(cost.at(offset), -edge.error);
    edge.error += error;
    edge.cost +=
        error + cost.conflicts +
        kCarriedShare * std::max(0.f, live_weight - cost.mapped_weight) * dot(offset, offset);
  }
}

void HalfEdgeSimplifier::apply_limit() {
  const float weight = complex_.vertices[star_.vertex].quadric.weight;
  const float before = memoryless_ ? complex_.points[star_.vertex].error - constant_ : 0;
  for (StarEdge& edge : star_.edges) {
    const float after = before + edge.error + complex_.points[edge.vertex].error;
    if (after > most_error_ * (weight + complex_.vertices[edge.vertex].quadric.weight))
      edge.cost = kInfinity;
  }
}

// The edge to collapse now, all others costing at least about `limit`: refused edges are made
// dearer and compared again. Null after the vertex was put back or has no edge left.
const StarEdge* HalfEdgeSimplifier::choose(float limit) {
  const Index q = star_.vertex;
  const bool large = star_.spokes.size() > kLargeRing;
  for (int checks = 0;; ++checks) {
    StarEdge* best = nullptr;
    for (StarEdge& edge : star_.edges)
      if (!best || edge.cost < best->cost ||
          (edge.cost == best->cost && edge.vertex < best->vertex))
        best = &edge;
    if (!best || best->cost == kInfinity) return nullptr;
    if (best->cost > limit) {
      // A large ring comes up less often when its key is a little too high.
      queue_->put(q, large ? best->cost * 1.25f : best->cost);
      return nullptr;
    }
    if (best->refused != Guard::none) return best;
    const bool give_up = large && checks == kMostGuardChecks;
    for (StarEdge& edge : star_.edges) {
      if (give_up ? edge.refused != Guard::none : &edge != best) continue;
      edge.refused = give_up ? Guard::flip : check(edge);
      if (edge.refused == Guard::none) return best;
      count(out_.refused, edge.refused);
      const Vec3f offset = complex_.offset(q, edge.vertex);
      edge.cost += kForcedShare * quadric_.weight * dot(offset, offset);
    }
  }
}

Guard HalfEdgeSimplifier::check(const StarEdge& edge) {
  const Guard guard = guards_.check(star_, edge);
  return guard == Guard::none && wedges_ && wedges_->breaks_texture(star_, edge) ? Guard::texture
                                                                                 : guard;
}

// What the vertices around cost now is found when they come up: errors rarely fall.
void HalfEdgeSimplifier::collapse(const StarEdge& edge) {
  const Index q = star_.vertex, p = edge.vertex;
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
  VertexRecord &from = complex_.vertices[q], &to = complex_.vertices[p];
  if (memoryless_ && input_.attribute_count > 0)
    to.attribute_error +=
        from.attribute_error + from.quadric.at(offset) + wedges_->cost(star_, edge).at(offset);
  if (wedges_)
    wedges_->collapse(complex_, star_, p, offset, from.quadric, out_.moves);
  else
    out_.moves.push_back({q, p});
  complex_.append(p, moved_);
  from.ring_size = 0;
  to.quadric.add(from.quadric, offset * -1);
  // A history that is not in the quadric grows by each step's error.
  complex_.points[p].error +=
      memoryless_ ? complex_.points[q].error + std::max(edge.error - constant_, 0.f) : edge.error;
  count(out_.forced, edge.refused);
  if (edge.refused != Guard::none)
    for (const StarEdge& other : star_.edges) complex_.vertices[other.vertex].regular = false;
  to.regular &= from.regular;
  note_collapse(p, first_move);
}

void HalfEdgeSimplifier::note_collapse(Index p, std::size_t first_move) {
  const float weight = complex_.vertices[p].quadric.weight;
  const float mean = weight > 0 ? std::sqrt(complex_.points[p].error / weight) : 0;
  const double error = mean / complex_.scale[0] / complex_.scale[1];
  last_error_ = std::max(
      last_error_, static_cast<float>(std::min(error, double{std::numeric_limits<float>::max()})));
  out_.collapses.push_back(
      {star_.vertex, p, last_error_, static_cast<Index>(out_.moves.size() - first_move)});
}

}  // namespace

CollapseSequence simplify_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress) {
  return HalfEdgeSimplifier(input, options).run(progress);
}

}  // namespace pstrip
