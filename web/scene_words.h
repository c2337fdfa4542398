#pragma once

#include "core/bytes.h"
#include "core/progressive_strips.h"

namespace pstrips::inline web {

/// What pstrips_scene() gives. Precondition: all MESH chunks are there.
Bytes scene_words(const ProgressiveStrips& strips, std::uint64_t packets);

}  // namespace pstrips::inline web
