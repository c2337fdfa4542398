#pragma once

#include <cstdint>

#include "core/mesh.h"
#include "core/scene.h"

namespace pstrips::test {

/// A model of one mesh, without a scene.
Model model_of(Mesh mesh);

/// A mesh of triangles over float positions, one wedge a vertex, one group.
Mesh triangle_mesh(std::vector<float> positions, std::vector<Index> corners);

/// side × side vertices in the plane z = 0.3 sin x cos y, two triangles a cell.
Mesh grid(Index side);

/// A closed torus of u × v vertices.
Mesh torus(Index u, Index v);

/// The eight corners and twelve triangles of a cube; with `uv`, four wedges with TEXCOORD_0 and
/// NORMAL a side (24 in all), so that every cube edge is a seam.
Mesh cube(bool uv);

/// Triangles with random corners over few vertices: non-manifold, doubled and degenerate faces,
/// unused vertices, random wedges with a u16 attribute, up to three groups. Same seed, same mesh.
Mesh random_soup(std::uint32_t seed, Index vertices, Index faces);

/// The same with faces of three to six corners.
Mesh polygon_soup(std::uint32_t seed, Index vertices, Index faces);

/// A mesh of quads over float positions.
Mesh quad_mesh(std::vector<float> positions, std::vector<Index> corners);

/// Pairs of triangles, 2i and 2i + 1, joined to quads over the edge between: grid(), torus(),
/// cube().
Mesh joined_to_quads(const Mesh& triangles);

/// The outside of those cubes of a side³ block whose centre is in a torus, as quads: what a surface
/// reconstructed from orthogonal slices looks like.
Mesh voxel_torus(Index side);

}  // namespace pstrips::test
