#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

// Strips from a spanning tree of the dual graph, found depth first from a triangle with the fewest
// neighbours: dynamic programming cuts the tree into the fewest strips, among those into the ones
// with the fewest swaps; then strips whose ends are neighbours are concatenated, where that takes
// the fewest swaps first. What differs is where the search goes on from a triangle. All O(n).
//
// We know [Xiang99] by [Vanecek05 §2.2, §8.1], which has no details; those above and below are
// ours. Strips, with the published ones of table 8.3 in brackets: ftsg-sgi cow 94 (105), bunny 602
// (618); ftsg-alt cow 323 (312), bunny 3,180 (3,238). Tori as in table 8.9.

/// To the neighbour over the first edge.
Strips ftsg(const StripInput& input, const StripOptions& options);

/// To the neighbour with the fewest neighbours that are not in the tree; among equals, by the same
/// count of its own best neighbour; then to the one that takes no swap.
Strips ftsg_sgi(const StripInput& input, const StripOptions& options);

/// To the left and to the right by turns; where that is over, to the neighbour with the fewest
/// neighbours that are not in the tree.
Strips ftsg_alt(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
