#pragma once

#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrips::inline codecs {

/// The decoded mesh, of which `welded` is what base, records and face table show at full
/// resolution. [spec/model.md §11]
///
/// cost    O(size)
/// errors  corrupt for a welding that does not fit the mesh
Result<Mesh> unweld(const Mesh& welded, const Welding& welding);

}  // namespace pstrips::inline codecs
