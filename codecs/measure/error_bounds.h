#pragma once

#include <limits>
#include <span>
#include <vector>

#include "codecs/collapse.h"
#include "core/mesh.h"
#include "core/point.h"

namespace pstrips::inline codecs {

/// How far the surfaces of a level and of full resolution are apart at most, model units, rounded
/// up. [spec/model.md §5]
struct ErrorBounds {
  float two_sided = 0;  ///< from either to the other: bounds their Hausdorff distance
  float one_sided = 0;  ///< from that of full resolution to that of the level
  friend bool operator==(const ErrorBounds&, const ErrorBounds&) = default;
};

/// A mesh by vertices, and how it gets coarser.
struct CollapsedSurface {
  std::vector<Point> positions;  ///< of all vertices
  std::vector<Index> triangles;  ///< 3 n vertices, those of a triangle distinct
  std::span<const Collapse> collapses;
  /// As in CollapseSequence, but rounded as they are going to be stored; empty: no vertex moves.
  std::span<const double> placements;
};

/// Bounds for the levels after 0, 1 … all collapses, not falling.
///
/// Each collapse maps the triangles around its two vertices to those that replace them. For each
/// triangle there is a box of displacements that holds, for every point of it, the way from some
/// point of the full-resolution surface, and for every point of that one the way to some point of
/// the level: the maps reach all of both. Boxes add up from map to map, so that ways there and back
/// cancel out. What a collapse does not touch keeps its box.
///
/// The maps bound both directions alike: the one-sided bound is the two-sided one.
///
/// The collapses need only satisfy that each vertex is removed once and that one with
/// triangles does not go to one that never had any. Where a vertex that is not finite is removed,
/// moved or collapsed onto, and where a coordinate is too large, the largest float is the bound
/// from there on.
///
/// surface  pass it by moving: its lists are freed or worked in
/// most     ends with the first level whose two-sided bound is larger
/// cost     O(n log n); 1 to 3 µs a collapse, 70 bytes a triangle; deterministic
/// source   [Cohen97]: maps in the plane, their edges' crossings, boxes of displacements.
///          Differs: the plane is across the mean normal instead of found by linear programming;
///          a triangle has one box; open fans map along the border; what has no plane is cut up
///          and mapped to what is nearest (PatchMap), and so is what would raise the bound.
std::vector<ErrorBounds> error_bounds(CollapsedSurface surface,
                                      double most = std::numeric_limits<double>::infinity());

}  // namespace pstrips::inline codecs
