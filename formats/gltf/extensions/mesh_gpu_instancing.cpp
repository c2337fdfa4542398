#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// The attributes of a node's instances are accessors by name, as those of a primitive.
constinit const Extension kMeshGpuInstancing = {
    .name = "EXT_mesh_gpu_instancing",
    .may_be_required = true,
    .reference =
        [](std::string_view parent, std::string_view) {
          return parent == "attributes" ? Reference::accessor : Reference::none;
        },
};

}  // namespace pstrips::inline formats::gltf
