// Maps from each level of a progressive mesh to the next coarser one, and how far they move points.
//
// [Cohen97] Cohen, Manocha, Olano, "Simplifying Polygonal Models Using Successive Mappings".

#include "codecs/measure/error_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "codecs/measure/fan_map.h"
#include "codecs/measure/patch_map.h"
#include "core/point.h"

namespace pstrips::inline codecs {
namespace {

using Plane = std::array<double, 2>;

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(const Point& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }
float rounded_up(double x) { return static_cast<float>(x * (1 + 0x1p-22)); }
double turn(const Plane& a, const Plane& b) { return a[0] * b[1] - a[1] * b[0]; }
bool is_finite(const Point& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

// Directions across a normal: what is counter-clockwise around it is so in the plane.
struct PlaneAxes {
  Point x, y;
  bool around(const Point& normal) {
    const double size = length(normal);
    if (!(size > 0) || !std::isfinite(1 / size)) return false;
    const Point n = normal * (1 / size);
    std::size_t least = std::abs(n[0]) < std::abs(n[1]) ? 0 : 1;
    if (std::abs(n[2]) < std::abs(n[least])) least = 2;
    Point axis{};
    axis[least] = 1;
    x = cross(axis, n);
    y = cross(n, x);
    return true;
  }
  Plane operator()(const Point& p) const { return {dot(x, p), dot(y, p)}; }
};

// Turns `normal` until all triangles of both fans face its way, if it can.
bool turn_to_face(const FanMap& fan, Point& normal, std::vector<Point>& normals) {
  normals.clear();
  const std::size_t n = fan.rim.size();
  for (const Point& apex : {fan.centre, fan.target})
    for (std::size_t i = 0; i + (fan.closed ? 0 : 1) < n; ++i) {
      const Point across = cross(fan.rim[i].position - apex, fan.rim[(i + 1) % n].position - apex);
      const double size = length(across);
      if (size > 0) normals.push_back(across * (1 / size));
    }
  const double size = length(normal);
  normal = size > 0 ? normal * (1 / size) : Point{};
  for (int round = 0; round < 32; ++round) {
    double least = 1e-3;
    const Point* worst = nullptr;
    for (const Point& each : normals)
      if (dot(each, normal) < least) least = dot(each, normal), worst = &each;
    if (!worst) return true;
    normal = normal + *worst;
  }
  return false;
}

struct Face {
  Index vertex[3];  // kNone: dead
  Index next[3];    // corner at the same vertex, in a circle
  DisplacementBox box;
};

// The live triangles around a vertex. Where they are a disc they stand in winding order, triangle i
// between neighbours i and i + 1.
struct Ring {
  enum class Kind { closed, open, irregular };
  Index vertex = kNone;
  Kind kind = Kind::irregular;
  std::vector<Index> faces;
  std::vector<Index> neighbours;  // of a disc; one more than faces when it is open

  bool is_closed() const { return kind == Kind::closed; }
};

constexpr float kUnbounded = std::numeric_limits<float>::max();
// What may be spent where maps cost more than a collapse does: crossings of fans and triangles
// looked at by patches, some 20 ns each. Ordinary meshes need a part of it.
constexpr std::uint64_t kWorkAtOnce = 1 << 22;
constexpr std::uint64_t kWorkEach = 64;
// Up to so many triangles around a vertex looking through them is quicker than a list by vertex.
constexpr Index kSmallRing = 24;
constexpr std::size_t kAhead = 8;  // collapses, and so steps around a vertex; rings have 6 or so
// Of the error so far: triangles nearer than this are not worth a better map.
constexpr double kNearEnough = 1.0 / 16;

class Replay {
 public:
  explicit Replay(CollapsedSurface surface);
  void collapse(std::size_t i);
  /// Of the level that is reached.
  float bound() const;

 private:
  // What has shrunk to a vertex without triangles is within a distance; before that:
  static constexpr float kOutside = -2;  // no triangle ever was there
  static constexpr float kNothing = -1;

  Point placement(std::size_t i) const {
    return Point{placements_[3 * i], placements_[3 * i + 1], placements_[3 * i + 2]} * scale_;
  }
  bool is_dead(Index face) const { return faces_[face].vertex[0] == kNone; }
  void add_face(Index f, std::span<const Index> corners);
  void fetch_ahead(std::size_t i);
  void gather(Index vertex, Ring& ring);
  void order(Ring& ring);

  bool map_between(Ring& kept, Ring& removed, const Point& place);
  bool move_then_map(Ring& kept, Ring& removed, const Point& place);
  bool move(const Ring& ring, const Point& to);
  bool move_inside(const Ring& ring, const Point& to);
  bool move_on_border(const Ring& ring, const Point& to);
  bool map_onto(const Ring& ring, Index kept);
  bool run_fan(const Point& normal);
  bool raises_error(std::size_t corners) const;
  void shift(Index face, const Point& step);

  PatchMap::Patch patch_of(Index face) const;
  void save(const Ring& ring, Index except);
  void merge(const Ring& ring, Index kept);
  void settle(Index kept, bool is_mapped, bool has_moved);
  double map_patches(Index kept, bool has_moved);
  double leave_points();
  void shrink_to(Index vertex);

  std::span<const Collapse> collapses_;
  std::array<Index, kAhead> ahead_;  // a corner at the vertex of each coming collapse, or kNone
  std::span<const double> placements_;
  double scale_ = 1;  // of a model unit: the largest coordinate is about 1
  double error_ = 0;
  std::uint64_t work_left_ = kWorkAtOnce;
  std::vector<Face> faces_;
  std::vector<Point> points_;
  std::vector<Index> corner_at_;  // any corner of each vertex, or kNone
  std::vector<float> shrunk_;     // by vertex, see kNothing
  std::vector<Index> alias_;      // the vertex that stands for each now, with free placement
  std::vector<Index> slot_;       // by vertex, while a ring is put in order
  std::vector<Index> corners_, firsts_, seconds_, in_order_, changed_;
  std::vector<std::pair<Index, Index>> bereft_;  // third vertices of triangles that died, and these
  std::vector<std::uint8_t> follows_;
  std::vector<Point> normals_;
  Ring kept_ring_, removed_ring_;
  FanMap fan_;
  PatchMap patches_;
};

Replay::Replay(CollapsedSurface surface)
    : collapses_(surface.collapses),
      placements_(surface.placements),
      points_(std::move(surface.positions)) {
  ahead_.fill(kNone);
  const std::size_t vertices = points_.size();
  double most = 0;
  const auto look_at = [&](double x) {
    if (std::isfinite(x)) most = std::max(most, std::abs(x));
  };
  for (const Point& p : points_) std::ranges::for_each(p, look_at);
  std::ranges::for_each(placements_, look_at);
  if (most > 0) scale_ = std::ldexp(1.0, std::clamp(-std::ilogb(most), -1000, 1000));
  for (Point& p : points_) p = p * scale_;
  corner_at_.assign(vertices, kNone);
  shrunk_.assign(vertices, kOutside);
  slot_.assign(vertices, 0);
  if (!placements_.empty()) {
    alias_.resize(vertices);
    std::iota(alias_.begin(), alias_.end(), Index{0});
  }
  faces_.resize(surface.triangles.size() / 3);
  for (Index f = 0; f < faces_.size(); ++f)
    add_face(f, std::span(surface.triangles).subspan(std::size_t{3} * f, 3));
  for (std::size_t v = 0; v < vertices; ++v)
    if (shrunk_[v] == kNothing && corner_at_[v] == kNone) shrunk_[v] = 0;
}

void Replay::add_face(Index f, std::span<const Index> corners) {
  Face& face = faces_[f];
  std::ranges::copy(corners, face.vertex);
  for (const Index v : corners) shrunk_[v] = kNothing;
  if (!std::ranges::all_of(corners, [&](Index v) { return is_finite(points_[v]); })) {
    face.vertex[0] = kNone;
    return;
  }
  for (Index k = 0; k < 3; ++k) {
    const Index corner = 3 * f + k;
    Index& any = corner_at_[corners[k]];
    Index& after = any == kNone ? any : faces_[any / 3].next[any % 3];
    face.next[k] = any == kNone ? corner : after;
    after = corner;
  }
}

float Replay::bound() const {
  const double model_units = error_ / scale_;
  return static_cast<float>(
      std::min<double>(model_units + model_units * 0x1p-23 +
                           (error_ > 0 ? std::numeric_limits<float>::denorm_min() : 0),
                       kUnbounded));
}

// Forgets the vertex's dead corners.
void Replay::gather(Index vertex, Ring& ring) {
  ring.vertex = vertex;
  ring.kind = Ring::Kind::irregular;
  ring.faces.clear();
  ring.neighbours.clear();
  corners_.clear();
  const Index first = corner_at_[vertex];
  if (first == kNone) return;
  Index corner = first;
  do {
    if (!is_dead(corner / 3)) corners_.push_back(corner);
    corner = faces_[corner / 3].next[corner % 3];
  } while (corner != first);
  corner_at_[vertex] = corners_.empty() ? kNone : corners_[0];
  for (std::size_t i = 0; i < corners_.size(); ++i)
    faces_[corners_[i] / 3].next[corners_[i] % 3] = corners_[(i + 1) % corners_.size()];
  for (const Index c : corners_) ring.faces.push_back(c / 3);
  if (!corners_.empty()) order(ring);
}

void Replay::order(Ring& ring) {
  const Index n = static_cast<Index>(corners_.size());
  firsts_.clear();
  seconds_.clear();
  for (const Index c : corners_) {
    const Face& face = faces_[c / 3];
    firsts_.push_back(face.vertex[(c + 1) % 3]);
    seconds_.push_back(face.vertex[(c + 2) % 3]);
  }
  const bool is_small = n <= kSmallRing;
  for (Index i = 0; i < n && !is_small; ++i) slot_[firsts_[i]] = i;
  const auto starting_with = [&](Index neighbour) -> Index {
    if (!is_small) {
      const Index i = slot_[neighbour];
      return i < n && firsts_[i] == neighbour ? i : kNone;
    }
    for (Index i = 0; i < n; ++i)
      if (firsts_[i] == neighbour) return i;
    return kNone;
  };
  follows_.assign(n, 0);
  for (Index i = 0; i < n; ++i) {
    if (starting_with(firsts_[i]) != i) return;  // two start with it
    const Index next = starting_with(seconds_[i]);
    if (next != kNone) follows_[next] = 1;
  }
  const auto first = std::ranges::find(follows_, 0);
  const Index start = first == follows_.end() ? 0 : static_cast<Index>(first - follows_.begin());
  in_order_.clear();
  Index at = start;
  do {
    in_order_.push_back(corners_[at] / 3);
    ring.neighbours.push_back(firsts_[at]);
    const Index second = seconds_[at];
    at = starting_with(second);
    if (at == kNone) ring.neighbours.push_back(second);
  } while (at != kNone && at != start && in_order_.size() < n);
  if (in_order_.size() < n || (at != kNone && at != start)) return;
  ring.kind = at == start ? Ring::Kind::closed : Ring::Kind::open;
  std::ranges::copy(in_order_, ring.faces.begin());
}

// Points of the triangle move by up to `step`.
void Replay::shift(Index face, const Point& step) {
  DisplacementBox& box = faces_[face].box;
  Point low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(0.0, step[k]);
    high[k] = std::max(0.0, step[k]);
  }
  const DisplacementBox before = box;
  box.add(before, low, high);
}

bool Replay::run_fan(const Point& normal) {
  PlaneAxes axes;
  if (fan_.rim.size() < 3 || !axes.around(normal)) return false;
  const std::uint64_t work = fan_.rim.size() * fan_.rim.size() / 4;
  if (work > work_left_) return false;
  work_left_ -= work;
  for (FanMap::Corner& corner : fan_.rim) corner.plane = axes(corner.position - fan_.centre);
  fan_.rim[0].plane = axes(fan_.target - fan_.centre);
  fan_.centre_plane = {0, 0};
  if (!fan_.closed) {
    const Point edge = fan_.rim.back().position - fan_.target;
    const double t = dot(fan_.centre - fan_.target, edge) / dot(edge, edge);
    if (!(t > 1e-6)) return false;
    fan_.centre_plane = axes(fan_.target + edge * std::min(t, 0.999) - fan_.centre);
  }
  return fan_.run();
}

// Collapses the ring's vertex onto a neighbour.
bool Replay::map_onto(const Ring& ring, Index kept) {
  if (ring.kind == Ring::Kind::irregular) return false;
  const std::size_t n = ring.neighbours.size(), triangles = ring.faces.size();
  const std::size_t at =
      static_cast<std::size_t>(std::ranges::find(ring.neighbours, kept) - ring.neighbours.begin());
  if (at == n || (!ring.is_closed() && at != 0 && at != n - 1)) return false;
  const bool reversed = !ring.is_closed() && at != 0;
  const auto neighbour = [&](std::size_t i) { return reversed ? n - 1 - i : (at + i) % n; };
  const auto triangle = [&](std::size_t i) { return reversed ? triangles - 1 - i : (at + i) % n; };
  fan_.closed = ring.is_closed();
  fan_.centre = points_[ring.vertex];
  fan_.target = points_[kept];
  fan_.rim.resize(n);
  for (std::size_t i = 0; i < n; ++i) fan_.rim[i].position = points_[ring.neighbours[neighbour(i)]];
  for (std::size_t i = 0; i < triangles; ++i) fan_.rim[i].box = faces_[ring.faces[triangle(i)]].box;
  Point normal{};
  for (std::size_t i = 1; i + 1 < n; ++i)
    normal =
        normal + cross(fan_.rim[i].position - fan_.target, fan_.rim[i + 1].position - fan_.target);
  if (!run_fan(normal) && !(turn_to_face(fan_, normal, normals_) && run_fan(normal))) return false;
  if (patches_.before.empty() && raises_error(n)) save(ring, kNone);
  for (std::size_t i = 1; i + 1 < n; ++i) faces_[ring.faces[triangle(i)]].box = fan_.after[i];
  return true;
}

// Whether the fan's new triangles would.
bool Replay::raises_error(std::size_t corners) const {
  for (std::size_t i = 1; i + 1 < corners; ++i)
    if (fan_.after[i].longest() > error_) return true;
  return false;
}

// Moves the ring's vertex: onto the point of the surface below `to`, then up to it.
bool Replay::move_inside(const Ring& ring, const Point& to) {
  const std::size_t n = ring.neighbours.size();
  const Point& from = points_[ring.vertex];
  const auto spoke = [&](std::size_t i) { return points_[ring.neighbours[i % n]] - from; };
  Point normal{};
  for (std::size_t i = 0; i < n; ++i) normal = normal + cross(spoke(i), spoke(i + 1));
  PlaneAxes axes;
  if (!axes.around(normal)) return false;
  const Plane place = axes(to - from);
  for (std::size_t m = 0; m < n; ++m) {
    const Plane a = axes(spoke(m)), b = axes(spoke(m + 1));
    const double before = turn(a, place), after = turn(place, b), whole = turn(a, b);
    if (!(before >= 0 && after > 0 && before + after <= whole)) continue;
    const Point foot = from + spoke(m) * (after / whole) + spoke(m + 1) * (before / whole);
    fan_.closed = true;
    fan_.centre = from;
    fan_.target = to;
    fan_.rim.resize(n + 1);
    fan_.rim[0].position = foot;
    fan_.rim[0].box = faces_[ring.faces[m]].box;
    for (std::size_t i = 1; i <= n; ++i) {
      fan_.rim[i].position = points_[ring.neighbours[(m + i) % n]];
      fan_.rim[i].box = faces_[ring.faces[(m + i) % n]].box;
    }
    if (!run_fan(normal)) return false;
    for (std::size_t i = 1; i < n; ++i) faces_[ring.faces[(m + i) % n]].box = fan_.after[i];
    shift(ring.faces[m], to - foot);
    return true;
  }
  return false;
}

// The same along the border: onto the nearest point of it, then off to `to`.
bool Replay::move_on_border(const Ring& ring, const Point& to) {
  const std::size_t n = ring.neighbours.size(), triangles = ring.faces.size();
  const Point& from = points_[ring.vertex];
  double nearest = length(to - from);
  Point foot = from;
  bool reversed = false;
  for (const bool last : {false, true}) {
    const Point edge = points_[ring.neighbours[last ? n - 1 : 0]] - from;
    const double t = std::clamp(dot(to - from, edge) / dot(edge, edge), 0.0, 0.999);
    const Point there = from + edge * t;
    if (!(length(to - there) < nearest)) continue;
    nearest = length(to - there);
    foot = there;
    reversed = last;
  }
  if (foot == from) {
    for (const Index f : ring.faces) shift(f, to - from);
    return true;
  }
  const auto triangle = [&](std::size_t i) { return reversed ? triangles - 1 - i : i; };
  fan_.closed = false;
  fan_.centre = from;
  fan_.target = to;
  fan_.rim.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    fan_.rim[i].position = points_[ring.neighbours[reversed ? n - 1 - i : i]];
  for (std::size_t i = 0; i < triangles; ++i) fan_.rim[i].box = faces_[ring.faces[triangle(i)]].box;
  fan_.rim[0].position = foot;
  Point normal{};
  for (std::size_t i = 1; i + 1 < n; ++i)
    normal = normal + cross(fan_.rim[i].position - to, fan_.rim[i + 1].position - to);
  if (!run_fan(normal)) return false;
  for (std::size_t i = 1; i < triangles; ++i) faces_[ring.faces[triangle(i)]].box = fan_.after[i];
  shift(ring.faces[triangle(0)], to - foot);
  return true;
}

bool Replay::move(const Ring& ring, const Point& to) {
  if (to == points_[ring.vertex]) return true;
  if (ring.kind == Ring::Kind::irregular) return false;
  return ring.is_closed() ? move_inside(ring, to) : move_on_border(ring, to);
}

PatchMap::Patch Replay::patch_of(Index f) const {
  const Face& face = faces_[f];
  return {{points_[face.vertex[0]], points_[face.vertex[1]], points_[face.vertex[2]]}, face.box, f};
}

// Remembers triangles as they are before the collapse, but those at `except`.
void Replay::save(const Ring& ring, Index except) {
  for (const Index f : ring.faces)
    if (std::ranges::find(faces_[f].vertex, except) == std::end(faces_[f].vertex))
      patches_.before.push_back(patch_of(f));
}

// The triangles of the ring's vertex go to another one; those with both die.
void Replay::merge(const Ring& ring, Index kept) {
  bereft_.clear();
  for (const Index f : ring.faces) {
    Face& face = faces_[f];
    if (std::ranges::find(face.vertex, kept) == std::end(face.vertex)) {
      std::ranges::replace(face.vertex, ring.vertex, kept);
      continue;
    }
    for (const Index v : face.vertex)
      if (v != kept && v != ring.vertex) bereft_.emplace_back(v, f);
    face.vertex[0] = kNone;
  }
  const Index from = std::exchange(corner_at_[ring.vertex], kNone);
  if (from == kNone) return;
  Index& any = corner_at_[kept];
  if (any == kNone)
    any = from;
  else
    std::swap(faces_[any / 3].next[any % 3], faces_[from / 3].next[from % 3]);
}

// With no triangles left, all there was is at one point.
void Replay::shrink_to(Index vertex) {
  for (const PatchMap::Patch& patch : patches_.before) {
    double farthest = 0;
    for (const Point& c : patch.corner) farthest = std::max(farthest, length(points_[vertex] - c));
    shrunk_[vertex] = std::max(shrunk_[vertex], rounded_up(farthest + patch.box.longest()));
  }
}

// Relates the triangles around the kept vertex to those that were there before. The largest error
// of them.
double Replay::map_patches(Index kept, bool has_moved) {
  gather(kept, kept_ring_);
  changed_.clear();
  for (const PatchMap::Patch& patch : patches_.before) changed_.push_back(patch.face);
  std::ranges::sort(changed_);
  patches_.after.clear();
  for (const Index f : kept_ring_.faces) {
    PatchMap::Patch patch = patch_of(f);
    patch.is_changed = has_moved || std::ranges::binary_search(changed_, f);
    if (!patch.is_changed) patches_.before.push_back(patch);
    patches_.after.push_back(patch);
  }
  if (patches_.after.empty()) {
    shrink_to(kept);
    return 0;
  }
  patches_.run(kNearEnough * error_, work_left_);
  double longest = 0;
  for (const PatchMap::Patch& patch : patches_.after)
    longest = std::max(longest, patch.box.longest());
  return longest;
}

// A vertex that has lost its last triangle stays as a point, as near as the triangle was.
double Replay::leave_points() {
  double farthest = 0;
  for (const auto& [vertex, face] : bereft_) {
    gather(vertex, removed_ring_);
    if (!removed_ring_.faces.empty()) continue;
    shrunk_[vertex] = std::max(shrunk_[vertex], rounded_up(faces_[face].box.longest()));
    farthest = std::max(farthest, double{shrunk_[vertex]});
  }
  return farthest;
}

// Takes the boxes that fans have left, or better ones where these would raise the error.
void Replay::settle(Index kept, bool is_mapped, bool has_moved) {
  double longest = 0;
  for (const PatchMap::Patch& patch : patches_.before)
    if (!is_dead(patch.face)) longest = std::max(longest, faces_[patch.face].box.longest());
  if (!patches_.before.empty() && (!is_mapped || longest > error_)) {
    const double by_patches = map_patches(kept, has_moved);
    if (!is_mapped || by_patches < longest) {
      longest = by_patches;
      for (const PatchMap::Patch& patch : patches_.after) faces_[patch.face].box = patch.box;
    }
  }
  if (!is_mapped) longest = std::max(longest, leave_points());
  error_ = std::max({error_, longest, double{shrunk_[kept]}});
}

// Whichever of the two moves and takes in the other; or the one takes in the other, then moves.
// Each is tried both ways: a fan has to see the place, and one on a border stays on it.
bool Replay::map_between(Ring& kept, Ring& removed, const Point& place) {
  if (!removed.is_closed() && kept.is_closed()) std::swap(kept, removed);
  for (int i = 0; i < 2; ++i) {
    if (move_then_map(kept, removed, place)) return true;
    std::swap(kept, removed);
  }
  for (int i = 0; i < 2; ++i) {
    if (map_onto(removed, kept.vertex)) {
      merge(removed, kept.vertex);
      gather(kept.vertex, kept);
      return move(kept, place);
    }
    std::swap(kept, removed);
  }
  merge(removed, kept.vertex);
  return false;
}

bool Replay::move_then_map(Ring& kept, Ring& removed, const Point& place) {
  const Point stood = points_[kept.vertex];
  if (!move(kept, place)) return false;
  points_[kept.vertex] = place;
  if (map_onto(removed, kept.vertex)) {
    merge(removed, kept.vertex);
    return true;
  }
  points_[kept.vertex] = stood;
  for (const PatchMap::Patch& patch : patches_.before) faces_[patch.face].box = patch.box;
  return false;
}

// Collapses jump all over the mesh, and each triangle around a vertex names the next: with a step
// for each of the coming collapses they are in the cache when their turn comes.
void Replay::fetch_ahead(std::size_t i) {
  for (Index& corner : ahead_) {
    if (corner == kNone) continue;
    const Face& face = faces_[corner / 3];
    if (!is_dead(corner / 3)) __builtin_prefetch(&points_[face.vertex[(corner + 1) % 3]]);
    corner = face.next[corner % 3];
    __builtin_prefetch(&faces_[corner / 3]);
  }
  if (i + 2 * kAhead < collapses_.size())
    __builtin_prefetch(&corner_at_[collapses_[i + 2 * kAhead].removed]);
  if (i + kAhead < collapses_.size())
    ahead_[i % kAhead] = corner_at_[collapses_[i + kAhead].removed];
}

void Replay::collapse(std::size_t i) {
  fetch_ahead(i);
  const Collapse& collapse = collapses_[i];
  const bool is_free = !placements_.empty();
  Index kept = is_free ? alias_[collapse.kept] : collapse.kept;
  const Index removed = is_free ? alias_[collapse.removed] : collapse.removed;
  const Point stood = points_[kept], from = points_[removed];
  const Point place = is_free ? placement(i) : stood;
  if (!is_finite(place) || !is_finite(stood) || !is_finite(from))
    error_ = std::numeric_limits<double>::infinity();
  if (std::isinf(error_)) return;

  work_left_ += kWorkEach;
  float shrunk = kNothing;
  if (shrunk_[kept] >= 0) shrunk = rounded_up(shrunk_[kept] + length(place - stood));
  if (shrunk_[removed] >= 0)
    shrunk = std::max(shrunk, rounded_up(shrunk_[removed] + length(place - from)));
  patches_.before.clear();
  gather(removed, removed_ring_);
  bool is_mapped;
  if (place == stood) {
    is_mapped = map_onto(removed_ring_, kept);
    if (!is_mapped) save(removed_ring_, kNone);
    merge(removed_ring_, kept);
  } else {
    save(removed_ring_, kNone);
    gather(kept, kept_ring_);
    save(kept_ring_, removed);
    is_mapped = map_between(kept_ring_, removed_ring_, place);
    kept = kept_ring_.vertex;
    points_[kept] = place;
    alias_[collapse.kept] = kept;
  }
  shrunk_[kept] = std::max(shrunk_[kept], shrunk);
  settle(kept, is_mapped, place != stood);
}

}  // namespace

std::vector<ErrorBounds> error_bounds(CollapsedSurface surface, double most) {
  std::vector<ErrorBounds> out{{}};
  const std::size_t collapses = surface.collapses.size();
  out.reserve(collapses + 1);
  Replay replay(std::move(surface));
  for (std::size_t i = 0; i < collapses && out.back().two_sided <= most; ++i) {
    replay.collapse(i);
    out.push_back({replay.bound(), replay.bound()});
  }
  return out;
}

}  // namespace pstrips::inline codecs
