#pragma once

#include <vector>

#include "core/mesh.h"

namespace pstrips::inline formats::ply {

/// What a row of the vertex element is, and where TEXCOORD_0 goes.
enum class Shape : std::uint8_t {
  vertices,            ///< a row a vertex
  vertices_texcoords,  ///< the same, TEXCOORD_0 in the faces' lists
  wedges,              ///< a row a wedge, with wedge_vertex
};

/// Whether the faces' lists of texture coordinates can hold the attribute.
bool is_texcoord(const Attribute& attribute);

/// The first wedge of each vertex.
std::vector<Index> first_wedges(const Mesh& mesh);

/// The rows by which a reader gets the same wedges back, the fewest where there is a choice.
///
/// has_faces      there is a face element to hold lists
/// had_texcoords  there was a list of texture coordinates, which then is written again
Shape choose_shape(const Mesh& mesh, bool has_faces, bool had_texcoords);

}  // namespace pstrips::inline formats::ply
