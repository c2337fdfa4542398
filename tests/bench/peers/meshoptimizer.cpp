#include <meshoptimizer.h>

#include "core/strips.h"
#include "tests/bench/peers/adapters.h"

namespace pstrips::bench {

Strips meshoptimizer_strips(const StripInput& input, const StripOptions&) {
  std::vector<Index> ordered(input.triangles.size());
  meshopt_optimizeVertexCacheStrip(ordered.data(), input.triangles.data(), ordered.size(),
                                   input.wedge_count);
  Strips strips(meshopt_stripifyBound(ordered.size()));
  strips.resize(
      meshopt_stripify(strips.data(), ordered.data(), ordered.size(), input.wedge_count, kRestart));
  return strips;
}

}  // namespace pstrips::bench
