#pragma once

#include <optional>

#include "formats/gltf/json.h"
#include "formats/gltf/primitives.h"

namespace pstrips::inline formats::gltf {

/// The rest of an asset as the reader put it away.
struct KeptAsset {
  json root;
  PrimitiveMap map;
};

/// What a reader put away, when it still speaks of this model: its lists are as long as the
/// model's, and every primitive is where the model has one. The text is not trusted.
std::optional<KeptAsset> find_kept_asset(const Model& model);

/// Data that a reader put away under that key; empty without any.
ByteView find_foreign(const Scene& scene, std::string_view key);

}  // namespace pstrips::inline formats::gltf
