#pragma once

#include <span>
#include <vector>

#include "codecs/measure/measure.h"
#include "core/point.h"

namespace pstrips::inline codecs {

/// A tree of bounding boxes over the parts of a surface, for nearest-point questions.
class Bvh {
 public:
  /// Copies what it needs. Cost O(n log n).
  explicit Bvh(const Surface& surface);

  bool empty() const { return parts_.empty(); }

  /// Squared distance from `point` to the surface. `hint` is the part where the search starts, and
  /// becomes the nearest one: pass the answer for a point nearby. Precondition: not empty().
  double squared_distance(const Point& point, Index& hint) const;

 private:
  struct Part {  // a triangle as a corner and two edges; a point when they are zero
    Point origin, u, v;
    double uu, uv, vv;
  };
  struct Node {
    float low[3], high[3];  // rounded outwards
    Index first;            // of its parts when `count`, else of its two children
    Index count;
  };

  void build(Index node, Index first, Index count, std::vector<Point>& centres,
             std::vector<Index>& order, const std::vector<Part>& parts);
  static double squared_distance(const Part& part, const Point& point);
  static double squared_distance(const Node& node, const Point& point);

  std::vector<Part> parts_;
  std::vector<Node> nodes_;
};

}  // namespace pstrips::inline codecs
