#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "core/scene.h"

namespace pstrips::cli {

/// Whether a mesh of the model has each attribute that an option names; "TEXCOORD" stands for
/// TEXCOORD_0, TEXCOORD_1 …
///
/// errors  bad_argument, with the names that there are
Result<void> check_attribute_names(const Model& model, const std::string& option,
                                   const std::vector<std::string>& names);

}  // namespace pstrips::cli
