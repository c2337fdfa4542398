#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/notes.h"
#include "formats/gltf/fit.h"
#include "formats/gltf/json.h"

namespace pstrips::inline formats::gltf {

/// The new number of each set TEXCOORD_n that a mesh has.
using TextureSets = std::map<Index, Index>;

/// Numbers the sets of TEXCOORD_n, COLOR_n, JOINTS_n and WEIGHTS_n from 0 without gaps, as glTF
/// demands. [glTF 2.0 §3.7.2.1]
TextureSets close_gaps(std::vector<Fitted>& attributes, Notes& notes);

/// Whether a material asks for no set of texture coordinates that is missing or has another number.
bool fits_sets(const json& material, const TextureSets& sets);

/// The material with its textures on the new sets, and without textures on sets that are missing;
/// `without` counts those.
json on_sets(json material, const TextureSets& sets, std::uint64_t& without);

}  // namespace pstrips::inline formats::gltf
