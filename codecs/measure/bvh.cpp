#include "codecs/measure/bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pstrips::inline codecs {
namespace {

constexpr Index kLeafParts = 4;
constexpr std::size_t kMaxDepth = 64;  // halving 2^32 parts takes 32

// To the segment from the origin along `edge`.
double to_segment(const Point& p, const Point& edge, double edge_squared) {
  const double t = edge_squared > 0 ? std::clamp(dot(p, edge) / edge_squared, 0.0, 1.0) : 0;
  const Point d = p - edge * t;
  return dot(d, d);
}

float below(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float above(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

}  // namespace

Bvh::Bvh(const Surface& surface) {
  const auto at = [&](Index v) {
    const auto p = surface.positions.subspan(std::size_t{3} * v, 3);
    return Point{p[0], p[1], p[2]};
  };
  std::vector<Part> parts;
  const auto add = [&](const Point& o, const Point& a, const Point& b) {
    if (!is_finite(o) || !is_finite(a) || !is_finite(b)) return;
    const Point u = a - o, v = b - o;
    parts.push_back({o, u, v, dot(u, u), dot(u, v), dot(v, v)});
  };
  if (surface.triangles.empty()) {
    for (std::size_t v = 0; 3 * v < surface.positions.size(); ++v) {
      const Point p = at(static_cast<Index>(v));
      add(p, p, p);
    }
  } else {
    parts.reserve(surface.triangles.size() / 3);
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3)
      add(at(surface.triangles[i]), at(surface.triangles[i + 1]), at(surface.triangles[i + 2]));
  }
  if (parts.empty()) return;
  const Index count = static_cast<Index>(parts.size());
  std::vector<Point> centres(count);
  for (Index i = 0; i < count; ++i)
    centres[i] = parts[i].origin + (parts[i].u + parts[i].v) * (1 / 3.0);
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  nodes_.reserve(std::size_t{2} * count / kLeafParts * 2 + 1);
  nodes_.resize(1);
  parts_.reserve(count);
  build(0, 0, count, centres, order, parts);
}

void Bvh::build(Index node, Index first, Index count, std::vector<Point>& centres,
                std::vector<Index>& order, const std::vector<Part>& parts) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double low[3] = {kFar, kFar, kFar}, high[3] = {-kFar, -kFar, -kFar};
  double centre_low[3] = {kFar, kFar, kFar}, centre_high[3] = {-kFar, -kFar, -kFar};
  for (Index i = first; i < first + count; ++i) {
    const Part& part = parts[order[i]];
    const Point corners[3] = {part.origin, part.origin + part.u, part.origin + part.v};
    for (std::size_t k = 0; k < 3; ++k) {
      for (const Point& c : corners) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
      const double centre = centres[order[i]][k];
      centre_low[k] = std::min(centre_low[k], centre);
      centre_high[k] = std::max(centre_high[k], centre);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    nodes_[node].low[k] = below(low[k]);
    nodes_[node].high[k] = above(high[k]);
  }
  if (count <= kLeafParts) {
    nodes_[node].first = static_cast<Index>(parts_.size());
    nodes_[node].count = count;
    for (Index i = first; i < first + count; ++i) parts_.push_back(parts[order[i]]);
    return;
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (centre_high[k] - centre_low[k] > centre_high[axis] - centre_low[axis]) axis = k;
  const Index half = count / 2;
  const auto begin = order.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](Index a, Index b) {
    const double x = centres[a][axis], y = centres[b][axis];
    return x != y ? x < y : a < b;
  });
  const Index children = static_cast<Index>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  build(children, first, half, centres, order, parts);
  build(children + 1, first + half, count - half, centres, order, parts);
}

double Bvh::squared_distance(const Part& part, const Point& point) {
  const Point p = point - part.origin;
  const double pu = dot(p, part.u), pv = dot(p, part.v);
  const double determinant = part.uu * part.vv - part.uv * part.uv;
  const double s = part.vv * pu - part.uv * pv, t = part.uu * pv - part.uv * pu;
  if (determinant > 0 && s >= 0 && t >= 0 && s + t <= determinant) {
    const Point d = p - part.u * (s / determinant) - part.v * (t / determinant);
    return dot(d, d);
  }
  const Point third = part.v - part.u;
  return std::min({to_segment(p, part.u, part.uu), to_segment(p, part.v, part.vv),
                   to_segment(p - part.u, third, dot(third, third))});
}

double Bvh::squared_distance(const Node& node, const Point& point) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = point[k];
    const double d = std::max({double{node.low[k]} - x, x - double{node.high[k]}, 0.0});
    sum += d * d;
  }
  return sum;
}

double Bvh::squared_distance(const Point& point, Index& hint) const {
  hint = std::min(hint, static_cast<Index>(parts_.size() - 1));
  double best = squared_distance(parts_[hint], point);
  std::pair<double, Index> stack[kMaxDepth];  // box distance, node
  std::size_t depth = 0;
  stack[depth++] = {squared_distance(nodes_[0], point), 0};
  while (depth > 0) {
    const auto [distance, index] = stack[--depth];
    if (distance >= best) continue;
    const Node& node = nodes_[index];
    for (Index i = node.first; i < node.first + node.count; ++i) {
      const double d = squared_distance(parts_[i], point);
      if (d < best) best = d, hint = i;
    }
    if (node.count > 0) continue;
    std::pair<double, Index> near = {squared_distance(nodes_[node.first], point), node.first};
    std::pair<double, Index> far = {squared_distance(nodes_[node.first + 1], point),
                                    node.first + 1};
    if (far.first < near.first) std::swap(near, far);
    if (far.first < best) stack[depth++] = far;
    if (near.first < best) stack[depth++] = near;
  }
  return best;
}

}  // namespace pstrips::inline codecs
