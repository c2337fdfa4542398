#pragma once

#include "codecs/stripify/linked_paths.h"
#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// Brings strip_price * strips + swaps down by simulated annealing, then by moves that do not
/// raise it. Gives back what it got when it found nothing better.
///
/// The moves: cut a link; join two ends; slide an end, that is link it to a neighbour and cut one
/// of the neighbour's links, which makes a new end. Triangles are swept in order, which keeps to
/// the cache: each link is tried for a cut, each end met takes a short random walk. The temperature
/// falls with the moves tried, `options.effort` a triangle, never with time. All arithmetic is in
/// integers, so that every machine makes the same strips.
///
/// cost  O(effort * n), as long as paths are long only where few ends are left
void anneal(LinkedPaths& paths, const StripOptions& options);

}  // namespace pstrips::inline codecs
