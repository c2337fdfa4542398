#pragma once

#include "core/scene.h"

namespace pstrips::inline converters {

/// The model with texture coordinates from the upper left that are equal to those of any model into
/// which it was written from the other corner, or from which: v goes through f32 until turning it
/// changes nothing more. cost O(size)
Model with_meeting_texcoords(Model model);

}  // namespace pstrips::inline converters
