#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrip {

/// Our own. For few indices: straight strips, or SGI's when there is time, then anneal(). For few
/// strips, and for a high price a strip: a quarter of that, then join_strips(). When there is
/// little time for few strips it begins with multi_path_links(). tests/bench says what it reaches.
Strips best_strips(const StripInput& input, const StripOptions& options);

}  // namespace pstrip
