#include "codecs/simplify/simplify.h"

#include <cassert>

#include "codecs/simplify/edge_collapse.h"
#include "codecs/simplify/half_edge_collapse.h"

namespace pstrips::inline codecs {

CollapseSequence simplify(const SimplifyInput& input, const SimplifyOptions& options,
                          const Progress& progress) {
  assert(input.positions.size() % 3 == 0 && input.triangles.size() % 3 == 0);
  assert(input.group.empty() || input.group.size() == input.triangles.size() / 3);
  if (options.placement == Placement::subset) return collapse_half_edges(input, options, progress);
  return collapse_edges(input, options, progress);
}

}  // namespace pstrips::inline codecs
