// Edge collapses that place the vertex where it fits best.
//
// [Garland97] the quadric error metric and its minimum, [Lindstrom98; Lindstrom99] the memoryless
// metric: no history, only the faces there are, and their volume kept.
#include "codecs/simplify/edge_collapse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codecs/simplify/collapse_driver.h"
#include "codecs/simplify/face_planes.h"
#include "codecs/simplify/new_face_distance.h"
#include "codecs/simplify/placement.h"
#include "core/parallel.h"

namespace pstrips::inline codecs {
namespace {

float rounded_down(float error) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(error) & 0xff80'0000u);
}

// One quadric takes in another whose owner goes to `place`, and moves by `shift` itself. The
// constant terms grow by what the moves cost; what other values of attributes cost is in the linear
// terms already but for `wedge_constant`.
void join(Quadric& from, float from_error, Quadric& to, float& error, Vec3f shift, Vec3f place,
          float wedge_constant) {
  error = std::max(0.f, error + to.at(shift) + from_error + from.at(place) + wedge_constant);
  to.move(shift);
  from.move(place);
  to.add(from, {});
}

// What attributes demand of each vertex, accumulated; nothing without attributes.
struct AttributeQuadrics {
  std::vector<Quadric> quadrics;
  std::vector<float> errors;  // their constant terms

  bool empty() const { return quadrics.empty(); }
  void resize(std::size_t vertices) {
    quadrics.resize(vertices);
    errors.resize(vertices);
  }
  // Adds those of an edge from q to p.
  void add_to(EdgeSum& sum, Index q, Index p, Vec3f offset) const {
    sum.quadric.add(quadrics[q], {});
    sum.quadric.add(quadrics[p], offset);
    sum.constant += errors[q] + errors[p] + quadrics[p].at(offset * -1);
  }
};

// What all faces ever replaced say of a place for the edge from q to p, given relative to q.
float history_error(const Complex& complex, Index q, Index p, Vec3f place) {
  const Vec3f kept_place = place - complex.offset(q, p);
  return complex.points[q].error + complex.vertices[q].quadric.at(place) + complex.points[p].error +
         complex.vertices[p].quadric.at(kept_place);
}

void apply_limit(const CollapseState& state, const Star& star, StarEdge& edge, float wedge_error) {
  if (!state.is_limited()) return;
  const Index q = star.vertex, p = edge.vertex;
  const float all =
      state.complex.vertices[q].quadric.weight + state.complex.vertices[p].quadric.weight;
  if (history_error(state.complex, q, p, edge.place) + wedge_error > state.max_squared_error * all)
    edge.cost = kInfiniteCost;
}

void update_all(FacePlanes& planes, unsigned threads) {
  parallel_for(threads, planes.face_count(), std::size_t{1} << 16,
               [&](std::size_t begin, std::size_t end) {
                 for (Index t = static_cast<Index>(begin); t < end; ++t) planes.update(t);
               });
}

// How far the new faces leave the places where both ends of an edge stood, or their own vertex the
// old faces; `place` and `offset` are as of StarEdge.
float squared_loss(const Star& from, const Star& kept, Vec3f place, Vec3f offset) {
  const auto loss = [&](Vec3f point) {
    return std::min(squared_new_face_distance(from, place, point, kept.vertex),
                    squared_new_face_distance(kept, place - offset, point - offset, from.vertex));
  };
  const float beyond = std::min(squared_new_face_distance(from, {}, place, kNone),
                                squared_new_face_distance(kept, {}, place - offset, kNone));
  return std::max({loss({}), loss(offset), beyond});
}

// Whether faces of two measured stars look in nearly opposite directions, as on both sides of a
// thin shell: each lies near the planes of the other.
bool has_back_to_back(const Star& a, const Star& b) {
  constexpr float kOpposite = -0.7f;
  for (const Star* star : {&a, &b})
    for (Index i = 0; i < star->corners.size(); ++i)
      for (Index k = 0; k < b.corners.size(); ++k)
        if (dot(star->normal(i), b.normal(k)) < kOpposite) return true;
  return false;
}

// Where planes are blind, adds to the cost of an edge what its place loses; puts it at one of the
// ends if that costs less.
void place_sharp(const Complex& complex, Star& from, Star& kept, const EdgeSum& sum, bool may_move,
                 StarEdge& edge) {
  from.measure();
  kept.measure();
  if (!has_back_to_back(from, kept) && !has_back_to_back(from, from)) return;
  const Vec3f offset = complex.offset(from.vertex, kept.vertex);
  const float weight =
      complex.vertices[from.vertex].quadric.weight + complex.vertices[kept.vertex].quadric.weight;
  const float without_error = edge.cost - edge.error;
  edge.cost += weight * squared_loss(from, kept, edge.place, offset);
  if (!may_move) return;
  for (const Vec3f end : {Vec3f{}, offset}) {
    const float error = std::max(0.f, sum.constant + sum.quadric.at(end));
    const float cost = without_error + error + weight * squared_loss(from, kept, end, offset);
    if (!(cost < edge.cost)) continue;
    edge.place = end;
    edge.error = error;
    edge.cost = cost;
  }
}

// Calls visit(vertex, scratch star) for all that may collapse, on several threads.
template <class Visit>
void for_vertices(const Complex& complex, unsigned threads, Visit&& visit) {
  constexpr std::size_t kGrain = 4096;
  parallel_for(threads, complex.vertex_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    Star star;
    for (Index v = static_cast<Index>(begin); v < end; ++v)
      if (!complex.is_locked(v)) visit(v, star);
  });
}

