// Quadric-ordered half-edge collapses on any triangle complex.
//
// [Garland97] the quadric error metric, [Hoppe99b] its wedge attributes, [Kim04 §5] its use as the
// order of strip-edge collapses; [Lindstrom98] the metric without a history.
#include "codecs/simplify/half_edge_collapse.h"

#include <algorithm>
#include <utility>

#include "codecs/simplify/collapse_driver.h"
#include "codecs/simplify/new_face_distance.h"
#include "core/parallel.h"

namespace pstrips::inline codecs {
namespace {

class HalfEdgePricer {
 public:
  explicit HalfEdgePricer(CollapseState& state) : s_(state) {}

  std::vector<float> first_keys();
  Star& price(Index q);
  StarEdge* cheapest() { return cheapest(now_); }
  CollapseConstraint check(const StarEdge& edge);
  bool is_large() const { return now_.star.corners.size() > kLargeRing; }
  float weight() const { return now_.quadric.weight; }
  void put_back(Index q, float cost) { s_.queue->put(q, cost); }
  void drop(Index) {}
  void collapse(const StarEdge& edge);

  static constexpr float kLargeRingDelay = 2;

 private:
  // A vertex and what its collapses cost.
  struct Candidate {
    Star star;
    Quadric quadric;     // what counts for the vertex now
    float constant = 0;  // and its constant term
  };

  bool start_plain(Index v, Candidate& at);
  void start(Index v, Candidate& at);
  bool is_one_group(const Star& star) const;
  void weigh(Candidate& at, bool is_plain) const;
  void evaluate(Candidate& at);
  void price_shape(Candidate& at) const;
  void price_wedges(Candidate& at);
  bool is_early() const;
  void price_bits(Candidate& at) const;
  void apply_limit(Candidate& at) const;
  StarEdge* cheapest(Candidate& at) const;
  void add_error(const StarEdge& edge);

