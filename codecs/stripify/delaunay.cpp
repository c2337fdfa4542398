#include "codecs/stripify/delaunay.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "codecs/stripify/random.h"
#include "codecs/triangulate/predicates.h"

namespace pstrips::inline codecs {
namespace {

// Two vertices farther away than any circle through points reaches, so that the triangles that have
// neither are exactly the Delaunay triangulation: one to the right and below all points, one to
// the left and above, the latter much farther still. Which side of a line through one of them a
// point is on is then a question of which point is above the other. [deBerg08 §9.3]
constexpr Index kFarRight = 0xffff'fffd, kFarLeft = 0xffff'fffe;
constexpr bool is_far(Index vertex) { return vertex >= kFarRight; }

bool is_above(const Point2& a, const Point2& b) { return a.y != b.y ? a.y > b.y : a.x > b.x; }

// The place along Hilbert's curve of order 16 of a cell of 65,536 × 65,536.
std::uint32_t hilbert_place(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (std::uint32_t side = 1u << 15; side > 0; side /= 2) {
    const bool right = (x & side) != 0, up = (y & side) != 0;
    place = place * 4 + (right ? 3u : 0u) - (right && up ? 1u : 0u) + (!right && up ? 1u : 0u);
    if (up) continue;
    if (right) {
      x = ~x;
      y = ~y;
    }
    std::swap(x, y);
  }
  return place;
}

/// Points in the order of their insertion, the highest first.
struct Insertion {
  std::vector<Point2> points;
  std::vector<Index> source;  // which point of the input each is
};

// Depends on every bit of every coordinate.
std::uint32_t seed_of(std::span<const double> positions, std::uint32_t seed) {
  std::uint64_t hash = seed;
  for (const double value : positions) {
    hash ^= std::bit_cast<std::uint64_t>(value);
    hash *= 0x9e37'79b9'7f4a'7c15;
    hash ^= hash >> 32;
  }
  return static_cast<std::uint32_t>(hash);
}

// The cells of Hilbert's curve that points are in.
class Cells {
 public:
  void include(const Point2& p) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  std::uint32_t place(const Point2& p) const {
    return hilbert_place(cell(p.x, low_.x, high_.x), cell(p.y, low_.y, high_.y));
  }

 private:
  static std::uint32_t cell(double value, double low, double high) {
    // In halves, so that the extent of the largest doubles does not overflow.
    const double extent = high / 2 - low / 2;
    if (!(extent > 0)) return 0;
    return static_cast<std::uint32_t>((value / 2 - low / 2) / extent * 65535);
  }
  Point2 low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
};

// In rounds, each point in the last one with probability 1/2, in the one before with 1/4, and so
// on, and along Hilbert's curve within each round: a biased randomized insertion order. [Amenta03]
Insertion insertion_order(std::span<const double> positions, std::uint32_t seed) {
  struct Keyed {
    std::uint64_t key;
    Index point;
    bool operator<(const Keyed& other) const {
      return key != other.key ? key < other.key : point < other.point;
    }
  };
  const auto at = [&](Index i) {
    return Point2{positions[std::size_t{3} * i], positions[std::size_t{3} * i + 1]};
  };
  const auto count = static_cast<Index>(positions.size() / 3);
  std::vector<Keyed> order;
  order.reserve(count);
  Cells cells;
  for (Index i = 0; i < count; ++i) {
    const auto xyz = positions.subspan(std::size_t{3} * i, 3);
    if (!std::ranges::all_of(xyz, [](double v) { return std::isfinite(v); })) continue;
    order.push_back({0, i});
    cells.include(at(i));
  }
  Random random(seed_of(positions, seed));
  for (Keyed& k : order) {
    const auto rounds_before_last = static_cast<unsigned>(std::countl_zero(random.bits()));
    k.key = std::uint64_t{32 - rounds_before_last} << 32 | cells.place(at(k.point));
  }
  std::sort(order.begin(), order.end());
  const auto highest = std::max_element(
      order.begin(), order.end(),
      [&](const Keyed& a, const Keyed& b) { return is_above(at(b.point), at(a.point)); });
  if (highest != order.end()) std::rotate(order.begin(), highest, highest + 1);
  Insertion out;
  out.points.reserve(order.size());
  out.source.reserve(order.size());
  for (const Keyed& k : order) {
    out.points.push_back(at(k.point));
    out.source.push_back(k.point);
  }
  return out;
}

/// Half-edge k of triangle t runs from corner k to the next and has number 4 t + k. Corner 0 is the
/// one inserted last: new triangles are a fan around it, and half-edge 1 is on the fan's border.
struct Triangle {
  std::array<Index, 3> vertex;
  std::array<Index, 3> link;  // opposite half-edges, or kNone
  Index leaf = 0;             // of the history
  Index steps = 0;            // bit k: its strip steps over half-edge k; or kDone
};

constexpr Index triangle_at(Index half_edge) { return half_edge >> 2; }
constexpr Index corner_at(Index half_edge) { return half_edge & 3; }
constexpr Index after(Index corner) { return corner == 2 ? 0 : corner + 1; }
constexpr Index before(Index corner) { return corner == 0 ? 2 : corner - 1; }

/// A node of the history: tests on which side of a line a point is, or names a triangle.
struct Test {
  Index from;         // kNone: a leaf
  Index to;           // in a leaf, the triangle
  Index left, right;  // nodes; points on the line may go either way
};

/// Incremental construction. With `with_strips`, each triangle has a bit for each edge that its
/// strip steps over: at most two, agreeing on both sides.
template <bool with_strips>
class Triangulator {
 public:
  explicit Triangulator(Insertion insertion)
      : points_(std::move(insertion.points)), source_(std::move(insertion.source)) {
    triangles_.reserve(points_.size() * 2 + 1);
    // Five for its triangles, two for each of three flips: vertices have six neighbours on average.
    history_.reserve(points_.size() * 11);
  }

