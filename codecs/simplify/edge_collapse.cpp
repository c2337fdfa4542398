// Edge collapses that place the vertex where it fits best.
//
// [Garland97] the quadric error metric and its minimum, [Lindstrom98; Lindstrom99] the memoryless
// metric: no history, only the faces there are, and their volume kept.
#include "codecs/simplify/edge_collapse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "codecs/simplify/collapse_loop.h"
#include "codecs/simplify/complex.h"
#include "codecs/simplify/constraints.h"
#include "codecs/simplify/initial_quadrics.h"
#include "codecs/simplify/placement.h"
#include "codecs/simplify/vertex_buckets.h"
#include "codecs/simplify/wedges.h"
#include "core/parallel.h"

namespace pstrips::inline codecs {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// As for half edges.
constexpr float kLengthShare = 1e-9f;
constexpr float kReassignedShare = 1e-2f;
constexpr float kForcedShare = 1;
constexpr int kMaxConstraintChecks = 16;

float rounded_down(float error) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(error) & 0xff80'0000u);
}

struct Face {
  Vec3f normal;  // unit, or zero
  float area = 0;
};

// The faces and open edges that are around a vertex now: planes through it, and the sum of the
// faces' areas as vectors.
struct alignas(64) Surroundings {
  Quadric planes;
  Vec3f area;

  void add(const Face& face) {
    planes.add_plane(face.normal, face.area);
    area = area + face.normal * face.area;
  }
};

class EdgeSimplifier {
 public:
  EdgeSimplifier(const SimplifyInput& input, const SimplifyOptions& options)
      : input_(input),
        options_(options),
        memoryless_(options.metric == Metric::memoryless),
        optimal_(options.placement == Placement::optimal),
        complex_(input.positions, input.wedge_vertex, input.triangles),
        wedges_(wedge_table(input, complex_.diagonal)) {
    if (memoryless_) {
      around_.resize(complex_.vertex_count());
      faces_.resize(complex_.triangle_count());
    }
    if (memoryless_ && input.attribute_count > 0) {
      attribute_quadrics_.resize(complex_.vertex_count());
      attribute_errors_.resize(complex_.vertex_count());
    }
    large_.resize(complex_.vertex_count());
    border_rank_.resize(complex_.vertex_count());
    for (Index v = 0; v < large_.size(); ++v)
      large_[v] = complex_.vertices[v].ring_size > kLargeRing;
    if (optimal_) moved_.resize(complex_.vertex_count());
    out_.triangles_left = input.triangles.size() / 3;
    if (options.max_error >= 0) {
      const double limit = options.max_error * complex_.scale[0] * complex_.scale[1];
      most_error_ = static_cast<float>(std::min(limit * limit, 1e30));
    }
  }

  CollapseSequence run(const Progress& progress);

 private:
  struct Sum {
    Quadric quadric;     // relative to the removed vertex
    float constant = 0;  // its constant term
    Volume volume;
  };

  void fill_queue();
  // Whether it is too costly to know what is around a vertex.
  bool is_large(Index v) const { return large_[v] != 0; }
  bool has_line_terms(Index v) const {
    return wedges_ || !input_.group.empty() || !complex_.vertices[v].regular;
  }
  // Whether the edge from v to x is priced with v, as a collapse of v onto x. Where it makes no
  // difference which end goes, it is priced with one of them: half the work. That is the one that
  // constraints hold less.
  bool owns(Index v, Index x) const {
    if (!optimal_ || wedges_) return true;
    if (is_large(v) != is_large(x)) return is_large(x);
    return border_rank_[v] != border_rank_[x] ? border_rank_[v] < border_rank_[x] : v < x;
  }
  void gather(Index v, Star& star);
  bool start_plain(Index v, Star& star);
  void start(Index v, Star& star);
  void update_face(Index triangle);
  void survey(Index v, Star& star);
  void survey(Index v);
  void evaluate(const Star& star);
  void evaluate_all(const Star& star);
  template <class IsWanted>
  void evaluate(const Star& star, IsWanted&& is_wanted);
  void price_plain(const Star& star, const Index (&at)[4]);
  void apply_limit(const Star& star, StarEdge& edge, float wedge_error) const;
  float least_owned(const Star& star) const;
  void price(const Star& star, StarEdge& edge, float live_weight);
  Sum sum_of(const Star& star, const StarEdge& edge) const;
  float history_error(Index q, Index p, Vec3f place) const;
  const StarEdge* choose(Index q, float limit);
  void collapse(Index q, const StarEdge& edge);
  void join_quadrics(Index q, Index p, Vec3f place, float wedge_constant);
  void note_collapse(Index q, Index p, std::size_t first_move);
  void look_around(Index p, bool has_moved, bool becomes_large);
  void lower_key(Index x, float key);
  void set_key(Index x, float key);
  std::array<double, 3> input_position(Index v) const {
    return {input_.positions[3 * std::size_t{v}], input_.positions[3 * std::size_t{v} + 1],
            input_.positions[3 * std::size_t{v} + 2]};
  }

