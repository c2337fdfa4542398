#pragma once

#include "core/progressive_strips.h"

namespace pstrips::test {

/// The same levels with a map of triangles that grows. The mesh has neither faces nor an order, and
/// once a window of its map is a triangle it stays one. O(map + rewritten entries).
ProgressiveMesh growing(const ProgressiveMesh& mesh);

}  // namespace pstrips::test