  void run() {
    if (points_.empty()) return;
    add_slot();
    fill(0, {0, kFarLeft, kFarRight}, {kNone, kNone, kNone}, 0);
    for (Index p = 1; p < points_.size(); ++p) insert(p);
  }

  /// Three points of the input a triangle.
  std::vector<Index> triangles() const {
    std::vector<Index> out;
    out.reserve(triangles_.size() * 3);
    for (const Triangle& t : triangles_)
      if (std::ranges::none_of(t.vertex, is_far))
        for (const Index v : t.vertex) out.push_back(source_[v]);
    return out;
  }

  /// Writes the strips out, each joined at both ends with what it can go on into; once.
  Strips take_strips() {
    strips_.reserve(triangles_.size() * 7 / 4);
    for (auto t = static_cast<Index>(triangles_.size()); t-- > 0;)
      if (is_end(t)) write_strip_through(t);
    for (auto t = static_cast<Index>(triangles_.size()); t-- > 0;)  // what was cycles
      if (!is_done(4 * t)) write_strip_through(t);
    if (!strips_.empty()) strips_.pop_back();  // the last restart
    return std::move(strips_);
  }

 private:
  // Locating.

  // Where x is from the line from p to a vertex: 1 left, -1 right, 0 on it.
  int side(Index p, Index vertex, const Point2& x) const {
    if (!is_far(vertex)) return orient(points_[p], points_[vertex], x);
    return is_above(x, points_[p]) == (vertex == kFarRight) ? 1 : -1;
  }

  // A triangle that has x inside or on its border.
  Index locate(const Point2& x) const {
    const Test* test = &history_[0];
    while (test->from != kNone)
      test = &history_[side(test->from, test->to, x) >= 0 ? test->left : test->right];
    return test->to;
  }

  // Building blocks. A triangle that is replaced leaves its place in the array to one of the new
  // ones, and its leaf to the test that parts them.