  const SimplifyInput& input_;
  const SimplifyOptions& options_;
  const bool memoryless_, optimal_;
  Complex complex_;
  CollapseConstraints constraints_{complex_};
  std::optional<WedgeTable> wedges_;
  QuadricBuilder builder_{complex_, input_, wedges_ ? &*wedges_ : nullptr};
  std::vector<Face> faces_;  // memoryless: of all triangles
  std::optional<VertexBuckets> queue_;
  std::vector<Surroundings> around_;         // memoryless: of all vertices whose ring is not large
  std::vector<Quadric> attribute_quadrics_;  // memoryless: what attributes demand, accumulated
  std::vector<float> attribute_errors_;      // and their constant terms
  std::vector<std::uint8_t> large_, moved_;
  std::vector<std::uint8_t> border_rank_;  // 1 for what came to a border, 2 for where several meet
  float most_error_ = kInfinity;           // squared, in the complex's units

  Star star_, kept_star_, scratch_;
  std::vector<Index> moved_corners_;
  float last_error_ = 0;
  CollapseSequence out_;
};

CollapseSequence EdgeSimplifier::run(const Progress& progress) {
  if (out_.triangles_left <= options_.target_triangles) return std::move(out_);
  fill_queue();
  collapse_until(out_, complex_, *queue_, options_.target_triangles, most_error_ < kInfinity,
                 progress, [&](Index q) {
                   gather(q, star_);
                   evaluate(star_);
                   const StarEdge* const edge = choose(q, queue_->limit());
                   if (edge) collapse(q, *edge);
                   return edge != nullptr;
                 });
  return std::move(out_);
}

void EdgeSimplifier::gather(Index v, Star& star) {
  if (has_line_terms(v))
    complex_.gather(v, star);
  else
    complex_.gather_regular(v, star);
  if (is_large(v) && star.corners.size() <= kLargeRing) {
    large_[v] = 0;
    if (memoryless_) survey(v, star);
  }
}

void EdgeSimplifier::fill_queue() {
  if (wedges_)
    builder_.add_attributes(attribute_quadrics_.empty() ? nullptr : attribute_quadrics_.data());
  if (memoryless_)
    parallel_for(options_.threads, faces_.size(), std::size_t{1} << 16,
                 [&](std::size_t begin, std::size_t end) {
                   for (Index t = static_cast<Index>(begin); t < end; ++t) update_face(t);
                 });
  // Vertices without anything special are many, and do not need one another's scratch memory.
  constexpr std::size_t kGrain = 4096;
  std::vector<float> keys(complex_.vertex_count(), kInfinity);
  const auto for_plain_vertices = [&](auto&& visit) {
    parallel_for(options_.threads, keys.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Star star;
      for (Index v = static_cast<Index>(begin); v < end; ++v)
        if (!complex_.is_locked(v)) visit(v, star);
    });
  };
  std::vector<std::uint8_t> is_plain(keys.size());
  for_plain_vertices([&](Index v, Star& star) { is_plain[v] = start_plain(v, star); });
  for (Index v = 0; v < keys.size(); ++v)
    if (!is_plain[v] && !complex_.is_locked(v)) start(v, star_);
  const auto take_key = [&](Index v, Star& star) {
    gather(v, star);
    evaluate(star);
    keys[v] = complex_.vertices[v].key = least_owned(star);
  };
  for_plain_vertices([&](Index v, Star& star) {
    if (is_plain[v]) take_key(v, star);
  });
  for (Index v = 0; v < keys.size(); ++v)
    if (!is_plain[v] && !complex_.is_locked(v)) take_key(v, star_);
  queue_.emplace(keys);
}

