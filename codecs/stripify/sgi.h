#pragma once

#include "codecs/stripify/emit.h"

namespace pstrip {

// Greedy strips after SGI's tomesh: start at a triangle with the fewest free neighbours, step on
// until no free neighbour is left, then extend from the start the other way. The thesis names its
// variants without a full description (-LNLN and -LS); where it is silent the choice is ours and
// stated here. [Akeley90; Vanecek05 §2.2, §8.1]

/// SGS, few strips: steps to the neighbour with the fewest free neighbours, among equals to the
/// one whose own best neighbour has the fewest, then to the one that needs no swap. O(n).
Strips sgi_strips(const StripInput& input, const StripOptions& options);
Links sgi_strips_links(const DualGraph& graph);

/// SGV, few vertices: steps that need no swap, among them to the neighbour with the fewest free
/// neighbours. A swap is accepted in two places only: where the two directions meet at the start,
/// and onto a triangle with at most one free neighbour, which would be left over otherwise. O(n).
Strips sgi_vertices(const StripInput& input, const StripOptions& options);

}  // namespace pstrip
