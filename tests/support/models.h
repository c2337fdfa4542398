#pragma once

#include <optional>
#include <string>

#include "core/mesh.h"

namespace pstrips::test {

/// The first mesh of a .ply or .obj file in the folder of real models; nothing when the folder or
/// the file is not there or cannot be read. Materials are not looked up.
std::optional<Mesh> real_mesh(const std::string& path_in_models);

}  // namespace pstrips::test
