#pragma once

#include "codecs/simplify/simplify.h"

namespace pstrip {

/// simplify() with subset placement; with the memoryless metric only if each vertex has one wedge
/// without attributes. A vertex stands in the heap once, under a lower bound of its cheapest
/// collapse: errors only grow, so the bound is checked when the vertex comes up, and only edges
/// that a collapse creates are looked at at once. With the memoryless metric errors may fall, and
/// such a collapse is found late; a vertex looks at the faces around it again when it comes up.
CollapseSequence simplify_half_edges(const SimplifyInput& input, const SimplifyOptions& options,
                                     const Progress& progress);

}  // namespace pstrip