class EdgePricer {
 public:
  explicit EdgePricer(CollapseState& state);

  std::vector<float> first_keys();
  Star& price(Index q);
  StarEdge* cheapest();
  CollapseConstraint check(const StarEdge& edge);
  bool is_large() const { return is_large(star_.vertex); }
  float weight() const { return complex_.vertices[star_.vertex].quadric.weight; }
  void put_back(Index q, float cost) { set_key(q, cost); }
  void drop(Index q) { set_key(q, kInfiniteCost); }
  void collapse(const StarEdge& edge);

  static constexpr float kLargeRingDelay = 1.25f;

 private:
  // Whether it is too costly to know what is around a vertex.
  bool is_large(Index v) const { return large_[v] != 0; }
  bool has_line_terms(Index v) const {
    return s_.wedges || !s_.input.group.empty() || !complex_.vertices[v].regular;
  }
  // Whether the edge from v to x is priced with v, as a collapse of v onto x. Where it makes no
  // difference which end goes, it is priced with one of them: half the work. That is the one that
  // constraints hold less.
  bool owns(Index v, Index x) const {
    if (!optimal_ || s_.wedges) return true;
    if (is_large(v) != is_large(x)) return is_large(x);
    return border_rank_[v] != border_rank_[x] ? border_rank_[v] < border_rank_[x] : v < x;
  }
  void gather(Index v, Star& star);
  void start_all(std::vector<std::uint8_t>& is_plain);
  bool start_plain(Index v, Star& star);
  void start(Index v, Star& star);
  void sum_planes(Index v);

  void evaluate_owned(const Star& star);
  template <class IsWanted>
  void evaluate(const Star& star, IsWanted&& is_wanted);
  void price_plain(const Star& star, const Index (&at)[4]);
  void price_any(const Star& star, StarEdge& edge, float live_weight);
  EdgeSum sum_of(const Star& star, const StarEdge& edge) const;
  float least_owned(const Star& star) const;

  void join_quadrics(Index q, Index p, Vec3f place, float wedge_constant);
  void add_placement(Index p);
  void price_around(Index p, bool has_moved, bool becomes_large);
  void price_around_large(Index p, const Star& star);
  void lower_key(Index x, float key);
  void set_key(Index x, float key);

