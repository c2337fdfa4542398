// Quadric-ordered half-edge collapses on any triangle complex.
//
// [Garland97] the quadric error metric, [Hoppe99] its wedge attributes, [Kim04 §5] its use as the
// order of strip-edge collapses. A vertex stands in the heap once, under a lower bound of its
// cheapest collapse: errors only grow, so the bound is checked when the vertex comes up, and only
// edges that a collapse creates are looked at at once.
#include "codecs/simplify/simplify.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "codecs/simplify/complex.h"
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
constexpr float kLengthShare = 1e-6f;
constexpr float kCarriedShare = 1e-2f;
constexpr float kForcedShare = 1;

// Faces may turn by 78°.
constexpr float kLeastCosine = 0.2f;
// Height over longest side below which a face is a sliver.
constexpr float kSliver = 0.02f;

// Rings larger than this are looked at only now and then, so that one vertex with a great many
// neighbours costs no more than they do.
constexpr Index kLargeRing = 64;
constexpr int kMostGuardChecks = 16;  // of one such vertex in a row

constexpr std::size_t kProgressInterval = 4096;

enum Guard : std::uint8_t { kPasses, kBorder, kLink, kFlip };

class Simplifier {
 public:
  Simplifier(const SimplifyInput& input, const SimplifyOptions& options)
      : options_(options), complex_(input.positions, input.wedge_vertex, input.triangles) {
    if (!input.wedge_vertex.empty() || input.attribute_count > 0)
      wedges_.emplace(input, complex_.diagonal);
    quadrics_ = initial_quadrics(complex_, input, wedges_ ? &*wedges_ : nullptr);
    out_.triangles_left = input.triangles.size() / 3;
    if (options.max_error >= 0) {
      const double limit = options.max_error * complex_.scale[0] * complex_.scale[1];
      most_error_ = static_cast<float>(std::min(limit * limit, 1e30));
    }
  }

  CollapseSequence run(const Progress& progress);

 private:
  float evaluate(Index q);
  void price(Index q, StarEdge& edge);
  void price_wedges(StarEdge& edge, Vec3f offset);
  float plain_cost(Index q, Index p) const;
  StarEdge* choose(Index q, float limit);
  Guard guard(Index q, const StarEdge& edge);
  bool breaks_border(const StarEdge& edge) const;
  bool breaks_link(Index p);
  bool has_neighbour(Index vertex, Index other);
  bool has_triangle(Index a, Index b, Index c);
  bool flips(Index q, Index p) const;
  void collapse(Index q, const StarEdge& edge);
  void touch(Index x, Index p);
  void lower(Index x, float key);

  const SimplifyOptions& options_;
  Complex complex_;
  std::optional<WedgeTable> wedges_;  // none when each vertex has one wedge and no attributes
  std::vector<Quadric> quadrics_;
  std::optional<VertexHeap> heap_;
  float most_error_ = kInfinity;  // squared, in the complex's units

  Star star_;
  float live_weight_ = 0;     // of the wedges that the star uses
  std::vector<Index> moved_;  // corners
  float last_error_ = 0;
  CollapseSequence out_;
};

CollapseSequence Simplifier::run(const Progress& progress) {
  const std::uint64_t start = out_.triangles_left, target = options_.target_triangles;
  if (start <= target) return std::move(out_);
  std::vector<float> keys(complex_.vertex_count(), kInfinity);
  for (Index v = 0; v < keys.size(); ++v) {
    if (complex_.vertices[v].error == kInfinity) continue;
    keys[v] = complex_.vertices[v].key = complex_.vertices[v].floor = evaluate(v);
  }
  heap_.emplace(keys);
  out_.stop = SimplifyStop::exhausted;
  while (!heap_->empty()) {
    const Index q = heap_->top();
    evaluate(q);
    const StarEdge* const edge = choose(q, heap_->second_key());
    if (!edge) continue;
    collapse(q, *edge);
    if (out_.triangles_left <= target) {
      out_.stop = SimplifyStop::target;
      break;
    }
    if (progress && out_.collapses.size() % kProgressInterval == 0 &&
        !progress("simplify", static_cast<double>(start - out_.triangles_left) /
                                  static_cast<double>(start - target))) {
      out_.stop = SimplifyStop::interrupted;
      break;
    }
  }
  if (out_.stop == SimplifyStop::exhausted && out_.triangles_left > 0 && most_error_ < kInfinity)
    out_.stop = SimplifyStop::max_error;
  return std::move(out_);
}

// Fills the star and the costs of its edges, guards aside; returns the least.
float Simplifier::evaluate(Index q) {
  VertexRecord& record = complex_.vertices[q];
  if (record.regular && !wedges_)
    complex_.gather_regular(q, star_);
  else
    complex_.gather(q, star_);
  if (wedges_) {
    live_weight_ = 0;
    wedges_->new_epoch();
    for (const Spoke& spoke : star_.spokes) {
      const Index wedge = wedges_->corner_wedge[spoke.corner];
      if (wedges_->is_marked(wedge)) continue;
      wedges_->mark(wedge, kNone);
      live_weight_ += wedges_->weight(wedge);
    }
  }
  float least = kInfinity;
  for (StarEdge& edge : star_.edges) {
    price(q, edge);
    least = std::min(least, edge.cost);
  }
  record.floor = least;
  record.touches = 0;
  return least;
}