// Prepares a vertex whose faces alone count. False if it is not one.
bool EdgeSimplifier::start_plain(Index v, Star& star) {
  if (wedges_ || !input_.group.empty()) return false;
  complex_.gather_regular(v, star);
  if (!star.is_regular()) return false;
  const Quadric faces = star.measure();
  if (QuadricBuilder::may_fold(star)) return false;
  VertexRecord& record = complex_.vertices[v];
  record.regular = true;
  record.quadric = faces;
  if (memoryless_) survey(v, star);
  return true;
}

// The same for any vertex.
void EdgeSimplifier::start(Index v, Star& star) {
  VertexRecord& record = complex_.vertices[v];
  complex_.gather(v, star);
  record.regular = star.open_edges == 0 && std::ranges::all_of(star.edges, [](const StarEdge& e) {
                     return e.outgoing == 1;
                   });
  border_rank_[v] = star.open_edges > 2 ? 2 : star.open_edges > 0 ? 1 : 0;
  record.quadric.add_matrix(star.measure());
  builder_.add_edges(star, record.quadric);
  if (memoryless_) survey(v, star);
}

void EdgeSimplifier::update_face(Index t) {
  const Index* const v = &complex_.corner_vertex[std::size_t{4} * t];
  faces_[t] = {};
  if (complex_.is_locked(v[0]) || complex_.is_locked(v[1]) || complex_.is_locked(v[2])) return;
  const Vec3f n = cross(complex_.offset(v[0], v[1]), complex_.offset(v[0], v[2]));
  const float length = std::sqrt(dot(n, n));
  if (length > 0) faces_[t] = {n * (1 / length), length / 2};
}

void EdgeSimplifier::survey(Index v, Star& star) {
  Surroundings around;
  for (const IncidentCorner& incident : star.corners) around.add(faces_[incident.corner / 4]);
  if (has_line_terms(v)) {
    star.measure();
    builder_.add_edges(star, around.planes);
  }
  around_[v] = around;
}

// What faces around a vertex there are, after some have changed.
void EdgeSimplifier::survey(Index v) {
  if (is_large(v)) return;
  if (has_line_terms(v)) {
    gather(v, scratch_);
    survey(v, scratch_);
    return;
  }
  Surroundings around;
  for (const Index corner : complex_.ring_with_dead(v)) around.add(faces_[corner / 4]);
  around_[v] = around;
}

// Fills costs and places of the star's edges, constraints aside; those that it does not own cost
// infinity.
void EdgeSimplifier::evaluate(const Star& star) {
  evaluate(star, [&](Index x) { return owns(star.vertex, x); });
}

void EdgeSimplifier::evaluate_all(const Star& star) {
  evaluate(star, [](Index) { return true; });
}

template <class IsWanted>
void EdgeSimplifier::evaluate(const Star& star, IsWanted&& is_wanted) {
  if (memoryless_)
    for (const StarEdge& edge : star.edges) __builtin_prefetch(&around_[edge.vertex]);
  const float live_weight = wedges_ ? wedges_->live_weight(star) : 0;
  const bool is_plain = memoryless_ && !has_line_terms(star.vertex) && !is_large(star.vertex);
  Index four[4];
  std::size_t waiting = 0;
  for (Index i = 0; i < star.edges.size(); ++i) {
    StarEdge& edge = star.edges[i];
    edge.cost = kInfinity;
    if (!is_wanted(edge.vertex)) continue;
    if (!is_plain || is_large(edge.vertex) || complex_.is_locked(edge.vertex)) {
      price(star, edge, live_weight);
      continue;
    }
    four[waiting++] = i;
    if (waiting == 4) price_plain(star, four), waiting = 0;
  }
  if (waiting == 0) return;
  for (std::size_t i = waiting; i < 4; ++i) four[i] = four[0];
  price_plain(star, four);
}

