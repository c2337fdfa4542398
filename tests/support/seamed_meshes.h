#pragma once

#include "core/mesh.h"

// Surfaces with texture coordinates that are cut along seams: a vertex on a seam has a wedge for
// each side of it. All have TEXCOORD_0 alone, one group, positions in float.

namespace pstrips::test {

/// A dented sphere over the surface of a cube, 12 side² triangles, closed. Each side of the cube is
/// cut into charts × charts pieces that lie apart in the texture, every other one turned by a right
/// angle. cube_sphere(36, 12) has as many triangles and wedges as scanned props often have.
/// Precondition: side is a multiple of charts.
Mesh cube_sphere(Index side, Index charts);

/// Open at both ends, u × (v + 1) vertices, 2 u v triangles, one seam along it.
Mesh seamed_cylinder(Index u, Index v);

/// The closed torus of u × v vertices with a seam around and one along.
Mesh seamed_torus(Index u, Index v);

}  // namespace pstrips::test
