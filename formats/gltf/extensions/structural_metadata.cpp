#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// Property tables name the views of their columns.
constinit const Extension kStructuralMetadata = {
    .name = "EXT_structural_metadata",
    .may_be_required = true,
    .reference =
        [](std::string_view, std::string_view key) {
          const bool is_column = key == "values" || key == "arrayOffsets" || key == "stringOffsets";
          return is_column ? Reference::view : Reference::none;
        },
};

}  // namespace pstrips::inline formats::gltf