float EdgeSimplifier::least_owned(const Star& star) const {
  float least = kInfinity;
  for (const StarEdge& edge : star.edges)
    if (owns(star.vertex, edge.vertex)) least = std::min(least, edge.cost);
  return least;
}

// The error as a function of where the edge's end is placed; for the memoryless metric each face
// around the edge counts once.
EdgeSimplifier::Sum EdgeSimplifier::sum_of(const Star& star, const StarEdge& edge) const {
  const Index q = star.vertex, p = edge.vertex;
  const Vec3f offset = complex_.offset(q, p);
  Sum sum;
  if (!memoryless_) {
    const Quadric& kept = complex_.vertices[p].quadric;
    sum.quadric = complex_.vertices[q].quadric;
    sum.quadric.add(kept, offset);
    sum.constant = complex_.points[q].error + complex_.points[p].error + kept.at(offset * -1);
    return sum;
  }
  const Surroundings &mine = around_[q], &its = around_[p];
  const Vec3f slope = its.planes.times(offset);
  sum.quadric = mine.planes;
  sum.quadric.add_matrix(its.planes);
  sum.quadric.b = slope * -1;  // all planes pass through their vertex
  sum.constant = dot(slope, offset);
  sum.volume = {mine.area + its.area, dot(its.area, offset)};
  for (const IncidentCorner& incident : star.corners) {
    if (incident.next != p && incident.previous != p) continue;
    const Face& face = faces_[incident.corner / 4];
    sum.quadric.add_plane(face.normal, -face.area);
    sum.volume.area = sum.volume.area - face.normal * face.area;
  }
  if (!attribute_quadrics_.empty()) {
    sum.quadric.add(attribute_quadrics_[q], {});
    sum.quadric.add(attribute_quadrics_[p], offset);
    sum.constant +=
        attribute_errors_[q] + attribute_errors_[p] + attribute_quadrics_[p].at(offset * -1);
  }
  return sum;
}

// Prices four edges of a star at once, given by their places in it, where nothing but the faces
// around them counts. Needs a star as gather_regular() makes it: corner i is on edge i.
void EdgeSimplifier::price_plain(const Star& star, const Index (&at)[4]) {
  const Surroundings& mine = around_[star.vertex];
  const Surroundings* its[4];
  const VertexPoint* ends[4];
  const Face* faces[2][4];  // the two on each edge
  EdgeSums sums;
  for (std::size_t i = 0; i < 4; ++i) {
    const Index p = star.edges[at[i]].vertex;
    its[i] = &around_[p];
    faces[0][i] = &faces_[star.corners[at[i]].corner / 4];
    faces[1][i] =
        &faces_[std::ranges::find(star.corners, p, &IncidentCorner::previous)->corner / 4];
    ends[i] = &complex_.points[p];
  }
  // Four floats of each, from the `first` on.
  const auto columns = [](const auto* const(&of)[4], std::size_t first, Float4& a, Float4& b,
                          Float4& c, Float4& d) {
    const auto row = [&](std::size_t i) {
      return load4(reinterpret_cast<const std::byte*>(of[i]) + first * sizeof(float));
    };
    Float4 x = row(0), y = row(1), z = row(2), w = row(3);
    transpose4(x, y, z, w);
    a = x, b = y, c = z, d = w;
  };
  static_assert(offsetof(Quadric, b) == 6 * sizeof(float) &&
                offsetof(Surroundings, area) == 10 * sizeof(float));
  Float4 unused;
  columns(ends, 0, sums.offset.x, sums.offset.y, sums.offset.z, unused);
  sums.offset = sums.offset - complex_.points[star.vertex].position;
  columns(its, 0, sums.xx, sums.yy, sums.zz, sums.xy);
  columns(its, 4, sums.xz, sums.yz, unused, unused);
  columns(its, 8, unused, unused, sums.area.x, sums.area.y);
  columns(its, 12, sums.area.z, unused, unused, unused);

  // All planes pass through their vertex.
  const Vec3x4& o = sums.offset;
  const Vec3x4 slope = {sums.xx * o.x + sums.xy * o.y + sums.xz * o.z,
                        sums.xy * o.x + sums.yy * o.y + sums.yz * o.z,
                        sums.xz * o.x + sums.yz * o.y + sums.zz * o.z};
  const Float4 constant = dot(slope, o);
  sums.b = {-slope.x, -slope.y, -slope.z};
  sums.volume = dot(sums.area, o);
  sums.xx += mine.planes.xx, sums.yy += mine.planes.yy, sums.zz += mine.planes.zz;
  sums.xy += mine.planes.xy, sums.xz += mine.planes.xz, sums.yz += mine.planes.yz;
  sums.area.x += mine.area.x, sums.area.y += mine.area.y, sums.area.z += mine.area.z;
  for (const auto& four : faces) {  // counted twice
    Vec3x4 normal;
    Float4 area;
    columns(four, 0, normal.x, normal.y, normal.z, area);
    sums.add_plane(normal, -area);
  }

  const Vec3x4 place = optimal_ ? best_place(sums) : o;
  const Float4 error = max4(constant + sums.at(place), Float4{});
  const Float4 cost = error + kLengthShare * mine.planes.weight * dot(o, o);
  for (std::size_t i = 0; i < 4; ++i) {
    StarEdge& edge = star.edges[at[i]];
    edge.place = place.lane(i);
    edge.error = error[i];
    edge.cost = cost[i] < kInfinity ? cost[i] : kInfinity;
    apply_limit(star, edge, 0);
  }
}