  CollapseState& s_;
  Complex& complex_;
  const bool optimal_;
  std::optional<FacePlanes> planes_;  // memoryless: of all vertices whose ring is not large
  AttributeQuadrics attributes_;      // memoryless
  std::vector<std::uint8_t> large_, sharp_, moved_;  // sharp: planes may be blind, as at a rim
  std::vector<std::uint8_t> border_rank_;  // 1 for what came to a border, 2 for where several meet
  Star star_, kept_star_, scratch_;
  bool is_measured_ = false;  // star_
};

EdgePricer::EdgePricer(CollapseState& state)
    : s_(state),
      complex_(state.complex),
      optimal_(state.options.placement == Placement::optimal),
      large_(complex_.vertex_count()),
      sharp_(complex_.vertex_count()),
      border_rank_(complex_.vertex_count()) {
  if (s_.memoryless) planes_.emplace(complex_, s_.builder);
  if (s_.memoryless && s_.input.attribute_count > 0) attributes_.resize(complex_.vertex_count());
  for (Index v = 0; v < large_.size(); ++v) large_[v] = complex_.vertices[v].ring_size > kLargeRing;
  if (optimal_) moved_.resize(complex_.vertex_count());
}

// Vertices without anything special are many, and do not need one another's scratch memory.
std::vector<float> EdgePricer::first_keys() {
  std::vector<std::uint8_t> is_plain(complex_.vertex_count());
  start_all(is_plain);
  std::vector<float> keys(complex_.vertex_count(), kInfiniteCost);
  const auto take_key = [&](Index v, Star& star) {
    gather(v, star);
    evaluate_owned(star);
    keys[v] = complex_.vertices[v].key = least_owned(star);
  };
  for_vertices(complex_, s_.options.threads, [&](Index v, Star& star) {
    if (is_plain[v]) take_key(v, star);
  });
  for (Index v = 0; v < keys.size(); ++v)
    if (!is_plain[v] && !complex_.is_locked(v)) take_key(v, star_);
  return keys;
}

void EdgePricer::start_all(std::vector<std::uint8_t>& is_plain) {
  if (s_.wedges)
    s_.builder.add_attributes(attributes_.empty() ? nullptr : attributes_.quadrics.data());
  if (planes_) update_all(*planes_, s_.options.threads);
  for_vertices(complex_, s_.options.threads,
               [&](Index v, Star& star) { is_plain[v] = start_plain(v, star); });
  for (Index v = 0; v < is_plain.size(); ++v)
    if (!is_plain[v] && !complex_.is_locked(v)) start(v, star_);
}

// Prepares a vertex whose faces alone count. False if it is not one.
bool EdgePricer::start_plain(Index v, Star& star) {
  if (s_.wedges || !s_.input.group.empty()) return false;
  complex_.gather_regular(v, star);
  if (!star.is_regular()) return false;
  const Quadric faces = star.measure();
  if (QuadricBuilder::may_fold(star)) return false;
  VertexRecord& record = complex_.vertices[v];
  record.regular = true;
  record.quadric = faces;
  if (planes_) planes_->sum(star, false);
  return true;
}

// The same for any vertex.
void EdgePricer::start(Index v, Star& star) {
  VertexRecord& record = complex_.vertices[v];
  complex_.gather(v, star);
  record.regular = star.open_edges == 0 && std::ranges::all_of(star.edges, [](const StarEdge& e) {
                     return e.outgoing == 1;
                   });
  border_rank_[v] = star.open_edges > 2 ? 2 : star.open_edges > 0 ? 1 : 0;
  record.quadric.add_matrix(star.measure());
  sharp_[v] = optimal_ && QuadricBuilder::may_fold(star);
  s_.builder.add_edges(star, record.quadric);
  if (planes_) planes_->sum(star, has_line_terms(v));
}

void EdgePricer::gather(Index v, Star& star) {
  if (has_line_terms(v))
    complex_.gather(v, star);
  else
    complex_.gather_regular(v, star);
  if (is_large(v) && star.corners.size() <= kLargeRing) {
    large_[v] = 0;
    if (planes_) planes_->sum(star, has_line_terms(v));
  }
}

