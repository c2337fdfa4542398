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
/// Convex polygons are cut in a zigzag, which is one strip without swaps; others by ear clipping
/// in the plane of Newell's normal (quads: the diagonal that folds least, then the shorter one).
/// Beyond 256 corners always zigzag, so that the cost stays linear. Lines, points and triangles
/// with two corners at one vertex give nothing. Same mesh, same triangles.
Triangulation triangulate(const Mesh& mesh);

}  // namespace pstrips::inline codecs
