#pragma once

#include "codecs/filter/display_strips.h"

namespace pstrips::inline codecs {

/// Builds new display strips over the triangles of some strips, instead of thinning the old ones
/// out. The more neighbouring strips come in one call, the better; ten to fifty times the time
/// of Filter::dtfs. Our own.
///
/// strips        resolved strips of ONE group, parted by restarts
/// wedge_vertex  vertex of each wedge at the level; empty: wedge i is vertex i
/// returns       the same triangles, each with its winding, as strips parted by kRestart; same
///               input, same strips
/// cost          O(entries + highest wedge)
DisplayStrips restrip(std::span<const Index> strips, std::span<const Index> wedge_vertex);

}  // namespace pstrips::inline codecs
