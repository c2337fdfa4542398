#pragma once

#include <cstdint>

#include "core/progressive_strips.h"

namespace pstrips::test {

/// Some mesh that `shown` could have been welded from: corners draw their wedges from several,
/// these their vertices, and some vertices are moved. Same seed, same welding.
Welding random_welding(const Mesh& shown, std::uint32_t seed);

}  // namespace pstrips::test
