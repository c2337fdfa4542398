#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// Strips in an order that suits a cache of 16 transformed wedges, first in, first out: rows side
/// by side, each so short that what it shares with the next one is still cached when that comes.
///
/// A row keeps to the strip beside it: it turns towards that wherever it can, so that irregular
/// vertices cost a swap and leave no triangle behind. Where a row starts and how long it gets is
/// decided by trying: every length up to 32 triangles, each followed by the next row, at each of a
/// few starts; the one with the lowest cost a triangle is taken. A load costs as much as two
/// entries there: at 1, 2 and 4 entries bunny has 0.649, 0.634 and 0.624 loads and 1.356, 1.380
/// and 1.409 indices a triangle. What is left over far from the cache is covered last.
///
/// cost    O(n), about 100 trial steps a triangle; the same input gives the same strips
/// source  ours. Strips whose lengths are found by simulating the cache are due to [Hoppe99a]. That
///         a row keeps to the strip beside it pays: with turns that alternate, all else equal, 0.71
///         loads and 1.49 indices on bunny. An order for caches of every size [Bogomjakov01] has
///         0.74 loads on bunny, 0.73 on cow [Vanecek05 table 8.6]; ours 0.634 and 0.657.
Strips cache_strips(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