void Simplifier::price(Index q, StarEdge& edge) {
  const VertexRecord &from = complex_.vertices[q], &to = complex_.vertices[edge.vertex];
  const Vec3f offset = complex_.offset(q, edge.vertex);
  edge.error = from.error + quadrics_[q].at(offset);
  edge.cost = kLengthShare * from.weight * dot(offset, offset);
  if (wedges_) price_wedges(edge, offset);
  edge.error = std::max(edge.error, 0.f);
  edge.cost += edge.error + kKeptShare * to.error;
  if (!(edge.cost < kInfinity) || edge.error + to.error > most_error_ * (from.weight + to.weight))
    edge.cost = kInfinity;
}

void Simplifier::price_wedges(StarEdge& edge, Vec3f offset) {
  wedges_->new_epoch();
  float mapped = 0;
  for (Index i = edge.first; i != kNone; i = star_.spokes[i / 2].more[i % 2]) {
    const Index corner = star_.spokes[i / 2].corner;
    const Index wedge = wedges_->corner_wedge[corner];
    const Index to =
        wedges_->corner_wedge[i % 2 == 0 ? Complex::next(corner) : Complex::previous(corner)];
    if (!wedges_->is_marked(wedge)) {
      wedges_->mark(wedge, to);
      mapped += wedges_->weight(wedge);
      edge.error += wedges_->cost(wedge, to, offset);
    } else if (wedges_->other(wedge) != to) {
      edge.cost += wedges_->conflict(wedge, wedges_->other(wedge), to);
    }
  }
  edge.cost += kCarriedShare * std::max(0.f, live_weight_ - mapped) * dot(offset, offset);
}

// Lower bound of the cost of q's edge to p.
float Simplifier::plain_cost(Index q, Index p) const {
  const VertexRecord &from = complex_.vertices[q], &to = complex_.vertices[p];
  const Vec3f offset = complex_.offset(q, p);
  const float length = kLengthShare * from.weight * dot(offset, offset);
  return std::max(from.error + quadrics_[q].at(offset), 0.f) + length + kKeptShare * to.error;
}

// The edge of the star to collapse now, or null after the vertex was put back under the right key
// or dropped. Refused edges are made dearer and compared again.
StarEdge* Simplifier::choose(Index q, float limit) {
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
      record.key = large ? best->cost * 1.25f : best->cost;
      heap_->update(q, record.key);
      return nullptr;
    }
    if (best->refused) return best;
    const bool give_up = large && checks == kMostGuardChecks;
    for (StarEdge& edge : star_.edges) {
      if (give_up ? edge.refused != kPasses : &edge != best) continue;
      edge.refused = give_up ? kFlip : guard(q, edge);
      if (edge.refused == kPasses) return best;
      const Vec3f offset = complex_.offset(q, edge.vertex);
      edge.cost += kForcedShare * record.weight * dot(offset, offset);
    }
  }
}

Guard Simplifier::guard(Index q, const StarEdge& edge) {
  if (breaks_border(edge)) return kBorder;
  if (breaks_link(edge.vertex)) return kLink;
  if (flips(q, edge.vertex)) return kFlip;
  return kPasses;
}

// A vertex on a border or non-manifold edge may only slide along it, and not where several meet.
bool Simplifier::breaks_border(const StarEdge& edge) const {
  return star_.open_edges > 0 && (edge.triangles == 2 || star_.open_edges > 2);
}

// Link condition: what p and q both neighbour is on a triangle with both, and no two faces become
// one. Not told apart in time counts as broken.
bool Simplifier::breaks_link(Index p) {
  std::vector<VertexRecord>& vertices = complex_.vertices;
  const Index near = complex_.new_epoch(2), apex = near + 1;
  const bool large = vertices[p].ring_size > kLargeRing;
  if (!large)
    for (const Index corner : complex_.ring(p)) {
      vertices[complex_.corner_vertex[Complex::next(corner)]].mark = near;
      vertices[complex_.corner_vertex[Complex::previous(corner)]].mark = near;
    }
  for (const Spoke& spoke : star_.spokes) {
    if (spoke.next == p) vertices[spoke.previous].mark = apex;
    if (spoke.previous == p) vertices[spoke.next].mark = apex;
  }
  for (const Spoke& spoke : star_.spokes) {
    if (spoke.next == p || spoke.previous == p) continue;
    int apexes = 0;
    for (const Index x : {spoke.next, spoke.previous}) {
      if (vertices[x].mark == apex)
        ++apexes;
      else if (large ? has_neighbour(x, p) : vertices[x].mark == near)
        return true;
    }
    if (apexes == 2 && has_triangle(p, spoke.next, spoke.previous)) return true;
  }
  return false;
}

