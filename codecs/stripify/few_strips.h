#pragma once

#include "codecs/stripify/linked_paths.h"
#include "codecs/stripify/stripify.h"

namespace pstrip {

inline constexpr int kAnySwaps = 1 << 30;

/// Joins strips until there is one a component, no join is left that adds at most `most_swaps`
/// swaps, or none of `options.effort` moves a triangle is left.
///
/// An end walks, slide by slide, to the nearest end of another strip: of the legal slides the one
/// that gets nearest, with some noise and a price for swaps. A walk that does not arrive or adds
/// too many swaps is taken back, so that the strips stay as straight as they were. Cheap joins come
/// first: the walks grow longer, and the swaps a join may add more, as fewer of them arrive. Paths
/// are followed by PathIndex, since few strips are long ones.
///
/// source  Slides along a path are [Stewart01]'s tunnels, one dual edge at a time; without a search
/// for a whole tunnel there is nothing to check for cycles in the end.
void join_strips(LinkedPaths& paths, const StripOptions& options, int most_swaps = kAnySwaps);

}  // namespace pstrip