  Index add_slot() {
    triangles_.emplace_back();
    return static_cast<Index>(triangles_.size() - 1);
  }
  Index add_node(const Test& test) {
    assert(history_.size() < kNone);
    history_.push_back(test);
    return static_cast<Index>(history_.size() - 1);
  }
  // Puts a triangle into a slot, all of it new but for its links; returns its leaf.
  Index fill(Index t, std::array<Index, 3> vertex, std::array<Index, 3> link, unsigned step_out) {
    const Index leaf = add_node({kNone, t, 0, 0});
    const bool is_hidden = is_far(vertex[1]) || is_far(vertex[2]);
    triangles_[t] = {vertex, link, leaf, with_strips && is_hidden ? kDone : step_out << 1};
    if (link[1] != kNone) link_back(link[1], 4 * t + 1);
    suspects_.push_back(t);
    return leaf;
  }
  void link_back(Index half_edge, Index opposite) {
    triangles_[triangle_at(half_edge)].link[corner_at(half_edge)] = opposite;
  }
  Index opposite(Index half_edge) const {
    return triangles_[triangle_at(half_edge)].link[corner_at(half_edge)];
  }
  unsigned step(Index t, Index k) const { return with_strips ? triangles_[t].steps >> k & 1u : 0; }

  // Inserting.

  void insert(Index p) {
    const Point2& x = points_[p];
    const Index t = locate(x);
    const std::array<Index, 3> vertex = triangles_[t].vertex;
    for (const Index v : vertex)
      if (!is_far(v) && points_[v] == x) {
        source_[v] = std::min(source_[v], source_[p]);
        return;
      }
    const auto is_on = [&](Index a, Index b) {
      return !is_far(a) && !is_far(b) && orient(points_[a], points_[b], x) == 0;
    };
    Index k = 0;
    while (k < 3 && !is_on(vertex[k], vertex[after(k)])) ++k;
    if (k == 3)
      split_triangle(t, p);
    else
      split_edge(4 * t + k, p);
    restore_delaunay();
    if (with_strips) lead_strips(t);
  }

  // All but p of a closed fan around it; triangle i is (p, rim[i], rim[i + 1]).
  template <Index count>
  struct Fan {
    std::array<Index, count> slot, rim, outer;
    std::array<unsigned, count> step_out;
  };
  template <Index count>
  std::array<Index, count> fill_fan(Index p, const Fan<count>& fan) {
    std::array<Index, count> leaves;
    for (Index i = 0; i < count; ++i) {
      const Index next = (i + 1) % count, last = (i + count - 1) % count;
      leaves[i] = fill(fan.slot[i], {p, fan.rim[i], fan.rim[next]},
                       {4 * fan.slot[last] + 2, fan.outer[i], 4 * fan.slot[next]}, fan.step_out[i]);
    }
    return leaves;
  }

  void split_triangle(Index t, Index p) {
    const Index root = triangles_[t].leaf;
    const auto [a, b, c] = triangles_[t].vertex;
    const Index s = add_slot(), r = add_slot();
    const auto [ab, bc, ca] = fill_fan<3>(
        p, {{t, s, r}, {a, b, c}, triangles_[t].link, {step(t, 0), step(t, 1), step(t, 2)}});
    const Index beyond_b = add_node({p, c, ca, bc}), short_of_b = add_node({p, a, ab, ca});
    history_[root] = {p, b, beyond_b, short_of_b};
  }

  void split_edge(Index h, Index p) {
    const Index s = add_slot(), r = add_slot();
    const Index t = triangle_at(h), u = triangle_at(opposite(h));
    const Index k = corner_at(h), k1 = after(k), k2 = before(k);
    const Index j = corner_at(opposite(h)), j1 = after(j), j2 = before(j);
    const Triangle here = triangles_[t], there = triangles_[u];
    const Index c = here.vertex[k2], d = there.vertex[j2];
    const auto [bc, ca, ad, db] =
        fill_fan<4>(p, {{t, s, u, r},
                        {here.vertex[k1], c, there.vertex[j1], d},
                        {here.link[k1], here.link[k2], there.link[j1], there.link[j2]},
                        {step(t, k1), step(t, k2), step(u, j1), step(u, j2)}});
    history_[here.leaf] = {p, c, ca, bc};
    history_[there.leaf] = {p, d, db, ad};
  }

  // Flipping.

  void restore_delaunay() {
    while (!suspects_.empty()) {
      const Index t = suspects_.back();
      suspects_.pop_back();
      const Index o = triangles_[t].link[1];
      if (o == kNone) continue;
      const Index l = triangles_[triangle_at(o)].vertex[before(corner_at(o))];
      const auto [p, a, b] = triangles_[t].vertex;
      if (is_illegal(p, a, b, l)) flip(t);
    }
  }

