#pragma once

#include <array>
#include <span>
#include <vector>

#include "codecs/triangulate/predicates.h"
#include "core/mesh.h"

namespace pstrips::inline codecs {

/// Points in the plane that are taken away one after the other, in a tree of boxes [Bentley75].
class LivePoints {
 public:
  /// `points` must outlive it. Cost O(n log n).
  explicit LivePoints(std::span<const Point2> points);

  /// Precondition: it is there. Cost O(log n).
  void remove(Index point);

  /// Whether `meets(point)` holds for a point in the box around the triangle, which turns
  /// counter-clockwise; some points outside the triangle are left out.
  template <class Meets>
  bool any_near(const std::array<Point2, 3>& triangle, Meets&& meets);

  /// How many boxes and points have been looked at.
  std::uint64_t work() const { return work_; }

 private:
  struct Node {
    Point2 low, high;
    Index live = 0;
  };
  // Nodes are numbered as in a heap; the points of one are those from `begin` to `end`.
  struct Place {
    std::size_t node, begin, end;
    bool is_leaf() const { return end - begin <= kLeaf; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Place left() const { return {2 * node + 1, begin, middle()}; }
    Place right() const { return {2 * node + 2, middle(), end}; }
  };
  static constexpr std::size_t kLeaf = 8;

  void build(const Place& place);
  bool may_meet(const Node& node, const std::array<Point2, 3>& triangle) const;
  Place all() const { return {0, 0, order_.size()}; }

  std::span<const Point2> points_;
  std::vector<Index> order_;     // points, those of a leaf side by side
  std::vector<Index> place_of_;  // of each point in `order_`; kNone: removed
  std::vector<Node> nodes_;
  std::vector<Place> stack_;
  std::uint64_t work_ = 0;
};

template <class Meets>
bool LivePoints::any_near(const std::array<Point2, 3>& triangle, Meets&& meets) {
  stack_.assign(1, all());
  while (!stack_.empty()) {
    const Place place = stack_.back();
    stack_.pop_back();
    ++work_;
    if (!may_meet(nodes_[place.node], triangle)) continue;
    if (!place.is_leaf()) {
      stack_.push_back(place.right());
      stack_.push_back(place.left());
      continue;
    }
    for (std::size_t i = place.begin; i < place.end; ++i) {
      ++work_;
      if (place_of_[order_[i]] != kNone && meets(order_[i])) return true;
    }
  }
  return false;
}

}  // namespace pstrips::inline codecs
