#pragma once

#include <span>
#include <string>

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// What is wrong with `strips` as a stripification of `input`, as a phrase; empty when they cover
/// every triangle exactly once with its winding, in ascending order of group, no strip across
/// groups, none without a triangle. Looks at the indices alone: nothing of what made them is used.
///
/// cost  O(n log n)
std::string find_strip_fault(const StripInput& input, std::span<const Index> strips);

/// The same for strips over polygons, whose diagonals are free: that there are as many triangles as
/// the faces have, in ascending order of group, and that in each group their edges are those of the
/// faces, once what runs both ways between two triangles is taken away. Triangles of different
/// faces could still be mixed up where they share edges.
std::string find_polygon_strip_fault(const PolygonInput& input, std::span<const Index> strips);

}  // namespace pstrips::inline codecs
