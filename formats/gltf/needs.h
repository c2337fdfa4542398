#pragma once

#include "core/notes.h"
#include "formats/gltf/json.h"

namespace pstrips::inline formats::gltf {

/// Takes out of an asset what needs attributes that its meshes do not have: skins of nodes whose
/// mesh has no joints, weights of morph targets that are not there, and the channels of animations
/// that would move them. Changes nothing in an asset that holds together. Cost O(size)
void drop_unmet_needs(json& root, Notes& notes);

}  // namespace pstrips::inline formats::gltf