void EdgeSimplifier::apply_limit(const Star& star, StarEdge& edge, float wedge_error) const {
  if (most_error_ == kInfinity) return;
  const Index q = star.vertex, p = edge.vertex;
  const float all = complex_.vertices[q].quadric.weight + complex_.vertices[p].quadric.weight;
  if (history_error(q, p, edge.place) + wedge_error > most_error_ * all) edge.cost = kInfinity;
}

void EdgeSimplifier::price(const Star& star, StarEdge& edge, float live_weight) {
  const Index q = star.vertex, p = edge.vertex;
  if (complex_.is_locked(p)) {
    edge.cost = kInfinity;
    return;
  }
  const Vec3f offset = complex_.offset(q, p);
  WedgeTable::Cost wedge_cost;
  if (wedges_) wedge_cost = wedges_->cost(star, edge);
  float weight = complex_.vertices[q].quadric.weight;
  float error = 0;
  edge.place = offset;
  if (is_large(q) || is_large(p)) {
    // What is around a large ring is not known. Its vertex stays, and its own error counts little.
    const VertexRecord& record = complex_.vertices[q];
    error = complex_.points[q].error + record.quadric.at(offset) +
            rounded_down(complex_.points[p].error);
  } else {
    Sum sum = sum_of(star, edge);
    sum.quadric.b = sum.quadric.b + wedge_cost.linear;
    sum.constant += wedge_cost.constant;
    if (optimal_) edge.place = best_place(sum.quadric, sum.volume, offset);
    error = sum.constant + sum.quadric.at(edge.place);
    if (memoryless_) weight = around_[q].planes.weight;
  }
  const float length = dot(offset, offset);
  const float reassigned = wedges_ ? std::max(0.f, live_weight - wedge_cost.mapped_weight) : 0.f;
  edge.error = std::max(error, 0.f);
  edge.cost = edge.error + kLengthShare * weight * length + wedge_cost.conflicts +
              kReassignedShare * reassigned * length;
  if (!(edge.cost < kInfinity)) edge.cost = kInfinity;
  apply_limit(star, edge, wedge_cost.at(edge.place));
}

// What all faces ever replaced say of a place, given relative to q.
float EdgeSimplifier::history_error(Index q, Index p, Vec3f place) const {
  const Vec3f kept_place = place - complex_.offset(q, p);
  return complex_.points[q].error + complex_.vertices[q].quadric.at(place) +
         complex_.points[p].error + complex_.vertices[p].quadric.at(kept_place);
}

