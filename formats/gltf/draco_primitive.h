#pragma once

#include <string>

#include "formats/gltf/accessors.h"

namespace pstrips::inline formats::gltf {

/// Whether accessors of the primitive have no bytes but those that Draco compression stores.
bool needs_draco(const Document& document, const Primitive& primitive);

/// Decodes a primitive's Draco payload and gives `data` the elements of its accessors, in the types
/// that those have. [KHR_draco_mesh_compression]
///
/// errors  corrupt, also for counts other than the accessors'; as decode_draco()
Result<void> read_draco(Data& data, const Document& document, const Primitive& primitive,
                        const Limits& limits, const std::string& path);

}  // namespace pstrips::inline formats::gltf
