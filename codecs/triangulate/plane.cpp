#include "codecs/triangulate/plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pstrips::inline codecs {
namespace {

// How far points of a flat loop may be off its plane, as a share of its extent: more than floats
// are rounded.
constexpr double kFlat = 1e-5;

struct Box {
  Point low, size;
  double extent;  // the largest of `size`
};

Box box_of(std::span<const Point> loop) {
  Box out{loop[0], loop[0], 0};
  for (const Point& p : loop)
    for (std::size_t k = 0; k < 3; ++k) {
      out.low[k] = std::min(out.low[k], p[k]);
      out.size[k] = std::max(out.size[k], p[k]);
    }
  out.size = out.size - out.low;
  out.extent = std::ranges::max(out.size);
  return out;
}

// Twice the vector area of the loop in units of its extent, which may be as small or as large as
// doubles are.
Point newell(std::span<const Point> loop, const Box& box) {
  const double half = box.extent / 2;
  const auto scaled = [&](const Point& p) {
    return Point{(p[0] / 2 - box.low[0] / 2) / half, (p[1] / 2 - box.low[1] / 2) / half,
                 (p[2] / 2 - box.low[2] / 2) / half};
  };
  Point n{0, 0, 0};
  const Point origin = scaled(loop[0]);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    n = n + cross(scaled(loop[i]) - origin, scaled(loop[i + 1]) - origin);
  return n;
}

// Without the axis that is nearest to the normal.
std::vector<Point2> without_axis(std::span<const Point> loop, const Point& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<Point2> out;
  out.reserve(loop.size());
  for (const Point& p : loop) out.push_back({p[x], p[y]});
  return out;
}

std::vector<Point2> along_normal(std::span<const Point> loop, const Box& box, const Point& unit) {
  const Point across = std::abs(unit[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point side = cross(across, unit);
  const Point x = side * (1 / length(side)), y = cross(unit, x);
  std::vector<Point2> out;
  out.reserve(loop.size());
  for (const Point& p : loop) {
    const Point at = (p - box.low) * (1 / box.extent);
    out.push_back({dot(x, at), dot(y, at)});
  }
  return out;
}

}  // namespace

std::vector<Point2> on_best_plane(std::span<const Point> loop) {
  if (loop.empty() || !std::ranges::all_of(loop, [](const Point& p) { return is_finite(p); }))
    return {};
  const Box box = box_of(loop);
  if (box.extent == 0) return std::vector<Point2>(loop.size(), Point2{0, 0});
  const Point normal = newell(loop, box);
  const double size = length(normal);
  if (!(size > 0)) {  // no area: without the shortest side of the box
    const auto shortest =
        static_cast<std::size_t>(std::ranges::min_element(box.size) - box.size.begin());
    Point axis{0, 0, 0};
    axis[shortest] = 1;
    return without_axis(loop, axis);
  }
  const Point unit = normal * (1 / size);
  double low = 0, high = 0;
  for (const Point& p : loop) {
    const double height = dot(unit, (p - loop[0]) * (1 / box.extent));
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low <= kFlat || !std::isfinite(high - low) ? without_axis(loop, unit)
                                                           : along_normal(loop, box, unit);
}

}  // namespace pstrips::inline codecs
