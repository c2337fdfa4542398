#pragma once

#include "core/scene.h"
#include "formats/ply/ply_header.h"

namespace pstrips::inline formats::ply {

/// Makes an image and a material of each "comment TextureFile" of a header, and of each a group of
/// the faces that have its `texnumber`. False when there are more than `limit`.
bool read_textures(const Header& header, std::uint64_t limit, Scene& scene, Mesh& mesh);

}  // namespace pstrips::inline formats::ply
