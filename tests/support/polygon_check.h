#pragma once

#include <span>
#include <string>

#include "codecs/stripify/stripify.h"

namespace pstrips::test {

/// What is wrong with `strips` as strips of polygons, as a phrase; empty when every face is there
/// exactly once, as the triangles of one of its triangulations between its own corners, with its
/// winding, in ascending order of group, no strip across groups, none without a triangle. Whether
/// the diagonals fit the shape is not asked. Looks at the indices alone. Cost O(n log n) on meshes;
/// faces that share many triples of wedges may take it longer.
std::string find_strip_fault(const PolygonInput& input, std::span<const Index> strips);

}  // namespace pstrips::test