  // Whether edge ab of the triangles (p, a, b) and (b, a, l) must give way to pl. p is not far.
  bool is_illegal(Index p, Index a, Index b, Index l) const {
    if (!is_far(a) && !is_far(b))
      return !is_far(l) && in_circle(points_[p], points_[a], points_[b], points_[l]) > 0;
    // A far vertex is outside the circle through the other three: the edge to it goes if it can,
    // which takes a convex quadrilateral. Of two far ones the edge to the farther goes.
    if (is_far(l)) return l == kFarRight && is_above(points_[b], points_[p]);
    if (is_far(a)) return orient(points_[l], points_[b], points_[p]) > 0;
    return orient(points_[p], points_[a], points_[l]) > 0;
  }

  // Replaces t and the triangle over its half-edge 1.
  void flip(Index t) {
    const Index o = triangles_[t].link[1];
    const Index u = triangle_at(o), j1 = after(corner_at(o)), j2 = before(corner_at(o));
    const auto [p, a, b] = triangles_[t].vertex;
    const auto [pa, ab, bp] = triangles_[t].link;
    const Index l = triangles_[u].vertex[j2];
    const Index al = triangles_[u].link[j1], lb = triangles_[u].link[j2];
    const unsigned step_al = step(u, j1), step_lb = step(u, j2);
    const Index root_t = triangles_[t].leaf, root_u = triangles_[u].leaf;
    const Index right = fill(t, {p, a, l}, {pa, al, 4 * u}, step_al);
    const Index left = fill(u, {p, l, b}, {4 * t + 2, lb, bp}, step_lb);
    link_back(bp, 4 * u + 2);
    history_[root_t] = history_[root_u] = {p, l, left, right};
  }

  // Strips.

  // A value of Triangle::steps: the triangle is written, or no part of the result.
  static constexpr Index kDone = 8;

  // How many steps more a triangle can have.
  unsigned room(Index t) const {
    static constexpr std::array<std::uint8_t, kDone + 1> kRoom{2, 1, 1, 0, 1};
    return kRoom[triangles_[t].steps];
  }
  bool is_end(Index t) const { return room(t) > 0; }

  // Leads strips through the triangles around the new point, of which t is one. Those that step
  // over the border stay; from triangle to triangle a strip steps wherever both have room.
  void lead_strips(Index t) {
    fan_.clear();
    std::size_t start = 0;  // where a strip can come from one side and go to the other
    for (Index at = t; fan_.empty() || at != t; at = triangle_at(triangles_[at].link[2])) {
      const unsigned at_room = room(at);
      if (at_room == 2) start = fan_.size();
      fan_.push_back({at, at_room});
    }
    std::size_t steps = 0;
    for (std::size_t i = 0, at = start; i < fan_.size(); ++i) {
      const std::size_t next = at + 1 == fan_.size() ? 0 : at + 1;
      if (fan_[at].room == 2 && i > 0) step_out(fan_[at]);
      const bool closes = i + 1 == fan_.size() && steps == i;
      if (fan_[at].room > 0 && fan_[next].room > 0 && !closes) {
        triangles_[fan_[at].triangle].steps |= 4;
        triangles_[fan_[next].triangle].steps |= 1;
        --fan_[at].room;
        --fan_[next].room;
        ++steps;
      }
      at = next;
    }
  }

  struct FanTriangle {
    Index triangle;
    unsigned room;
  };

  // Steps over the border if the other side has room, too.
  void step_out(FanTriangle& at_border) {
    const Index o = triangles_[at_border.triangle].link[1];
    if (o == kNone || room(triangle_at(o)) == 0) return;
    triangles_[at_border.triangle].steps |= 2;
    triangles_[triangle_at(o)].steps |= 1u << corner_at(o);
    --at_border.room;
  }

  // Writing. Most of the time that strips take is waiting for triangles from memory. So strips are
  // followed and written at once, those of the last round first, which is half of the triangles
  // along the curve; and a triangle's neighbours are prefetched before it is known which is next.

