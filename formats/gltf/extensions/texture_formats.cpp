#include "formats/gltf/extensions/extension.h"
#include "formats/gltf/image_type.h"

namespace pstrips::inline formats::gltf {

// Textures whose image is neither PNG nor JPEG.
constinit const Extension kTextureBasisu = {
    .name = "KHR_texture_basisu",
    .may_be_required = true,
    .holds_texture_source = true,
    .writes_image = [](const Image& image) { return is_image_of(image, {"ktx2"}); },
};
constinit const Extension kTextureWebp = {
    .name = "EXT_texture_webp",
    .may_be_required = true,
    .holds_texture_source = true,
    .writes_image = [](const Image& image) { return is_image_of(image, {"webp"}); },
};
constinit const Extension kTextureAvif = {
    .name = "EXT_texture_avif",
    .may_be_required = true,
    .holds_texture_source = true,
};

}  // namespace pstrips::inline formats::gltf
