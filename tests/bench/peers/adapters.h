#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::bench {

// One file each, compiled where the library is there. Groups are not looked at: whoever calls
// gives one group at a time.

Strips meshoptimizer_strips(const StripInput& input, const StripOptions& options);
Strips openmesh_strips(const StripInput& input, const StripOptions& options);
Strips vtk_strips(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::bench
