#pragma once

#include <cstdint>
#include <vector>

#include "codecs/stripify/dual_graph.h"

namespace pstrips::inline codecs {

/// A stripification as one byte a half-edge: 1 where the strip steps over it. Both half-edges of
/// an edge agree, no triangle has more than two, and there is no cycle: each connected run of
/// links is one strip, so there are (triangles - links) strips.
using Links = std::vector<std::uint8_t>;

inline void set_link(const DualGraph& graph, Links& links, Index h, bool on) {
  links[h] = links[graph.opposite[h]] = on;
}

/// All triangles in the order in which strips name their groups: ascending group, then index.
std::vector<Index> triangles_by_group(const StripInput& input);

/// Writes the strips out: in ascending order of group, then of the lower one of their two end
/// triangles; from the end that costs fewer entries, from the lower one when both cost the same. A
/// turn that does not alternate repeats one entry.
///
/// cost  O(n), O(n log n) when the groups are not in ascending order
Strips emit_strips(const StripInput& input, const DualGraph& graph, const Links& links);

}  // namespace pstrips::inline codecs
