#pragma once

#include <array>
#include <vector>

#include "core/matrix4.h"
#include "core/scene.h"
#include "formats/gltf/json_cursor.h"

namespace pstrips::inline formats::gltf {

/// The nodes of an asset, parents before children, each subtree in one piece, roots and children in
/// file order. glTF requires a tree; files with several parents a node exist, and such a node then
/// stands there once a parent.
///
/// meshes   how many there are to refer to
/// sources  receives the number in the file of each node
std::vector<Node> read_nodes(const Cursor& root, std::size_t meshes, const Limits& limits,
                             std::vector<Index>* sources = nullptr);

/// Scales, then turns by the unit quaternion x, y, z, w, then moves.
Matrix4 matrix_of(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                  const std::array<double, 3>& scale);

}  // namespace pstrips::inline formats::gltf