// The edge to collapse now that q is on top of the heap, all others having a key of at least
// `limit`. Refused edges are made dearer and compared again. Null after q was put back or dropped.
const StarEdge* EdgeSimplifier::choose(Index q, float limit) {
  const bool large = is_large(q);
  for (int checks = 0;; ++checks) {
    StarEdge* best = nullptr;
    for (StarEdge& edge : star_.edges)
      if (!best || edge.cost < best->cost ||
          (edge.cost == best->cost && edge.vertex < best->vertex))
        best = &edge;
    if (!best || best->cost == kInfinity) {
      set_key(q, kInfinity);
      return nullptr;
    }
    if (best->cost > limit) {
      // A large ring comes up less often when its key is a little too high.
      set_key(q, large ? best->cost * 1.25f : best->cost);
      return nullptr;
    }
    if (best->refused != CollapseConstraint::none) return best;
    if (checks == 0) star_.measure();
    const bool give_up = large && checks == kMaxConstraintChecks;
    for (StarEdge& edge : star_.edges) {
      if (give_up ? edge.refused != CollapseConstraint::none : &edge != best) continue;
      const Vec3f offset = complex_.offset(q, edge.vertex);
      CollapseConstraint refused =
          give_up ? CollapseConstraint::flip
                  : constraints_.check(star_, edge, edge.place, edge.place - offset);
      if (refused == CollapseConstraint::none && wedges_ && wedges_->breaks_texture(star_, edge))
        refused = CollapseConstraint::texture;
      if (refused == CollapseConstraint::none) return best;
      count(out_.refused, refused);
      edge.refused = refused;
      edge.cost += kForcedShare * complex_.vertices[q].quadric.weight * dot(offset, offset);
    }
  }
}

void EdgeSimplifier::collapse(Index q, const StarEdge& edge) {
  const Index p = edge.vertex;
  const Vec3f place = edge.place, shift = place - complex_.offset(q, p);
  const bool has_moved = shift.x != 0 || shift.y != 0 || shift.z != 0;
  const std::size_t first_move = out_.moves.size();
  WedgeTable::Cost wedge_cost;
  if (wedges_) wedge_cost = wedges_->cost(star_, edge);

  moved_corners_.clear();
  for (const IncidentCorner& incident : star_.corners) {
    if (incident.next == p || incident.previous == p) {
      complex_.kill(incident.corner);
      if (memoryless_) faces_[incident.corner / 4] = {};
      --out_.triangles_left;
    } else {
      complex_.corner_vertex[incident.corner] = p;
      moved_corners_.push_back(incident.corner);
    }
  }
  Quadric& from = complex_.vertices[q].quadric;
  const Vec3f linear = from.b;
  if (wedges_) {
    wedges_->move(p, shift);
    wedges_->collapse(complex_, star_, p, place, from, out_.moves);
  } else {
    out_.moves.push_back({q, p});
  }
  if (!attribute_quadrics_.empty())
    attribute_quadrics_[q].b = attribute_quadrics_[q].b + (from.b - linear);
  join_quadrics(q, p, place, wedge_cost.constant);
  complex_.append(p, moved_corners_);
  const bool becomes_large = !is_large(p) && complex_.vertices[p].ring_size > kLargeRing;
  if (becomes_large) large_[p] = 1;
  complex_.vertices[q].ring_size = 0;
  count(out_.forced, edge.refused);
  if (edge.refused != CollapseConstraint::none) {
    complex_.vertices[p].regular = false;
    for (const StarEdge& other : star_.edges) complex_.vertices[other.vertex].regular = false;
  }
  complex_.vertices[p].regular &= complex_.vertices[q].regular;
  border_rank_[p] = std::max(border_rank_[p], border_rank_[q]);
  complex_.vertices[q].key = kInfinity;
  if (has_moved) {
    complex_.points[p].position = complex_.points[p].position + shift;
    moved_[p] = 1;
  }
  note_collapse(q, p, first_move);
  look_around(p, has_moved, becomes_large);
}

