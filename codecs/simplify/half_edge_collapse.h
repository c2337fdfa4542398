#pragma once

#include "codecs/simplify/simplify.h"

namespace pstrips::inline codecs {

/// simplify() with subset placement. A vertex waits under the cost of its cheapest collapse when it
/// was last looked at, and is looked at again when it comes up; nothing else is kept up to date.
/// Costs that have fallen meanwhile are found late. They rarely fall: looking at the kept vertex
/// and its neighbours after each collapse gave levels no nearer to the source.
CollapseSequence collapse_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress);

}  // namespace pstrips::inline codecs
