#pragma once

#include "codecs/stripify/emit.h"

namespace pstrips::inline codecs {

// Greedy strips after SGI's tomesh, as [Vanecek02 §3] restates it: start at a triangle with the
// fewest free neighbours and step on, in this direction only, until no free neighbour is left.
// Where the source chooses arbitrarily, ours are the triangle that lost a neighbour last and the
// lowest edge. [Akeley90; Vanecek05 §2.2, §8.1]
//
// Strips beside [Vanecek05 table 8.3]: bunny 647 and 3560, there 648 and 3560; cow 90 and 395,
// there 98 and 352, whose triangles may have come in another order. On a torus of 20 x N
// [Vanecek05 table 8.9] 1 and 19, as there, but 9 where there are 19 for N = 50.

/// SGS, few strips: steps to the neighbour with the fewest free neighbours, among equals to the
/// one whose own best neighbour has the fewest. Swaps do not count. O(n).
Strips sgi_strips(const StripInput& input, const StripOptions& options);

/// SGV, few vertices: steps to the neighbour that needs no swap, over one where there is no other.
/// O(n).
Strips sgi_vertices(const StripInput& input, const StripOptions& options);

/// SGS with its last tie broken for the neighbour that needs no swap, as a start for algorithms
/// that go on from there: bunny in 490 strips with 14,411 swaps instead of 647 with 16,741. O(n).
Links sgi_strips_links(const DualGraph& graph);

}  // namespace pstrips::inline codecs
