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

#include "codecs/measure/face_rings.h"
#include "codecs/measure/fan_map.h"
#include "codecs/measure/patch_map.h"
#include "core/point.h"

namespace pstrips::inline codecs {
namespace {

using Plane = std::array<double, 2>;

float rounded_up(double x) { return static_cast<float>(x * (1 + 0x1p-22)); }
double turn(const Plane& a, const Plane& b) { return a[0] * b[1] - a[1] * b[0]; }

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

constexpr float kUnbounded = std::numeric_limits<float>::max();
// What may be spent where maps cost more than a collapse does: crossings of fans and triangles
// looked at by patches, some 20 ns each. Ordinary meshes need a part of it.
constexpr std::uint64_t kWorkAtOnce = 1 << 22;
constexpr std::uint64_t kWorkEach = 64;
constexpr std::size_t kAhead = 8;  // collapses, and so steps around a vertex; rings have 6 or so
// Of the error so far: triangles nearer than this are not worth a better map.
constexpr double kNearEnough = 1.0 / 16;

class SurfaceMaps {
 public:
  explicit SurfaceMaps(CollapsedSurface surface);
  void collapse(std::size_t i);
  /// Of the level that is reached.
  float bound() const;

 private:
  // Instead of a radius: no triangle ever was there, or none has shrunk to the vertex.
  static constexpr float kOutside = -2;
  static constexpr float kNoPoint = -1;

  Point placement(std::size_t i) const {
    return Point{placements_[3 * i], placements_[3 * i + 1], placements_[3 * i + 2]} * scale_;
  }
  DisplacementBox& box(Index face) { return rings_.face(face).box; }
  void fetch_ahead(std::size_t i);

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
  void keep_better_boxes(Index kept, bool is_mapped, bool has_moved);
  double map_patches(Index kept, bool has_moved);
  double leave_points();
  void widen_point(Index vertex);

