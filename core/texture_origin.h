#pragma once

#include <string_view>

#include "core/progressive_strips.h"
#include "core/scene.h"

namespace pstrips::inline core {

/// Whether an attribute is TEXCOORD_n.
bool is_texcoord(std::string_view semantic);

/// The same texture coordinates from the other corner: v becomes 1 - v, in double, rounded once to
/// the attribute's type; integers that cannot hold it become f32. Turning twice gives the bits that
/// turning four times gives, not always the first ones.
Attribute turned(const Attribute& texcoord);

/// The same place on an image for coordinates that were turned.
TextureMap turned(const TextureMap& map);

/// The model with texture coordinates and maps from `origin`. cost O(size) when they are not
Model with_texture_origin(Model model, TextureOrigin origin);
ProgressiveStrips with_texture_origin(ProgressiveStrips strips, TextureOrigin origin);

}  // namespace pstrips::inline core
