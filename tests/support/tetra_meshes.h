#pragma once

#include <cstdint>

#include "core/tetra.h"

namespace pstrips::test {

/// Delaunay tetrahedra of random points with whole coordinates; a little short of the convex hull.
/// Tries every point against every tetrahedron: for a few thousand points.
TetraMesh delaunay_tetrahedra(std::uint32_t seed, Index points);

/// Tetrahedra with random corners over few vertices: doubled, turned over, with a vertex twice,
/// more than two at a face.
TetraMesh random_tetrahedra(std::uint32_t seed, Index vertices, Index tetrahedra);

}  // namespace pstrips::test
