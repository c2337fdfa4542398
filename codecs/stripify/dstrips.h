#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

// The stripping methods of DStrips, applied to a whole mesh: a strip grows in one direction from
// the first free triangle of a work list, by its neighbours alone, until it is stuck;
// each free neighbour it passes by goes to the end of the list. When the list is empty, the next
// connected part starts at its lowest triangle. Each O(n). [Shafae03 §5]
//
// The paper leaves open which neighbour the first triangle steps to (ours: the one over its first
// free edge), and what the first turn is (ours: the one an index map starts with at no cost).

/// Alternates left and right where it can, swaps where it must. [Shafae03 §5.1]
Strips dstrips_greedy(const StripInput& input, const StripOptions& options);

/// Alternates strictly: a strip ends where it would have to swap. [Shafae03 §5.1]
Strips dstrips_greedy_no_swap(const StripInput& input, const StripOptions& options);

/// Steps to the neighbour with the fewest free neighbours, to the one without swap among equals.
/// The work list has a queue for each number of free neighbours a triangle had when it was put
/// in, and gives from the lowest one. Where a strip could go on into either of two dead ends, it
/// ends one triangle earlier, and the two are joined over that triangle. [Shafae03 §5.2]
Strips dstrips_adjacency(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
