#include "codecs/measure/measure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "codecs/measure/bvh.h"

namespace pstrips::inline codecs {
namespace {

struct Moments {
  double maximum = 0, sum = 0, count = 0;  // of squared distances
};

// Two numbers in [0, 1) for each n, evenly spread: multiples of the powers of the plastic number's
// inverse. [Roberts18 R2 sequence]
double spread(std::uint64_t n, double step) {
  const double x = 0.5 + step * static_cast<double>(n);
  return x - std::floor(x);
}
constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;

class Sampler {
 public:
  Sampler(const Surface& surface, const Bvh& target) : surface_(surface), target_(target) {}

  Moments run(std::uint64_t samples) {
    if (surface_.triangles.empty()) {
      for (std::size_t v = 0; 3 * v < surface_.positions.size(); ++v)
        take(at(static_cast<Index>(v)), 1);
      return moments_;
    }
    double total = 0;
    for (std::size_t i = 0; i < surface_.triangles.size(); i += 3) total += area(i);
    double seen = 0;
    std::uint64_t taken = 0;
    for (std::size_t i = 0; i < surface_.triangles.size(); i += 3) {
      // Corners have no area: they count for the maximum, and for the mean where nothing else does.
      for (std::size_t k = i; k < i + 3; ++k) take(at(surface_.triangles[k]), total > 0 ? 0 : 1);
      if (!(total > 0)) continue;
      seen += area(i);
      const auto until = static_cast<std::uint64_t>(seen / total * static_cast<double>(samples));
      for (; taken < until; ++taken) take(inside(i, taken), 1);
    }
    return moments_;
  }

 private:
  Point at(Index v) const {
    const auto p = surface_.positions.subspan(std::size_t{3} * v, 3);
    return {p[0], p[1], p[2]};
  }

  double area(std::size_t i) const {
    const Point a = at(surface_.triangles[i]), b = at(surface_.triangles[i + 1]),
                c = at(surface_.triangles[i + 2]);
    const Point normal = cross(b - a, c - a);
    const double area = std::hypot(normal[0], normal[1], normal[2]) / 2;
    return std::isfinite(area) ? area : 0;
  }

  Point inside(std::size_t i, std::uint64_t n) const {
    double s = spread(n, kStepU), t = spread(n, kStepV);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    const Point a = at(surface_.triangles[i]), b = at(surface_.triangles[i + 1]),
                c = at(surface_.triangles[i + 2]);
    return a + (b - a) * s + (c - a) * t;
  }

  void take(const Point& p, double weight) {
    if (!is_finite(p)) return;
    const double d = target_.squared_distance(p, hint_);
    moments_.maximum = std::max(moments_.maximum, d);
    moments_.sum += d * weight;
    moments_.count += weight;
  }

  const Surface& surface_;
  const Bvh& target_;
  Moments moments_;
  Index hint_ = 0;
};

OneSidedDistance one_sided(const Surface& from, const Bvh& to, std::uint64_t samples) {
  const Moments m = Sampler(from, to).run(samples);
  return {std::sqrt(m.maximum), m.count > 0 ? std::sqrt(m.sum / m.count) : 0};
}

}  // namespace

Distance measure_distance(const Surface& a, const Surface& b, std::uint64_t samples) {
  const Bvh tree_a(a), tree_b(b);
  Distance distance;
  if (tree_a.empty() && tree_b.empty()) return distance;
  if (tree_a.empty() || tree_b.empty()) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    return {{kFar, kFar}, {kFar, kFar}, kFar, kFar};
  }
  distance.a_to_b = one_sided(a, tree_b, samples);
  distance.b_to_a = one_sided(b, tree_a, samples);
  distance.hausdorff = std::max(distance.a_to_b.maximum, distance.b_to_a.maximum);
  distance.rms = std::hypot(distance.a_to_b.rms, distance.b_to_a.rms) / std::sqrt(2.0);
  return distance;
}

double bounding_box_diagonal(std::span<const double> positions) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double low[3] = {kFar, kFar, kFar}, high[3] = {-kFar, -kFar, -kFar};
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    if (!std::isfinite(positions[i]) || !std::isfinite(positions[i + 1]) ||
        !std::isfinite(positions[i + 2]))
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], positions[i + k]);
      high[k] = std::max(high[k], positions[i + k]);
    }
  }
  return low[0] <= high[0] ? std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) : 0;
}

}  // namespace pstrips::inline codecs
