#pragma once

#include <span>
#include <vector>

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// The most points that one triangulation takes; its history needs about 260 bytes a point.
inline constexpr std::size_t kMaxDelaunayPoints = std::size_t{1} << 26;

/// Strips of the Delaunay triangulation of points over the plane; their entries are points.
///
/// positions  x y z of each point, any values, at most kMaxDelaunayPoints points; z rides along
/// returns    every triangle of the triangulation of x and y once, counter-clockwise seen from
///            above, the convex hull covered completely. Among points with equal x and y only the
///            first counts; points with a coordinate that is not finite are left out. No triangles
///            when all points are on a line. Where four or more points are on an empty circle, one
///            of the triangulations
/// cost       O(n log n) expected, whatever the points: they are inserted in an order that is
///            random but for locality [Amenta03], drawn from options.seed and the coordinates, so
///            that no arrangement of points is slow by design
///
/// Points are located by the history of insertions and flips. Strips are kept through both: each
/// triangle knows over which edges its strip steps; the new ones take over the steps over their
/// border, and strips are led anew through the triangles around the point. In the end strips are
/// joined end to end. [Vanecek05 §3.2] decides case by case which way a strip takes at each single
/// insertion and flip, has it as the order of the history's leaves, and joins only there.
Strips delaunay_strips(std::span<const double> positions, const StripOptions& options);

/// The same triangulation without strips, three points a triangle, for whom it is enough.
std::vector<Index> delaunay_triangles(std::span<const double> positions,
                                      const StripOptions& options);

}  // namespace pstrips::inline codecs
