#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// Read where a primitive's accessors have no bytes of their own, which are as exact as any.
constinit const Extension kDracoCompression = {
    .name = "KHR_draco_mesh_compression",
    .fate = Fate::held,
    .may_be_required = true,
    .read_primitive =
        [](const Cursor& object, Primitive& primitive) {
          Primitive::Compressed& out = primitive.compressed.emplace();
          out.view = static_cast<Index>(std::min<std::uint64_t>(object.whole("bufferView"), kNone));
          if (!object.has_object("attributes")) return;
          const Cursor attributes = object["attributes"];
          for (auto& [name, id] : attributes.value().items())
            out.attributes.emplace_back(name, static_cast<std::uint32_t>(std::min<std::uint64_t>(
                                                  attributes.whole(name.c_str()), kNone)));
        },
};

}  // namespace pstrips::inline formats::gltf
