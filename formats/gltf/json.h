#pragma once

// The one header of ours that includes a library's: what walks a glTF asset cannot do without.
#include <nlohmann/json.hpp>

namespace pstrips::inline formats::gltf {

using nlohmann::json;

}  // namespace pstrips::inline formats::gltf
