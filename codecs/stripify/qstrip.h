#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// QStrip: greedy strips of whole quads, whose diagonals are chosen when the strip is complete, so
/// that it has the fewest swaps. [Vanecek05 §7.3]
///
/// A strip starts at a face with the fewest free neighbours and steps on until no free neighbour is
/// left that it can pass; then it grows from its start the other way, which the original does not.
/// Few indices: it goes where that takes the fewest swaps (straight on takes none, a turn one or
/// two), as the chapter's pseudo-code has it. Few strips: where the fewest free neighbours are,
/// with a look-ahead, as SGI; the chapter's own figures (a few strips, a swap in three or four
/// quads) are only reached like this. Ties go to the other criterion.
///
/// Triangles and larger polygons, which the chapter leaves out, take part; which diagonals are open
/// says make_strip_faces(), the rule for two common edges included.
///
/// cost  O(n)
Strips qstrip(const StripInput& input, const StripOptions& options);
Strips qstrip_polygons(const PolygonInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