// After faces around a vertex have changed.
void EdgePricer::sum_planes(Index v) {
  if (is_large(v)) return;
  if (!has_line_terms(v)) {
    planes_->sum_faces(v);
    return;
  }
  gather(v, scratch_);
  planes_->sum(scratch_, true);
}

Star& EdgePricer::price(Index q) {
  gather(q, star_);
  evaluate_owned(star_);
  is_measured_ = false;
  return star_;
}

void EdgePricer::evaluate_owned(const Star& star) {
  evaluate(star, [&](Index x) { return owns(star.vertex, x); });
}

// Fills costs and places of the star's edges, constraints aside; those to other vertices than
// is_wanted(vertex) cost infinity.
template <class IsWanted>
void EdgePricer::evaluate(const Star& star, IsWanted&& is_wanted) {
  if (planes_)
    for (const StarEdge& edge : star.edges) planes_->prefetch(edge.vertex);
  const float live_weight = s_.wedges ? s_.wedges->live_weight(star) : 0;
  const bool is_plain = planes_ && !has_line_terms(star.vertex) && !is_large(star.vertex);
  Index four[4];
  std::size_t waiting = 0;
  for (Index i = 0; i < star.edges.size(); ++i) {
    StarEdge& edge = star.edges[i];
    edge.cost = kInfiniteCost;
    if (!is_wanted(edge.vertex)) continue;
    if (!is_plain || is_large(edge.vertex) || complex_.is_locked(edge.vertex)) {
      price_any(star, edge, live_weight);
      continue;
    }
    four[waiting++] = i;
    if (waiting == 4) price_plain(star, four), waiting = 0;
  }
  if (waiting == 0) return;
  for (std::size_t i = waiting; i < 4; ++i) four[i] = four[0];
  price_plain(star, four);
}

// Prices four edges of a star at once, given by their places in it, where nothing but the faces
// around them counts.
void EdgePricer::price_plain(const Star& star, const Index (&at)[4]) {
  const EdgeSums sums = planes_->edge_sums(star, at);
  const Vec3x4& o = sums.offset;
  const Vec3x4 place = optimal_ ? best_place(sums) : o;
  const Float4 error = max4(sums.constant + sums.at(place), Float4{});
  const float weight = planes_->around(star.vertex).planes.weight;
  const Float4 cost = error + kLengthShare * weight * dot(o, o);
  for (std::size_t i = 0; i < 4; ++i) {
    StarEdge& edge = star.edges[at[i]];
    edge.place = lane(place, i);
    edge.error = error[i];
    edge.cost = cost[i] < kInfiniteCost ? cost[i] : kInfiniteCost;
    apply_limit(s_, star, edge, 0);
  }
}

void EdgePricer::price_any(const Star& star, StarEdge& edge, float live_weight) {
  const Index q = star.vertex, p = edge.vertex;
  if (complex_.is_locked(p)) {
    edge.cost = kInfiniteCost;
    return;
  }
  const Vec3f offset = complex_.offset(q, p);
  WedgeTable::Cost wedge_cost;
  if (s_.wedges) wedge_cost = s_.wedges->cost(star, edge);
  float weight = complex_.vertices[q].quadric.weight;
  float error = 0;
  edge.place = offset;
  if (is_large(q) || is_large(p)) {
    // What is around a large ring is not known. Its vertex stays, and its own error counts little.
    const VertexRecord& record = complex_.vertices[q];
    error = complex_.points[q].error + record.quadric.at(offset) +
            rounded_down(complex_.points[p].error);
  } else {
    EdgeSum sum = sum_of(star, edge);
    sum.quadric.b = sum.quadric.b + wedge_cost.linear;
    sum.constant += wedge_cost.constant;
    if (optimal_) edge.place = best_place(sum.quadric, sum.volume, offset);
    error = sum.constant + sum.quadric.at(edge.place);
    if (planes_) weight = planes_->around(q).planes.weight;
  }
  const float length = dot(offset, offset);
  const float reassigned = s_.wedges ? std::max(0.f, live_weight - wedge_cost.mapped_weight) : 0.f;
  edge.error = std::max(error, 0.f);
  edge.cost = edge.error + kLengthShare * weight * length + wedge_cost.conflicts +
              kReassignedShare * reassigned * length;
  if (!(edge.cost < kInfiniteCost)) edge.cost = kInfiniteCost;
  apply_limit(s_, star, edge, wedge_cost.at(edge.place));
}

