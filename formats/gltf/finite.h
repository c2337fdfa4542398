#pragma once

#include <optional>

#include "core/mesh.h"
#include "core/notes.h"

namespace pstrips::inline formats::gltf {

/// A mesh without the vertices whose positions glTF cannot hold (NaN, infinity, beyond f32) and
/// without the faces that use one; nothing when all can be held. Says how many went. Cost O(size)
std::optional<Mesh> without_endless_vertices(const Mesh& mesh, Notes& notes);

}  // namespace pstrips::inline formats::gltf
