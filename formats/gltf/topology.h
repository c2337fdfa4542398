#pragma once

#include <string>
#include <vector>

#include "core/mesh.h"
#include "formats/gltf/document.h"
#include "formats/gltf/gltf.h"

namespace pstrips::inline formats::gltf {

/// The indices of one glTF primitive, wedges of the mesh.
struct IndexList {
  Mode mode = Mode::triangles;
  std::vector<Index> indices;
};

/// The primitives of each group: none when it has no face that glTF can show.
///
/// dropped  receives what is lost: faces of fewer than three corners among polygons, degenerate
///          triangles in strips, polylines cut into segments
/// cost     O(corners)
std::vector<std::vector<IndexList>> index_lists(const Mesh& mesh, const GltfWriteOptions& options,
                                                std::vector<std::string>& dropped);

}  // namespace pstrips::inline formats::gltf
