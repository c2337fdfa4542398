#include "codecs/measure/fan_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pstrips::inline codecs {
namespace {

using Plane = std::array<double, 2>;

// Twice the area of a triangle, positive when it is counter-clockwise.
double area(const Plane& a, const Plane& b, const Plane& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Point between(const Point& a, const Point& b, double t) {
  return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}

// Single precision has half a unit in the 24th bit of rounding, or half of the least number.
constexpr double kRounding = 0x1p-23;
constexpr double kLeast = std::numeric_limits<float>::denorm_min();
constexpr double kMax = std::numeric_limits<float>::max();

float above(double x) {
  return static_cast<float>(std::min(x + std::abs(x) * kRounding + kLeast, kMax));
}
float below(double x) { return -above(-x); }

}  // namespace

void DisplacementBox::add(const DisplacementBox& other, const Point& low_step,
                          const Point& high_step) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], below(other.low[k] + low_step[k]));
    high[k] = std::max(high[k], above(other.high[k] + high_step[k]));
  }
}

double DisplacementBox::longest() const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double most = std::max(-double{low[k]}, double{high[k]});
    sum += most * most;
  }
  return std::sqrt(sum) * (1 + 0x1p-50);
}

// The rim seen from corner 0 in one of the two directions around the centre.
struct FanMap::Side {
  std::size_t corners;
  bool reversed;
  std::size_t corner(std::size_t i) const { return reversed ? corners - i : i; }
  std::size_t triangle(std::size_t i) const { return reversed ? corners - 1 - i : i; }
};

// Every triangle of both fans is counter-clockwise or flat, and the centre is surrounded once.
bool FanMap::is_unfolded() const {
  const std::size_t n = rim.size();
  const Plane& first = rim[0].plane;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i)
    if (!(area(centre_plane, rim[i].plane, rim[(i + 1) % n].plane) >= 0)) return false;
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (!(area(first, rim[i].plane, rim[i + 1].plane) >= 0)) return false;
  std::size_t turns = 0;
  bool left = true;  // of the line from the centre through corner 0
  for (std::size_t i = 1; i < n; ++i) {
    const bool now = area(centre_plane, first, rim[i].plane) >= 0;
    turns += now != left;
    left = now;
  }
  return turns <= 1;
}

// The new triangle over which the centre stands.
std::size_t FanMap::find_triangle_of_centre() const {
  std::size_t i = 1;
  while (i + 2 < rim.size() && area(rim[0].plane, rim[i + 1].plane, centre_plane) >= 0) ++i;
  return i;
}

bool FanMap::displacement_at_centre(std::size_t triangle, Point& out) const {
  const Corner &b = rim[triangle], &c = rim[triangle + 1];
  const double weights[3] = {std::max(0.0, area(centre_plane, b.plane, c.plane)),
                             std::max(0.0, area(rim[0].plane, centre_plane, c.plane)),
                             std::max(0.0, area(rim[0].plane, b.plane, centre_plane))};
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = (weights[0] * (target[k] - centre[k]) + weights[1] * (b.position[k] - centre[k]) +
              weights[2] * (c.position[k] - centre[k])) /
             sum;
  return true;
}

// Where the edge from corner 0 to another one crosses an edge at the centre.
bool FanMap::crossing(std::size_t diagonal, std::size_t corner, Point& out) const {
  const Plane &o = rim[0].plane, &to = rim[diagonal].plane, &end = rim[corner].plane;
  const double along[2] = {to[0] - o[0], to[1] - o[1]};
  const double from_centre[2] = {end[0] - centre_plane[0], end[1] - centre_plane[1]};
  const double offset[2] = {centre_plane[0] - o[0], centre_plane[1] - o[1]};
  const double turn = along[0] * from_centre[1] - along[1] * from_centre[0];
  const double t = (along[1] * offset[0] - along[0] * offset[1]) / turn;
  const double u = (offset[0] * from_centre[1] - offset[1] * from_centre[0]) / turn;
  if (!std::isfinite(t) || !std::isfinite(u)) return false;
  const Point before = between(centre, rim[corner].position, std::clamp(t, 0.0, 1.0));
  out = between(target, rim[diagonal].position, std::clamp(u, 0.0, 1.0)) - before;
  return true;
}

void FanMap::cover(std::size_t to, std::size_t from, std::span<const Point> steps) {
  Point low = steps[0], high = steps[0];
  for (const Point& step : steps.subspan(1))
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], step[k]);
      high[k] = std::max(high[k], step[k]);
    }
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] -= slack_;
    high[k] += slack_;
  }
  after[to].add(rim[from].box, low, high);
}

// The edges from corner 0 that leave the centre on one side cross the edges from the centre to the
// corners before their own. `row_` has the displacements where one of them crosses, from corner 0
// to its end, where they are zero.
bool FanMap::cover_side(const Side& side, std::size_t last, const Point& at_centre) {
  const Point at_target = target - rim[0].position;
  row_.assign({at_target, Point{}});
  for (std::size_t i = 1; i < last; ++i) {
    next_row_.assign(1, at_target);
    for (std::size_t j = 1; j <= i; ++j) {
      Point& step = next_row_.emplace_back();
      if (!crossing(side.corner(i + 1), side.corner(j), step)) return false;
    }
    next_row_.emplace_back();
    for (std::size_t j = 0; j <= i; ++j)
      cover(side.triangle(i), side.triangle(j),
            std::array{row_[j], row_[std::min(j + 1, i)], next_row_[j], next_row_[j + 1]});
    std::swap(row_, next_row_);
  }
  for (std::size_t j = 0; j < last; ++j)
    cover(side.triangle(last), side.triangle(j), std::array{row_[j], row_[j + 1], at_centre});
  return true;
}

bool FanMap::run() {
  const std::size_t n = rim.size();
  if (!is_unfolded()) return false;
  double size = 0;
  for (const Corner& corner : rim)
    for (std::size_t k = 0; k < 3; ++k)
      size = std::max({size, std::abs(corner.position[k] - centre[k]),
                       std::abs(corner.position[k] - target[k])});
  slack_ = size * 0x1p-46;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  after.assign(n, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  const std::size_t over = closed ? find_triangle_of_centre() : n - 2;
  Point at_centre;
  if (!displacement_at_centre(over, at_centre)) return false;
  if (!cover_side({n, false}, over, at_centre)) return false;
  if (closed && !cover_side({n, true}, n - 1 - over, at_centre)) return false;
  cover(over, over, std::array{Point{}, at_centre});
  return true;
}

}  // namespace pstrips::inline codecs
