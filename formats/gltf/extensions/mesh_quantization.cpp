#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// It has no object of its own: it allows attributes types that glTF alone forbids.
constinit const Extension kMeshQuantization = {
    .name = "KHR_mesh_quantization",
    .fate = Fate::held,
    .may_be_required = true,
    .writes_attribute = [](const Fitted& attribute) { return attribute.needs_quantization(); },
};

}  // namespace pstrips::inline formats::gltf
