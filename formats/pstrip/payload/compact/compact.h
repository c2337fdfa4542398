#pragma once

#include "formats/pstrip/payload/geometry.h"
#include "formats/pstrip/payload/geometry_layout.h"

namespace pstrips::inline formats {

/// Batches of splits, predicted and entropy-coded. [spec/compact.md]
const GeometryCodec& compact_codec();

/// Its writer refuses what is no such batches (bad_argument, with a path): a map that is not one of
/// triangles, packets whose records do not stand in the order of a batch, positions that are in no
/// cell.
const GeometryLayout& compact_layout();

}  // namespace pstrips::inline formats
