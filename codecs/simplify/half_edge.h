#pragma once

#include "codecs/simplify/simplify.h"

namespace pstrip {

/// simplify() with subset placement and the qem metric. A vertex stands in the heap once, under a
/// lower bound of its cheapest collapse: errors only grow, so the bound is checked when the vertex
/// comes up, and only edges that a collapse creates are looked at at once.
CollapseSequence simplify_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress);

}  // namespace pstrip
