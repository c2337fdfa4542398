#pragma once

#include <initializer_list>
#include <string_view>

#include "core/bytes.h"
#include "core/scene.h"

namespace pstrips::inline formats::gltf {

/// The MIME type of an image file by its first bytes, empty for a format that glTF does not know.
std::string_view mime_type_of(ByteView image);

/// Whether the MIME type, or without one the file's ending, is among those named; in lower case.
bool is_image_of(const Image& image, std::initializer_list<std::string_view> endings);

}  // namespace pstrips::inline formats::gltf