  CollapseState& s_;
  Candidate now_;
};

// Vertices without anything special are many, and do not need one another's scratch memory.
std::vector<float> HalfEdgePricer::first_keys() {
  constexpr std::size_t kGrain = 4096;
  if (s_.wedges) s_.builder.add_attributes();
  std::vector<float> keys(s_.complex.vertex_count(), kInfiniteCost);
  const auto least_cost = [&](Candidate& at) {
    const StarEdge* const edge = cheapest(at);
    return edge ? edge->cost : kInfiniteCost;
  };
  constexpr float kNotYet = -1;
  parallel_for(s_.options.threads, keys.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Candidate at;
    for (Index v = static_cast<Index>(begin); v < end; ++v)
      if (!s_.complex.is_locked(v)) keys[v] = start_plain(v, at) ? least_cost(at) : kNotYet;
  });
  for (Index v = 0; v < keys.size(); ++v)
    if (keys[v] == kNotYet) {
      start(v, now_);
      keys[v] = least_cost(now_);
    }
  return keys;
}

// Prepares a vertex whose faces alone count. False if it is not one.
bool HalfEdgePricer::start_plain(Index v, Candidate& at) {
  if (s_.wedges) return false;
  s_.complex.gather_regular(v, at.star);
  if (!at.star.is_regular() || !is_one_group(at.star)) return false;
  at.quadric = at.star.measure();
  VertexRecord& record = s_.complex.vertices[v];
  if (s_.memoryless) {
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
void HalfEdgePricer::start(Index v, Candidate& at) {
  VertexRecord& record = s_.complex.vertices[v];
  s_.complex.gather(v, at.star);
  record.regular =
      at.star.open_edges == 0 && (!s_.memoryless || is_one_group(at.star)) &&
      std::ranges::all_of(at.star.edges, [](const StarEdge& e) { return e.outgoing == 1; });
  const Quadric faces = at.star.measure();
  if (s_.memoryless) {
    record.quadric.weight += faces.weight;
  } else {
    record.quadric.add_matrix(faces);
    s_.builder.add_edges(at.star, record.quadric);
  }
  weigh(at, record.regular && !s_.wedges);
  evaluate(at);
}

bool HalfEdgePricer::is_one_group(const Star& star) const {
  const auto& groups = s_.input.group;
  const auto group = [&](const IncidentCorner& i) { return groups[i.corner / 4]; };
  return groups.empty() || std::ranges::all_of(star.corners, [&](const IncidentCorner& i) {
           return group(i) == group(star.corners[0]);
         });
}

Star& HalfEdgePricer::price(Index q) {
  const bool is_plain = s_.complex.vertices[q].regular && !s_.wedges;
  if (is_plain)
    s_.complex.gather_regular(q, now_.star);
  else
    s_.complex.gather(q, now_.star);
  weigh(now_, is_plain);
  evaluate(now_);
  return now_.star;
}

// What counts: the faces that there are and what attributes demand, or all that the vertex stands
// for.
void HalfEdgePricer::weigh(Candidate& at, bool is_plain) const {
  const VertexRecord& record = s_.complex.vertices[at.star.vertex];
  at.quadric = at.star.measure();
  if (!s_.memoryless) {
    at.quadric = record.quadric;
    at.constant = s_.complex.points[at.star.vertex].error + record.extra_error;
    return;
  }
  if (!is_plain) s_.builder.add_edges(at.star, at.quadric);
  at.constant = record.extra_error;
  if (s_.input.attribute_count == 0) return;
  const float weight = at.quadric.weight;
  at.quadric.add(record.quadric, {});
  at.quadric.weight = weight;
}

// Fills the costs of the star's edges, constraints aside.
void HalfEdgePricer::evaluate(Candidate& at) {
  price_shape(at);
  if (s_.wedges) price_wedges(at);
  if (s_.options.order == CollapseOrder::bits && is_early()) price_bits(at);
  if (s_.is_limited()) apply_limit(at);
}

// Wedges and the limit aside.
void HalfEdgePricer::price_shape(Candidate& at) const {
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
    const Float4 other = s_.memoryless ? group.error - group.error : group.error;
    Float4 cost = error + length_share * dot(d, d) + other;
    cost = cost < kInfiniteCost ? cost : all4(kInfiniteCost);
    for (std::size_t i = 0; i < 4; ++i, ++edge) {
      edge->error = error[i];
      edge->cost = cost[i];
    }
  }
}

void HalfEdgePricer::price_wedges(Candidate& at) {
  const float live_weight = s_.wedges->live_weight(at.star);
  for (StarEdge& edge : at.star.edges) {
    const Vec3f offset = s_.complex.offset(at.star.vertex, edge.vertex);
    const WedgeTable::Cost cost = s_.wedges->cost(at.star, edge);
    // The other part is in the quadric: the sum is positive but for rounding.
    const float error = std::max(cost.at(offset), -edge.error);
    edge.error += error;
    edge.cost +=
        error + cost.conflicts +
        kReassignedShare * std::max(0.f, live_weight - cost.mapped_weight) * dot(offset, offset);
  }
}

// Whether nobody sees yet which vertex goes first.
bool HalfEdgePricer::is_early() const {
  return s_.out.collapses.size() < s_.complex.vertex_count() / 10 * std::size_t{7};
}

// A vertex off the middle of its ring, at the end of a long edge, is hard to guess. That counts as
// an error does, but for no more than a few times the error: flat places stay flat.
void HalfEdgePricer::price_bits(Candidate& at) const {
  constexpr float kShare = 0.03f, kMost = 10;
  const Star& star = at.star;
  if (star.edges.empty()) return;
  Vec3f sum = {};
  for (const StarEdge& edge : star.edges) sum = sum + s_.complex.offset(star.vertex, edge.vertex);
  const Vec3f middle = sum * (1 / static_cast<float>(star.edges.size()));
  const float share = kShare * dot(middle, middle);
  for (StarEdge& edge : star.edges) {
    const Vec3f offset = s_.complex.offset(star.vertex, edge.vertex);
    edge.cost += std::min(share * dot(offset, offset), kMost * edge.cost);
  }
}

void HalfEdgePricer::apply_limit(Candidate& at) const {
  const Index q = at.star.vertex;
  const float weight = s_.complex.vertices[q].quadric.weight;
  const float before = s_.memoryless ? s_.complex.points[q].error - at.constant : 0;
  for (StarEdge& edge : at.star.edges) {
    const float after = before + edge.error + s_.complex.points[edge.vertex].error;
    if (after > s_.max_squared_error * (weight + s_.complex.vertices[edge.vertex].quadric.weight))
      edge.cost = kInfiniteCost;
  }
}

// The edge that costs least, with its distance to the new faces: that counts for the weight of the
// whole star. It is computed only where it may decide. Null if the star has no edges.
StarEdge* HalfEdgePricer::cheapest(Candidate& at) const {
  const bool large = at.star.corners.size() > kLargeRing;
  for (;;) {
    StarEdge* const best = at.star.cheapest();
    if (!best || best->counts_new_faces || large || best->cost == kInfiniteCost) return best;
    best->counts_new_faces = true;
    best->cost += at.quadric.weight * squared_new_face_distance(
                                          at.star, s_.complex.offset(at.star.vertex, best->vertex));
  }
}

CollapseConstraint HalfEdgePricer::check(const StarEdge& edge) {
  const CollapseConstraint constraint = s_.constraints.check(now_.star, edge);
  return constraint == CollapseConstraint::none && s_.wedges &&
                 s_.wedges->breaks_texture(now_.star, edge)
             ? CollapseConstraint::texture
             : constraint;
}

// What the vertices around cost now is found when they come up: errors rarely fall.
void HalfEdgePricer::collapse(const StarEdge& edge) {
  const Index q = now_.star.vertex, p = edge.vertex;
  const Vec3f offset = s_.complex.offset(q, p);
  const std::size_t first_move = s_.out.moves.size();
  VertexRecord &from = s_.complex.vertices[q], &to = s_.complex.vertices[p];
  s_.move_corners(now_.star, p);
  if (s_.memoryless && s_.input.attribute_count > 0)
    to.extra_error +=
        from.extra_error + from.quadric.at(offset) + s_.wedges->cost(now_.star, edge).at(offset);
  s_.move_wedges(now_.star, p, offset, from.quadric);
  s_.join_rings(now_.star, edge);
  to.quadric.add(from.quadric, offset * -1);
  add_error(edge);
  const float shown = s_.complex.points[p].error;
  s_.add_collapse(q, p, shown + (s_.memoryless ? 0 : to.extra_error), first_move);
}

void HalfEdgePricer::add_error(const StarEdge& edge) {
  float& error = s_.complex.points[edge.vertex].error;
  if (s_.memoryless) {  // a history that is not in the quadric
    error += s_.complex.points[now_.star.vertex].error + std::max(edge.error - now_.constant, 0.f);
    return;
  }
  // What a large ring shows doubles at a time, or each collapse onto it would change the order of
  // all its neighbours.
  VertexRecord& to = s_.complex.vertices[edge.vertex];
  to.extra_error += edge.error;
  if (to.ring_size <= kLargeRing || to.extra_error >= error)
    error += std::exchange(to.extra_error, 0.f);
}

}  // namespace

CollapseSequence collapse_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress) {
  return collapse_by<HalfEdgePricer>(input, options, progress);
}

}  // namespace pstrips::inline codecs