// The constant terms grow by what the moves cost; what other values of attributes cost is in the
// linear terms already but for `wedge_constant`.
void EdgeSimplifier::join_quadrics(Index q, Index p, Vec3f place, float wedge_constant) {
  const Vec3f shift = place - complex_.offset(q, p);
  const auto join = [&](Quadric& from, float from_error, Quadric& to, float& error) {
    error = std::max(0.f, error + to.at(shift) + from_error + from.at(place) + wedge_constant);
    to.move(shift);
    from.move(place);
    to.add(from, {});
  };
  join(complex_.vertices[q].quadric, complex_.points[q].error, complex_.vertices[p].quadric,
       complex_.points[p].error);
  if (!attribute_quadrics_.empty())
    join(attribute_quadrics_[q], attribute_errors_[q], attribute_quadrics_[p],
         attribute_errors_[p]);
}

void EdgeSimplifier::note_collapse(Index q, Index p, std::size_t first_move) {
  const float weight = complex_.vertices[p].quadric.weight;
  const float mean = weight > 0 ? std::sqrt(complex_.points[p].error / weight) : 0;
  const double error = mean / complex_.scale[0] / complex_.scale[1];
  last_error_ = std::max(
      last_error_, static_cast<float>(std::min(error, double{std::numeric_limits<float>::max()})));
  out_.collapses.push_back({q, p, last_error_, static_cast<Index>(out_.moves.size() - first_move)});
  if (!optimal_) return;
  const auto place = moved_[p] ? complex_.model_position(p) : input_position(p);
  out_.placements.insert(out_.placements.end(), place.begin(), place.end());
}

// After a collapse onto p: what the faces around it and its neighbours are, and what their edges
// cost now. Those that a neighbour had before are priced again when it comes up.
void EdgeSimplifier::look_around(Index p, bool has_moved, bool becomes_large) {
  if (memoryless_) {
    const auto changed = has_moved ? complex_.ring(p) : std::span<const Index>(moved_corners_);
    for (const Index corner : changed) update_face(corner / 4);
  }
  if (becomes_large) gather(p, kept_star_);  // all of its edges change owners
  if (is_large(p)) {
    for (const StarEdge& edge : becomes_large ? kept_star_.edges : star_.edges) {
      const Index x = edge.vertex;
      if (x == p || complex_.is_locked(x)) continue;
      if (memoryless_) survey(x);
      lower_key(x, complex_.points[x].error +
                       complex_.vertices[x].quadric.at(complex_.offset(x, p)) +
                       rounded_down(complex_.points[p].error));
    }
    return;
  }
  gather(p, kept_star_);
  if (memoryless_) {
    survey(p, kept_star_);
    for (const StarEdge& edge : kept_star_.edges) complex_.prefetch_ring(edge.vertex);
    for (const StarEdge& edge : kept_star_.edges) survey(edge.vertex);
  }
  evaluate_all(kept_star_);
  set_key(p, least_owned(kept_star_));
  for (const StarEdge& edge : kept_star_.edges) {
    const Index x = edge.vertex;
    if (complex_.is_locked(x) || edge.cost == kInfinity || !owns(x, p)) continue;
    float bound = owns(p, x) ? edge.error : edge.cost;
    if (!optimal_ && memoryless_ && !is_large(x))
      bound = around_[x].planes.at(complex_.offset(x, p));
    lower_key(x, bound);
  }
}

// A new edge of x costs this, about.
void EdgeSimplifier::lower_key(Index x, float key) {
  key = std::max(key, 0.f);
  if (key < complex_.vertices[x].key) set_key(x, key);
}

// Infinity takes a vertex out of the queue until it gets an edge that may collapse.
void EdgeSimplifier::set_key(Index x, float key) {
  complex_.vertices[x].key = key;
  if (key < kInfinity)
    queue_->put(x, key);
  else
    queue_->remove(x);
}

}  // namespace

CollapseSequence simplify_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                const Progress& progress) {
  return EdgeSimplifier(input, options).run(progress);
}

}  // namespace pstrips::inline codecs