// The error as a function of where the edge's end is placed.
EdgeSum EdgePricer::sum_of(const Star& star, const StarEdge& edge) const {
  const Index q = star.vertex, p = edge.vertex;
  const Vec3f offset = complex_.offset(q, p);
  if (!planes_) {
    EdgeSum sum;
    const Quadric& kept = complex_.vertices[p].quadric;
    sum.quadric = complex_.vertices[q].quadric;
    sum.quadric.add(kept, offset);
    sum.constant = complex_.points[q].error + complex_.points[p].error + kept.at(offset * -1);
    return sum;
  }
  EdgeSum sum = planes_->edge_sum(star, edge);
  if (!attributes_.empty()) attributes_.add_to(sum, q, p, offset);
  return sum;
}

float EdgePricer::least_owned(const Star& star) const {
  float least = kInfiniteCost;
  for (const StarEdge& edge : star.edges)
    if (owns(star.vertex, edge.vertex)) least = std::min(least, edge.cost);
  return least;
}

// As of half-edge collapses, the distance to the new faces counts where it may decide.
StarEdge* EdgePricer::cheapest() {
  for (;;) {
    StarEdge* const best = star_.cheapest();
    if (!best || best->counts_new_faces || best->cost == kInfiniteCost) return best;
    const Index q = star_.vertex, p = best->vertex;
    if (sharp_[q] + sharp_[p] == 0 || is_large(q) || is_large(p)) return best;
    best->counts_new_faces = true;
    gather(p, kept_star_);
    place_sharp(complex_, star_, kept_star_, sum_of(star_, *best), !s_.wedges, *best);
  }
}

CollapseConstraint EdgePricer::check(const StarEdge& edge) {
  if (!is_measured_) star_.measure();
  is_measured_ = true;
  const Vec3f offset = complex_.offset(star_.vertex, edge.vertex);
  const CollapseConstraint constraint =
      s_.constraints.check(star_, edge, edge.place, edge.place - offset);
  return constraint == CollapseConstraint::none && s_.wedges &&
                 s_.wedges->breaks_texture(star_, edge)
             ? CollapseConstraint::texture
             : constraint;
}

void EdgePricer::collapse(const StarEdge& edge) {
  const Index q = star_.vertex, p = edge.vertex;
  const Vec3f place = edge.place, shift = place - complex_.offset(q, p);
  const bool has_moved = shift.x != 0 || shift.y != 0 || shift.z != 0;
  const std::size_t first_move = s_.out.moves.size();
  WedgeTable::Cost wedge_cost;
  if (s_.wedges) wedge_cost = s_.wedges->cost(star_, edge);

  s_.move_corners(star_, p);
  if (planes_)
    for (const IncidentCorner& incident : star_.corners)
      if (complex_.is_dead(incident.corner)) planes_->remove(incident.corner / 4);
  Quadric& from = complex_.vertices[q].quadric;
  const Vec3f linear = from.b;
  if (s_.wedges) s_.wedges->move(p, shift);
  s_.move_wedges(star_, p, place, from);
  if (!attributes_.empty()) {
    Quadric& demanded = attributes_.quadrics[q];
    demanded.b = demanded.b + (from.b - linear);
  }
  join_quadrics(q, p, place, wedge_cost.constant);
  s_.join_rings(star_, edge);
  const bool becomes_large = !is_large(p) && complex_.vertices[p].ring_size > kLargeRing;
  if (becomes_large) large_[p] = 1;
  border_rank_[p] = std::max(border_rank_[p], border_rank_[q]);
  sharp_[p] |= sharp_[q];
  complex_.vertices[q].key = kInfiniteCost;
  if (has_moved) {
    complex_.points[p].position = complex_.points[p].position + shift;
    moved_[p] = 1;
  }
  s_.add_collapse(q, p, complex_.points[p].error, first_move);
  if (optimal_) add_placement(p);
  price_around(p, has_moved, becomes_large);
}

