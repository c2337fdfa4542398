#pragma once

#include <string>
#include <vector>

#include "core/scene.h"

namespace pstrips::inline converters {

/// All meshes of a model in one, for formats that hold a single mesh. Attributes that not all
/// meshes have in the same format are left out and named in `notes`. Node transforms are not
/// applied.
Model merge_meshes(const Model& model, std::vector<std::string>& notes);

}  // namespace pstrips::inline converters
