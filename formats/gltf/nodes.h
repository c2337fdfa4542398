#pragma once

#include <vector>

#include "core/scene.h"
#include "formats/gltf/json_cursor.h"

namespace pstrips::inline formats::gltf {

/// The nodes of an asset, parents before children, each subtree in one piece, roots and children in
/// file order. glTF requires a tree; files with several parents a node exist, and such a node then
/// stands there once a parent.
///
/// meshes  how many there are to refer to
std::vector<Node> read_nodes(const Cursor& root, std::size_t meshes, const Limits& limits);

}  // namespace pstrips::inline formats::gltf
