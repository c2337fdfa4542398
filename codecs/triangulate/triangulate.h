#pragma once

#include <vector>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// The triangles that stand for the polygons of a mesh.
struct Triangulation {
  std::vector<Index> corners;  ///< 3 n wedges, wound as their face; three different vertices each
  std::vector<Index> face;     ///< the face each triangle is part of, ascending
};

/// Cuts every polygon of three or more corners into triangles between its own corners.
///
/// Convex polygons are cut in a zigzag, which is one strip without swaps; others by clip_ears() on
/// the plane of Newell's normal (quads: the diagonal that folds least, then the shorter one), so
/// that they are covered once. Of a polygon that is not finite comes a zigzag. Lines, points and
/// triangles with two corners at one vertex give nothing. Same mesh, same triangles.
///
/// cost  O(n log n) for a polygon of n corners
Triangulation triangulate(const Mesh& mesh);

/// The mesh with these triangles in place of their polygons, each with its polygon's attributes.
/// Other faces stay.
Mesh with_triangles(const Mesh& mesh);

}  // namespace pstrips::inline codecs
