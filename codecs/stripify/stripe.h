#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

// STRIPE: first patches of quads, row by row, then greedy strips over the faces that are left.
// [Evans96; Vanecek05 §2.2, §7.4, §8.1]
//
// Global: the longest row of free quads, entered and left over opposite edges, is a patch together
// with the whole rows beside it. Each row becomes a strip without swaps, which then grows off its
// ends by the local rule. This is repeated until no row of kLeastRow quads is left.
//
// Local: a strip starts at a face with the fewest free neighbours and steps on to one with the
// fewest, then the same the other way. Ties decide by option.
//
// Without quads, nothing but the local rule is left, as in the original. Polygons are cut as their
// strip needs it; which diagonals are open says make_strip_faces(). The original looks for a row
// anew from every quad; here rows are kept up to date, and which rows make a patch is our reading.
//
// cost  O(n log n), O(n) without quads

/// Option -l (STS): the neighbour whose own best neighbour has the fewest free ones, whether that
/// takes a swap or not. Ours makes 0.4 to 0.6 times the thesis' strips with half the swaps: the
/// thesis suspects a fault in the program it measured.
Strips stripe_lookahead(const StripInput& input, const StripOptions& options);
Strips stripe_lookahead_polygons(const PolygonInput& input, const StripOptions& options);

/// Option -q (STV): the neighbour that takes the fewest swaps.
Strips stripe_noswap(const StripInput& input, const StripOptions& options);
Strips stripe_noswap_polygons(const PolygonInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