  std::span<const Collapse> collapses_;
  std::array<Index, kAhead> ahead_;  // a corner at the vertex of each coming collapse, or kNone
  std::span<const double> placements_;
  double scale_ = 1;  // of a model unit: the largest coordinate is about 1
  double error_ = 0;
  std::uint64_t work_left_ = kWorkAtOnce;
  std::vector<Point> points_;
  FaceRings rings_;
  // By vertex: what has shrunk to it, leaving no triangles, was within this distance.
  std::vector<float> point_radius_;
  std::vector<Index> alias_;  // the vertex that stands for each now, with optimal placement
  std::vector<Index> changed_;
  std::vector<FaceRings::Lost> lost_;  // by the last merge
  std::vector<Point> normals_;
  Ring kept_ring_, removed_ring_;
  FanMap fan_;
  PatchMap patches_;
};

SurfaceMaps::SurfaceMaps(CollapsedSurface surface)
    : collapses_(surface.collapses),
      placements_(surface.placements),
      points_(std::move(surface.positions)),
      rings_(surface.triangles.size() / 3, points_.size()) {
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
  point_radius_.assign(vertices, kOutside);
  if (!placements_.empty()) {
    alias_.resize(vertices);
    std::iota(alias_.begin(), alias_.end(), Index{0});
  }
  for (const Index v : surface.triangles) point_radius_[v] = kNoPoint;
  const auto is_whole = [&](Index v) { return is_finite(points_[v]); };
  for (Index f = 0; f < surface.triangles.size() / 3; ++f) {
    const auto corners = std::span(surface.triangles).subspan(std::size_t{3} * f, 3);
    rings_.add(f, corners, std::ranges::all_of(corners, is_whole));
  }
  for (Index v = 0; v < vertices; ++v)
    if (point_radius_[v] == kNoPoint && rings_.corner_at(v) == kNone) point_radius_[v] = 0;
}

float SurfaceMaps::bound() const {
  const double model_units = error_ / scale_;
  return static_cast<float>(
      std::min<double>(model_units + model_units * 0x1p-23 +
                           (error_ > 0 ? std::numeric_limits<float>::denorm_min() : 0),
                       kUnbounded));
}

// Points of the triangle move by up to `step`.
void SurfaceMaps::shift(Index face, const Point& step) {
  Point low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(0.0, step[k]);
    high[k] = std::max(0.0, step[k]);
  }
  const DisplacementBox before = box(face);
  box(face).add(before, low, high);
}

bool SurfaceMaps::run_fan(const Point& normal) {
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
bool SurfaceMaps::map_onto(const Ring& ring, Index kept) {
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
  for (std::size_t i = 0; i < triangles; ++i) fan_.rim[i].box = box(ring.faces[triangle(i)]);
  Point normal{};
  for (std::size_t i = 1; i + 1 < n; ++i)
    normal =
        normal + cross(fan_.rim[i].position - fan_.target, fan_.rim[i + 1].position - fan_.target);
  if (!run_fan(normal) && !(turn_to_face(fan_, normal, normals_) && run_fan(normal))) return false;
  if (patches_.before.empty() && raises_error(n)) save(ring, kNone);
  for (std::size_t i = 1; i + 1 < n; ++i) box(ring.faces[triangle(i)]) = fan_.after[i];
  return true;
}

// Whether the fan's new triangles would.
bool SurfaceMaps::raises_error(std::size_t corners) const {
  for (std::size_t i = 1; i + 1 < corners; ++i)
    if (fan_.after[i].longest() > error_) return true;
  return false;
}

// Moves the ring's vertex: onto the point of the surface below `to`, then up to it.
bool SurfaceMaps::move_inside(const Ring& ring, const Point& to) {
  const std::size_t n = ring.neighbours.size();
  const Point& from = points_[ring.vertex];
  const auto to_neighbour = [&](std::size_t i) { return points_[ring.neighbours[i % n]] - from; };
  Point normal{};
  for (std::size_t i = 0; i < n; ++i) normal = normal + cross(to_neighbour(i), to_neighbour(i + 1));
  PlaneAxes axes;
  if (!axes.around(normal)) return false;
  const Plane place = axes(to - from);
  for (std::size_t m = 0; m < n; ++m) {
    const Plane a = axes(to_neighbour(m)), b = axes(to_neighbour(m + 1));
    const double before = turn(a, place), after = turn(place, b), whole = turn(a, b);
    if (!(before >= 0 && after > 0 && before + after <= whole)) continue;
    const Point foot =
        from + to_neighbour(m) * (after / whole) + to_neighbour(m + 1) * (before / whole);
    fan_.closed = true;
    fan_.centre = from;
    fan_.target = to;
    fan_.rim.resize(n + 1);
    fan_.rim[0].position = foot;
    fan_.rim[0].box = box(ring.faces[m]);
    for (std::size_t i = 1; i <= n; ++i) {
      fan_.rim[i].position = points_[ring.neighbours[(m + i) % n]];
      fan_.rim[i].box = box(ring.faces[(m + i) % n]);
    }
    if (!run_fan(normal)) return false;
    for (std::size_t i = 1; i < n; ++i) box(ring.faces[(m + i) % n]) = fan_.after[i];
    shift(ring.faces[m], to - foot);
    return true;
  }
  return false;
}

// The same along the border: onto the nearest point of it, then off to `to`.
bool SurfaceMaps::move_on_border(const Ring& ring, const Point& to) {
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
  for (std::size_t i = 0; i < triangles; ++i) fan_.rim[i].box = box(ring.faces[triangle(i)]);
  fan_.rim[0].position = foot;
  Point normal{};
  for (std::size_t i = 1; i + 1 < n; ++i)
    normal = normal + cross(fan_.rim[i].position - to, fan_.rim[i + 1].position - to);
  if (!run_fan(normal)) return false;
  for (std::size_t i = 1; i < triangles; ++i) box(ring.faces[triangle(i)]) = fan_.after[i];
  shift(ring.faces[triangle(0)], to - foot);
  return true;
}

bool SurfaceMaps::move(const Ring& ring, const Point& to) {
  if (to == points_[ring.vertex]) return true;
  if (ring.kind == Ring::Kind::irregular) return false;
  return ring.is_closed() ? move_inside(ring, to) : move_on_border(ring, to);
}

PatchMap::Patch SurfaceMaps::patch_of(Index f) const {
  const RingFace& face = rings_.face(f);
  return {{points_[face.vertex[0]], points_[face.vertex[1]], points_[face.vertex[2]]}, face.box, f};
}

// Remembers triangles as they are before the collapse, but those at `except`.
void SurfaceMaps::save(const Ring& ring, Index except) {
  for (const Index f : ring.faces)
    if (!rings_.has_vertex(f, except)) patches_.before.push_back(patch_of(f));
}

// With no triangles left, all there was is at one point.
void SurfaceMaps::widen_point(Index vertex) {
  for (const PatchMap::Patch& patch : patches_.before) {
    double farthest = 0;
    for (const Point& c : patch.corner) farthest = std::max(farthest, length(points_[vertex] - c));
    point_radius_[vertex] =
        std::max(point_radius_[vertex], rounded_up(farthest + patch.box.longest()));
  }
}

// Relates the triangles around the kept vertex to those that were there before. The largest error
// of them.
double SurfaceMaps::map_patches(Index kept, bool has_moved) {
  rings_.gather(kept, kept_ring_);
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
    widen_point(kept);
    return 0;
  }
  patches_.run(kNearEnough * error_, work_left_);
  double longest = 0;
  for (const PatchMap::Patch& patch : patches_.after)
    longest = std::max(longest, patch.box.longest());
  return longest;
}

// A vertex that has lost its last triangle stays as a point, as near as the triangle was.
double SurfaceMaps::leave_points() {
  double farthest = 0;
  for (const auto& [vertex, face] : lost_) {
    rings_.gather(vertex, removed_ring_);
    if (!removed_ring_.faces.empty()) continue;
    point_radius_[vertex] = std::max(point_radius_[vertex], rounded_up(box(face).longest()));
    farthest = std::max(farthest, double{point_radius_[vertex]});
  }
  return farthest;
}

// Takes the boxes that fans have left, or better ones where these would raise the error.
void SurfaceMaps::keep_better_boxes(Index kept, bool is_mapped, bool has_moved) {
  double longest = 0;
  for (const PatchMap::Patch& patch : patches_.before)
    if (!rings_.is_dead(patch.face)) longest = std::max(longest, box(patch.face).longest());
  if (!patches_.before.empty() && (!is_mapped || longest > error_)) {
    const double by_patches = map_patches(kept, has_moved);
    if (!is_mapped || by_patches < longest) {
      longest = by_patches;
      for (const PatchMap::Patch& patch : patches_.after) box(patch.face) = patch.box;
    }
  }
  if (!is_mapped) longest = std::max(longest, leave_points());
  error_ = std::max({error_, longest, double{point_radius_[kept]}});
}

// Whichever of the two moves and takes in the other; or the one takes in the other, then moves.
// Each is tried both ways: a fan has to see the place, and one on a border stays on it.
bool SurfaceMaps::map_between(Ring& kept, Ring& removed, const Point& place) {
  if (!removed.is_closed() && kept.is_closed()) std::swap(kept, removed);
  for (int i = 0; i < 2; ++i) {
    if (move_then_map(kept, removed, place)) return true;
    std::swap(kept, removed);
  }
  for (int i = 0; i < 2; ++i) {
    if (map_onto(removed, kept.vertex)) {
      rings_.merge(removed, kept.vertex, lost_);
      rings_.gather(kept.vertex, kept);
      return move(kept, place);
    }
    std::swap(kept, removed);
  }
  rings_.merge(removed, kept.vertex, lost_);
  return false;
}

bool SurfaceMaps::move_then_map(Ring& kept, Ring& removed, const Point& place) {
  const Point stood = points_[kept.vertex];
  if (!move(kept, place)) return false;
  points_[kept.vertex] = place;
  if (map_onto(removed, kept.vertex)) {
    rings_.merge(removed, kept.vertex, lost_);
    return true;
  }
  points_[kept.vertex] = stood;
  for (const PatchMap::Patch& patch : patches_.before) box(patch.face) = patch.box;
  return false;
}

// Collapses jump all over the mesh, and each triangle around a vertex names the next: with a step
// for each of the coming collapses they are in the cache when their turn comes.
void SurfaceMaps::fetch_ahead(std::size_t i) {
  for (Index& corner : ahead_) {
    if (corner == kNone) continue;
    const RingFace& face = rings_.face(corner / 3);
    if (!rings_.is_dead(corner / 3)) __builtin_prefetch(&points_[face.vertex[(corner + 1) % 3]]);
    corner = face.next[corner % 3];
    rings_.prefetch_face(corner / 3);
  }
  if (i + 2 * kAhead < collapses_.size())
    rings_.prefetch_vertex(collapses_[i + 2 * kAhead].removed);
  if (i + kAhead < collapses_.size())
    ahead_[i % kAhead] = rings_.corner_at(collapses_[i + kAhead].removed);
}

void SurfaceMaps::collapse(std::size_t i) {
  fetch_ahead(i);
  const Collapse& collapse = collapses_[i];
  const bool is_optimal = !placements_.empty();
  Index kept = is_optimal ? alias_[collapse.kept] : collapse.kept;
  const Index removed = is_optimal ? alias_[collapse.removed] : collapse.removed;
  const Point stood = points_[kept], from = points_[removed];
  const Point place = is_optimal ? placement(i) : stood;
  if (!is_finite(place) || !is_finite(stood) || !is_finite(from))
    error_ = std::numeric_limits<double>::infinity();
  if (std::isinf(error_)) return;

  work_left_ += kWorkEach;
  float radius = kNoPoint;
  if (point_radius_[kept] >= 0) radius = rounded_up(point_radius_[kept] + length(place - stood));
  if (point_radius_[removed] >= 0)
    radius = std::max(radius, rounded_up(point_radius_[removed] + length(place - from)));
  patches_.before.clear();
  rings_.gather(removed, removed_ring_);
  bool is_mapped;
  if (place == stood) {
    is_mapped = map_onto(removed_ring_, kept);
    if (!is_mapped) save(removed_ring_, kNone);
    rings_.merge(removed_ring_, kept, lost_);
  } else {
    save(removed_ring_, kNone);
    rings_.gather(kept, kept_ring_);
    save(kept_ring_, removed);
    is_mapped = map_between(kept_ring_, removed_ring_, place);
    kept = kept_ring_.vertex;
    points_[kept] = place;
    alias_[collapse.kept] = kept;
  }
  point_radius_[kept] = std::max(point_radius_[kept], radius);
  keep_better_boxes(kept, is_mapped, place != stood);
}

}  // namespace

std::vector<ErrorBounds> error_bounds(CollapsedSurface surface, double most) {
  std::vector<ErrorBounds> out{{}};
  const std::size_t collapses = surface.collapses.size();
  out.reserve(collapses + 1);
  SurfaceMaps maps(std::move(surface));
  for (std::size_t i = 0; i < collapses && out.back().two_sided <= most; ++i) {
    maps.collapse(i);
    out.push_back({maps.bound(), maps.bound()});
  }
  return out;
}

}  // namespace pstrips::inline codecs
