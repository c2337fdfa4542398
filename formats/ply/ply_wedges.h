#pragma once

#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline formats::ply {

/// The wedges that texture coordinates a corner make of vertices.
struct CornerWedges {
  std::vector<Index> wedge_vertex;  ///< ascending
  std::vector<Index> corners;       ///< the wedge of each corner
  Bytes pairs;                      ///< a pair of coordinates a wedge
};

/// Corners of one vertex share a wedge when their pairs are equal bit for bit. Wedges are numbered
/// by vertex, then by first corner; a vertex without a corner has one wedge with zeros.
///
/// corner_vertices  below vertex_count
/// pairs            pair_bytes (8 or 16) for each corner
/// cost             O(corners log(corners at one vertex)); no hashing, so no bad input
CornerWedges wedges_of_corners(std::span<const Index> corner_vertices, Index vertex_count,
                               ByteView pairs, std::size_t pair_bytes);

}  // namespace pstrips::inline formats::ply
