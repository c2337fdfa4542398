#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// Read from the plain accessors of a primitive, where those have bytes; without them the reader
// refuses it.
constinit const Extension kDracoCompression = {
    .name = "KHR_draco_mesh_compression",
    .fate = Fate::held,
    .read_primitive = [](const json&, Primitive& primitive) { primitive.compressed = true; },
};

}  // namespace pstrips::inline formats::gltf
