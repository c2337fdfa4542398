#pragma once

#include "formats/pstrip/payload/geometry.h"
#include "formats/pstrip/payload/geometry_layout.h"

namespace pstrips::inline formats {

/// Fixed-width, aligned arrays that can be used where they stand. [spec/container.md §7]
const GeometryCodec& plain_codec();
const GeometryLayout& plain_layout();

}  // namespace pstrips::inline formats
