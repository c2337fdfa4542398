#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// Our own. For few indices: straight strips, or SGI's when there is time, then anneal(). For few
/// strips, and for a high price a strip, half of that; then dig_tunnels(), shorter ones first, and
/// for few strips join_strips() by turns with more tunnels. tests/bench says what it reaches.
Strips best_strips(const StripInput& input, const StripOptions& options);

/// The same of the triangles for which qstrip() cuts the faces.
Strips best_polygon_strips(const PolygonInput& input, const StripOptions& options);

/// The same of the triangles of delaunay_triangles().
Strips best_point_strips(std::span<const double> positions, const StripOptions& options);

}  // namespace pstrips::inline codecs
