#pragma once

#include <span>
#include <vector>

#include "codecs/triangulate/predicates.h"
#include "core/point.h"

namespace pstrips::inline codecs {

/// A loop as it looks on its best plane, counter-clockwise: the plane of Newell's normal.
///
/// A loop that is flat loses a coordinate, the others are not rounded. Empty when a coordinate is
/// not finite. Cost O(loop).
std::vector<Point2> on_best_plane(std::span<const Point> loop);

}  // namespace pstrips::inline codecs