bool Simplifier::has_neighbour(Index vertex, Index other) {
  if (complex_.vertices[vertex].ring_size > 4 * kLargeRing) return true;
  return std::ranges::any_of(complex_.ring(vertex), [&](Index corner) {
    return complex_.corner_vertex[Complex::next(corner)] == other ||
           complex_.corner_vertex[Complex::previous(corner)] == other;
  });
}

bool Simplifier::has_triangle(Index a, Index b, Index c) {
  const auto size = [&](Index v) { return complex_.vertices[v].ring_size; };
  if (size(b) < size(a)) std::swap(a, b);
  if (size(c) < size(a)) std::swap(a, c);
  if (size(a) > 4 * kLargeRing) return true;
  return std::ranges::any_of(complex_.ring(a), [&](Index corner) {
    const Index x = complex_.corner_vertex[Complex::next(corner)];
    const Index y = complex_.corner_vertex[Complex::previous(corner)];
    return (x == b && y == c) || (x == c && y == b);
  });
}

bool Simplifier::flips(Index q, Index p) const {
  const Vec3f to_p = complex_.offset(q, p);
  for (const Spoke& spoke : star_.spokes) {
    if (spoke.next == p || spoke.previous == p) continue;
    const Vec3f a = complex_.offset(q, spoke.next), b = complex_.offset(q, spoke.previous);
    const Vec3f before = cross(a, b), u = a - to_p, v = b - to_p, after = cross(u, v);
    const float turn = dot(before, after);
    const float size_before = dot(before, before), size_after = dot(after, after);
    if (!(size_before > 0)) continue;  // was no face to begin with
    // In double precision: fourth powers of lengths squared.
    if (turn <= 0 || double{turn} * turn <
                         double{kLeastCosine} * kLeastCosine * size_before * double{size_after})
      return true;
    const auto longest = [](Vec3f s, Vec3f t) {
      const Vec3f w = s - t;
      return std::max({dot(s, s), dot(t, t), dot(w, w)});
    };
    const float length = longest(u, v);
    if (size_after < kSliver * kSliver * length * length) {
      const float length_before = longest(a, b);
      if (double{size_after} * length_before * length_before <
          double{size_before} * length * length)
        return true;
    }
  }
  return false;
}

void Simplifier::collapse(Index q, const StarEdge& edge) {
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
    wedges_->collapse(complex_, star_, p, offset, quadrics_[q], out_.moves);
  else
    out_.moves.push_back({q, p});
  complex_.append(p, moved_);
  from.ring_size = 0;
  heap_->remove(q);

  quadrics_[p].add(quadrics_[q], offset * -1);
  to.error += edge.error;
  to.weight += from.weight;
  const float mean = to.weight > 0 ? std::sqrt(to.error / to.weight) : 0;
  const double error = mean / complex_.scale[0] / complex_.scale[1];
  last_error_ = std::max(
      last_error_, static_cast<float>(std::min(error, double{std::numeric_limits<float>::max()})));
  out_.collapses.push_back({q, p, last_error_, static_cast<Index>(out_.moves.size() - first_move)});
  switch (edge.refused) {
    case kBorder:
      ++out_.forced_border;
      break;
    case kLink:
      ++out_.forced_link;
      break;
    case kFlip:
      ++out_.forced_flip;
      break;
    default:
      break;
  }
  if (edge.refused != kPasses) {
    to.regular = false;
    for (const StarEdge& other : star_.edges) complex_.vertices[other.vertex].regular = false;
  }
  to.regular &= from.regular;
  const StarEdge* const chosen = &edge;
  float least = to.key;
  for (const StarEdge& other : star_.edges) {
    if (&other == chosen) continue;
    touch(other.vertex, p);
    least = std::min(least, plain_cost(p, other.vertex));
  }
  if (to.ring_size > kLargeRing)
    touch(p, q);
  else
    lower(p, std::min(least, to.floor));
}

// The star of x has changed, and p may be a new neighbour.
void Simplifier::touch(Index x, Index p) {
  VertexRecord& record = complex_.vertices[x];
  if (record.ring_size > kLargeRing) {
    if (++record.touches < std::min<Index>(record.ring_size / 8, 0xffff)) return;
    record.touches = 0;
    lower(x, record.floor);
    return;
  }
  lower(x, std::min(record.floor, plain_cost(x, p)));
}

// A vertex that left the heap, since its star was used up or too dear, stays out.
void Simplifier::lower(Index x, float key) {
  VertexRecord& record = complex_.vertices[x];
  if (!(key < record.key) || record.error == kInfinity || !heap_->contains(x)) return;
  record.key = record.floor = key;
  heap_->update(x, key);
}

}  // namespace

CollapseSequence simplify(const SimplifyInput& input, const SimplifyOptions& options,
                          const Progress& progress) {
  assert(input.positions.size() % 3 == 0 && input.triangles.size() % 3 == 0);
  assert(input.group.empty() || input.group.size() == input.triangles.size() / 3);
  return Simplifier(input, options).run(progress);
}

}  // namespace pstrip
