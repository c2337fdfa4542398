#include "codecs/triangulate/live_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace pstrips::inline codecs {

LivePoints::LivePoints(std::span<const Point2> points)
    : points_(points), order_(points.size()), place_of_(points.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  nodes_.resize(2 * std::bit_ceil(std::max<std::size_t>(points.size(), 1)));
  build(all());
  for (std::size_t i = 0; i < order_.size(); ++i) place_of_[order_[i]] = static_cast<Index>(i);
}

void LivePoints::build(const Place& place) {
  Node& node = nodes_[place.node];
  node.live = static_cast<Index>(place.end - place.begin);
  if (node.live == 0) return;
  node.low = node.high = points_[order_[place.begin]];
  for (std::size_t i = place.begin; i < place.end; ++i) {
    const Point2& p = points_[order_[i]];
    node.low = {std::min(node.low.x, p.x), std::min(node.low.y, p.y)};
    node.high = {std::max(node.high.x, p.x), std::max(node.high.y, p.y)};
  }
  if (place.is_leaf()) return;
  // Halves, since the whole may be infinite.
  const bool by_x = node.high.x / 2 - node.low.x / 2 >= node.high.y / 2 - node.low.y / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(place.begin), at(place.middle()), at(place.end), [&](Index a, Index b) {
    return by_x ? points_[a].x < points_[b].x : points_[a].y < points_[b].y;
  });
  build(place.left());
  build(place.right());
}

void LivePoints::remove(Index point) {
  const Index at = std::exchange(place_of_[point], kNone);
  for (Place place = all();; place = at < place.middle() ? place.left() : place.right()) {
    --nodes_[place.node].live;
    if (place.is_leaf()) return;
  }
}

bool LivePoints::may_meet(const Node& node, const std::array<Point2, 3>& triangle) const {
  if (node.live == 0) return false;
  const auto& [a, b, c] = triangle;
  if (std::max({a.x, b.x, c.x}) < node.low.x || std::min({a.x, b.x, c.x}) > node.high.x ||
      std::max({a.y, b.y, c.y}) < node.low.y || std::min({a.y, b.y, c.y}) > node.high.y)
    return false;
  // Beyond a side when the corner of the box is that is farthest to its left. Only speed depends on
  // the rounding, by a margin.
  for (std::size_t i = 0; i < 3; ++i) {
    const Point2 &from = triangle[i], &to = triangle[(i + 1) % 3];
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double along_x = dx * ((dx > 0 ? node.high.y : node.low.y) - from.y);
    const double along_y = dy * ((dy > 0 ? node.low.x : node.high.x) - from.x);
    constexpr double kMargin = 1e-12;
    if (along_x - along_y < -kMargin * (std::abs(along_x) + std::abs(along_y))) return false;
  }
  return true;
}

}  // namespace pstrips::inline codecs
