#pragma once

#include "codecs/stripify/emit.h"

namespace pstrips::inline codecs {

/// Strips without swaps: each starts at a free triangle with the fewest free neighbours and is the
/// longest of the three that pass it straight, both ways. O(n): the walks that are dropped are
/// no longer than the one kept.
Links straight_strips(const DualGraph& graph);

}  // namespace pstrips::inline codecs
