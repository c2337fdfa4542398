#pragma once

#include "codecs/simplify/simplify.h"

namespace pstrips::inline codecs {

/// simplify() with optimal placement, or with the memoryless metric, in general. A vertex stands in
/// the queue once, under the cost that its cheapest collapse had when it was last looked at; it is
/// looked at again when it comes up.
CollapseSequence collapse_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                const Progress& progress);

}  // namespace pstrips::inline codecs
