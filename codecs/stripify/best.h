#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrip {

/// Our own: straight strips, then annealing of the exact number of indices sent.
/// Beats every algorithm it was compared with at `effort` 1 and goes on from there.
Strips best_strips(const StripInput& input, const StripOptions& options);

}  // namespace pstrip