  // What joins two triangles of a strip: half-edges opposite to each other.
  struct Joint {
    Index exit, entry;
  };

  void write_strip_through(Index t) {
    path_.clear();
    const unsigned steps = std::exchange(triangles_[t].steps, kDone);
    follow(t, steps);
    const unsigned used = path_.empty() ? 0 : 1u << corner_at(path_.front().exit);
    for (Joint& joint : path_) std::swap(joint.exit, joint.entry);
    std::reverse(path_.begin(), path_.end());
    follow(t, steps & ~used);
    write(t);
  }

  // Goes on from t, which has `steps` left, as far as strips lead that are not written.
  void follow(Index t, unsigned steps) {
    for (;;) {
      Index k = steps ? static_cast<Index>(std::countr_zero(steps)) : kNone;
      if (k == kNone || is_done(triangles_[t].link[k])) k = next_exit(t);
      if (k == kNone) return;
      for (const Index o : triangles_[t].link) __builtin_prefetch(&triangles_[triangle_at(o)]);
      const Index entry = triangles_[t].link[k];
      path_.push_back({4 * t + k, entry});
      t = triangle_at(entry);
      steps = std::exchange(triangles_[t].steps, kDone) & ~(1u << corner_at(entry));
    }
  }
  bool is_done(Index half_edge) const { return triangles_[triangle_at(half_edge)].steps == kDone; }
  // To the end of a strip, or into one from the side: what is left of it are as many strips as
  // there were, and where it was a cycle, one less.
  Index next_exit(Index t) const {
    for (Index k = 0; k < 3; ++k)
      if (is_end(triangle_at(triangles_[t].link[k]))) return k;
    for (Index k = 0; k < 3; ++k)
      if (!is_done(triangles_[t].link[k])) return k;
    return kNone;
  }

  Index point(Index t, Index corner) const { return source_[triangles_[t].vertex[corner]]; }

  // As emit_strips() writes a strip. t: the strip's triangle if there is one only.
  void write(Index t) {
    if (path_.empty()) {
      strips_.insert(strips_.end(), {point(t, 0), point(t, 1), point(t, 2), kRestart});
      return;
    }
    const Index first = triangle_at(path_.front().exit), k = corner_at(path_.front().exit);
    Index older = point(first, k), newer = point(first, after(k));
    strips_.insert(strips_.end(), {point(first, before(k)), older, newer});
    bool even = true;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      const Index entry = path_[i].entry, apex_corner = before(corner_at(entry));
      if (i + 1 < path_.size() && (corner_at(path_[i + 1].exit) == apex_corner) != even) {
        strips_.push_back(older);
        std::swap(older, newer);
        even = !even;
      }
      const Index apex = point(triangle_at(entry), apex_corner);
      strips_.push_back(apex);
      older = newer;
      newer = apex;
      even = !even;
    }
    strips_.push_back(kRestart);
  }

  std::vector<Point2> points_;  // in the order of insertion, which is vertices' numbers
  std::vector<Index> source_;   // which point of the input each is
  std::vector<Triangle> triangles_;
  std::vector<Test> history_;
  std::vector<Index> suspects_;   // triangles of the new fan whose border may be illegal
  std::vector<FanTriangle> fan_;  // the triangles around the new point
  std::vector<Joint> path_;       // of the strip that is written
  Strips strips_;
};

template <bool with_strips>
Triangulator<with_strips> triangulate_points(std::span<const double> positions,
                                             const StripOptions& options) {
  assert(positions.size() % 3 == 0 && positions.size() / 3 <= kMaxDelaunayPoints);
  Triangulator<with_strips> triangulator(insertion_order(positions, options.seed));
  triangulator.run();
  return triangulator;
}

}  // namespace

Strips delaunay_strips(std::span<const double> positions, const StripOptions& options) {
  return triangulate_points<true>(positions, options).take_strips();
}

std::vector<Index> delaunay_triangles(std::span<const double> positions,
                                      const StripOptions& options) {
  return triangulate_points<false>(positions, options).triangles();
}

}  // namespace pstrips::inline codecs