void EdgePricer::join_quadrics(Index q, Index p, Vec3f place, float wedge_constant) {
  const Vec3f shift = place - complex_.offset(q, p);
  join(complex_.vertices[q].quadric, complex_.points[q].error, complex_.vertices[p].quadric,
       complex_.points[p].error, shift, place, wedge_constant);
  if (attributes_.empty()) return;
  join(attributes_.quadrics[q], attributes_.errors[q], attributes_.quadrics[p],
       attributes_.errors[p], shift, place, wedge_constant);
}

// The very coordinates of the input as long as the vertex stands there.
void EdgePricer::add_placement(Index p) {
  const auto& positions = s_.input.positions;
  const std::size_t at = 3 * std::size_t{p};
  const auto place = moved_[p] ? complex_.model_position(p)
                               : std::array{positions[at], positions[at + 1], positions[at + 2]};
  s_.out.placements.insert(s_.out.placements.end(), place.begin(), place.end());
}

// After a collapse onto p: what the faces around it and its neighbours are, and what their edges
// cost now. Those that a neighbour had before are priced again when it comes up.
void EdgePricer::price_around(Index p, bool has_moved, bool becomes_large) {
  if (planes_) {
    const auto changed = has_moved ? complex_.ring(p) : std::span<const Index>(s_.moved_corners);
    for (const Index corner : changed) planes_->update(corner / 4);
  }
  if (becomes_large) gather(p, kept_star_);  // all of its edges change owners
  if (is_large(p)) {
    price_around_large(p, becomes_large ? kept_star_ : star_);
    return;
  }
  gather(p, kept_star_);
  if (planes_) {
    planes_->sum(kept_star_, has_line_terms(p));
    for (const StarEdge& edge : kept_star_.edges) complex_.prefetch_ring(edge.vertex);
    for (const StarEdge& edge : kept_star_.edges) sum_planes(edge.vertex);
  }
  evaluate(kept_star_, [](Index) { return true; });
  set_key(p, least_owned(kept_star_));
  for (const StarEdge& edge : kept_star_.edges) {
    const Index x = edge.vertex;
    if (complex_.is_locked(x) || edge.cost == kInfiniteCost || !owns(x, p)) continue;
    float bound = owns(p, x) ? edge.error : edge.cost;
    if (!optimal_ && planes_ && !is_large(x))
      bound = planes_->around(x).planes.at(complex_.offset(x, p));
    lower_key(x, bound);
  }
}

// The same where the ring of p is large: of the neighbours alone.
void EdgePricer::price_around_large(Index p, const Star& star) {
  for (const StarEdge& edge : star.edges) {
    const Index x = edge.vertex;
    if (x == p || complex_.is_locked(x)) continue;
    if (planes_) sum_planes(x);
    lower_key(x, complex_.points[x].error + complex_.vertices[x].quadric.at(complex_.offset(x, p)) +
                     rounded_down(complex_.points[p].error));
  }
}

// A new edge of x costs this, about.
void EdgePricer::lower_key(Index x, float key) {
  key = std::max(key, 0.f);
  if (key < complex_.vertices[x].key) set_key(x, key);
}

// Infinity takes a vertex out of the queue until it gets an edge that may collapse.
void EdgePricer::set_key(Index x, float key) {
  complex_.vertices[x].key = key;
  if (key < kInfiniteCost)
    s_.queue->put(x, key);
  else
    s_.queue->remove(x);
}

}  // namespace

CollapseSequence collapse_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                const Progress& progress) {
  return collapse_by<EdgePricer>(input, options, progress);
}

}  // namespace pstrips::inline codecs
