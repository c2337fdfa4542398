#include "codecs/measure/patch_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pstrips::inline codecs {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// Parts this much farther off than some point has to be are not worth cutting.
constexpr double kSlack = 1.2;
constexpr int kMaxCuts = 100;  // of one triangle; it takes a dozen where surfaces are smooth

Point along(const Point& a, const Point& d, double t) {
  return {a[0] + d[0] * t, a[1] + d[1] * t, a[2] + d[2] * t};
}
Point middle(const Point& a, const Point& b) { return along(a, b - a, 0.5); }

Point nearest_on_edge(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double t = dot(p - a, d) / dot(d, d);
  return t > 0 ? t < 1 ? along(a, d, t) : b : a;
}

Point nearest_in(const std::array<Point, 3>& triangle, const Point& p) {
  const Point u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], w = p - triangle[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double whole = uu * vv - uv * uv, s = vv * wu - uv * wv, t = uu * wv - uv * wu;
  if (whole > 0 && s >= 0 && t >= 0 && s + t <= whole)
    return along(along(triangle[0], u, s / whole), v, t / whole);
  Point best{};
  double least = kFar;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point q = nearest_on_edge(p, triangle[k], triangle[(k + 1) % 3]);
    const double d = dot(p - q, p - q);
    if (d < least) least = d, best = q;
  }
  return best;
}

// How far coordinates may be off after a few roundings.
double rounding(const std::array<Point, 3>& corners) {
  double size = 0;
  for (const Point& c : corners)
    for (const double x : c) size = std::max(size, std::abs(x));
  return size * 0x1p-46;
}

}  // namespace

PatchMap::Image PatchMap::nearest_image(const Triangle& part, std::vector<Patch>& others) {
  Image best;
  best.distance = kFar;
  std::array<double, 3> least{kFar, kFar, kFar};
  for (Patch& other : others) {
    Triangle image;
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      image[k] = nearest_in(other.corner, part[k]);
      const double d = dot(image[k] - part[k], image[k] - part[k]);
      least[k] = std::min(least[k], d);
      farthest = std::max(farthest, d);
    }
    if (farthest < best.distance || !best.patch) best = {&other, image, farthest, 0};
  }
  best.least_distance = *std::ranges::max_element(least);
  return best;
}

void PatchMap::relate(Patch& patch, const Triangle& part, const Image& image, Direction direction) {
  const bool forward = direction == Direction::forward;
  const Triangle &from = forward ? part : image.corner, &to = forward ? image.corner : part;
  const double slack = rounding(part) + rounding(image.corner);
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], to[i][k] - from[i][k] - slack);
      high[k] = std::max(high[k], to[i][k] - from[i][k] + slack);
    }
  Patch &source = forward ? patch : *image.patch, &target = forward ? *image.patch : patch;
  const DisplacementBox known = source.box;
  target.box.add(known, low, high);
}

// Where an edge of the triangle nearest to its middle passes, else into four.
void PatchMap::cut(const Triangle& part, const std::vector<Patch>& others) {
  const Point centre = along(middle(part[0], part[1]), part[2] - middle(part[0], part[1]), 1 / 3.0);
  const Patch* host = &others.front();
  double least = kFar;
  for (const Patch& other : others) {
    const Point offset = nearest_in(other.corner, centre) - centre;
    if (dot(offset, offset) < least) least = dot(offset, offset), host = &other;
  }
  const Triangle& h = host->corner;
  const Point normal = cross(h[1] - h[0], h[2] - h[0]);
  for (std::size_t e = 0; e < 3; ++e) {
    const Point outward = cross(h[(e + 1) % 3] - h[e], normal);
    std::array<double, 3> side;
    for (std::size_t k = 0; k < 3; ++k) side[k] = dot(part[k] - h[e], outward);
    const double most = std::max({std::abs(side[0]), std::abs(side[1]), std::abs(side[2])});
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      const double least_side = std::min(std::abs(side[l]), std::abs(side[m]));
      if (!(side[l] * side[m] < 0) || least_side < 1e-6 * most) continue;
      const Point x = along(part[l], part[m] - part[l], side[l] / (side[l] - side[m]));
      parts_.push_back({part[k], part[l], x});
      parts_.push_back({part[k], x, part[m]});
      return;
    }
  }
  const Point a = middle(part[1], part[2]), b = middle(part[2], part[0]),
              c = middle(part[0], part[1]);
  for (const Triangle& quarter : {Triangle{part[0], c, b}, Triangle{part[1], a, c},
                                  Triangle{part[2], b, a}, Triangle{a, b, c}})
    parts_.push_back(quarter);
}

void PatchMap::map_parts(Patch& patch, Direction direction, std::uint64_t& work) {
  std::vector<Patch>& others = direction == Direction::forward ? after : before;
  parts_.assign(1, patch.corner);
  for (int cuts = 0; !parts_.empty();) {
    const Triangle part = parts_.back();
    parts_.pop_back();
    const Image image = nearest_image(part, others);
    work -= std::min<std::uint64_t>(work, others.size());
    enough_ = std::max(enough_, kSlack * kSlack * image.least_distance);
    if (image.distance > enough_ && cuts < kMaxCuts && work > 0) {
      ++cuts;
      cut(part, others);
    } else {
      relate(patch, part, image, direction);
    }
  }
}

void PatchMap::map_corners() {
  std::vector<Patch*> by_face;
  for (Patch& patch : after) by_face.push_back(&patch);
  std::ranges::sort(by_face, {}, &Patch::face);
  for (Patch& patch : before) {
    if (!patch.is_changed) continue;
    const auto found = std::ranges::lower_bound(by_face, patch.face, {}, &Patch::face);
    Image image;
    if (found != by_face.end() && (*found)->face == patch.face) {
      image = {*found, (*found)->corner, 0, 0};
    } else {
      image.patch = &after.front();
      for (std::size_t k = 0; k < 3; ++k)
        image.corner[k] = nearest_in(image.patch->corner, patch.corner[k]);
    }
    relate(patch, patch.corner, image, Direction::forward);
  }
}

void PatchMap::run(double near_enough, std::uint64_t& work) {
  constexpr float kEmpty = std::numeric_limits<float>::infinity();
  for (Patch& patch : after)
    if (patch.is_changed) patch.box = {{kEmpty, kEmpty, kEmpty}, {-kEmpty, -kEmpty, -kEmpty}};
  if (std::uint64_t{before.size()} * after.size() > work) return map_corners();
  enough_ = near_enough * near_enough;
  for (Patch& patch : before)
    if (patch.is_changed) map_parts(patch, Direction::forward, work);
  for (Patch& patch : after)
    if (patch.is_changed) map_parts(patch, Direction::backward, work);
}

}  // namespace pstrips::inline codecs
