#pragma once

#include <cstdint>

#include "core/progressive_strips.h"

namespace pstrips::inline converters {

/// Bytes that a file of the compact profile spends on what lies below its cells, 13 bits of a
/// position and 12 of an attribute: the payloads of FINE. 0 for other profiles.
///
/// strips  of the compact profile: what write_binary() takes
/// cost    O(vertices + wedges)
std::uint64_t bytes_below_cells(const ProgressiveStrips& strips);

}  // namespace pstrips::inline converters
