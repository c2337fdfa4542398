#include "codecs/stripify/linked_paths.h"

#include <algorithm>

namespace pstrips::inline codecs {

LinkedPaths::LinkedPaths(const DualGraph& graph, const Links& links,
                         std::span<const std::uint8_t> step_cost)
    : opposite_(std::size_t{4} * graph.triangle_count(), kNone),
      step_cost_(step_cost.empty() ? 0 : opposite_.size()),
      linked_(graph.triangle_count()) {
  for (Index t = 0; t < graph.triangle_count(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const Index o = graph.opposite[3 * t + k];
      if (o != kNone) opposite_[half_edge(t, k)] = half_edge(o / 3, o % 3);
      if (o != kNone && !step_cost.empty())
        step_cost_[half_edge(t, k)] =
            static_cast<std::uint8_t>(std::min(255, step_cost[3 * t + k] + step_cost[o]));
      if (links[3 * t + k]) linked_[t] |= static_cast<std::uint8_t>(1u << k);
    }
}

Links LinkedPaths::links() const {
  Links links(std::size_t{3} * triangle_count());
  for (Index t = 0; t < triangle_count(); ++t)
    for (Index k = 0; k < 3; ++k) links[3 * t + k] = is_linked(half_edge(t, k));
  return links;
}

}  // namespace pstrips::inline codecs
