#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrip {

/// Our own. For few indices: straight strips, or SGI's when there is time, then anneal(). For few
/// strips: a quarter of that at a high price a strip, then join_strips(). The figures are printed
/// by tests/bench/stripify_bench.
Strips best_strips(const StripInput& input, const StripOptions& options);

}  // namespace pstrip
