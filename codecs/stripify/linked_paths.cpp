#include "codecs/stripify/linked_paths.h"

namespace pstrip {

LinkedPaths::LinkedPaths(const DualGraph& graph, const Links& links)
    : opposite_(std::size_t{4} * graph.triangle_count(), kNone), linked_(graph.triangle_count()) {
  for (Index t = 0; t < graph.triangle_count(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const Index o = graph.opposite[3 * t + k];
      if (o != kNone) opposite_[half_edge(t, k)] = half_edge(o / 3, o % 3);
      if (links[3 * t + k]) linked_[t] |= static_cast<std::uint8_t>(1u << k);
    }
}

Links LinkedPaths::links() const {
  Links links(std::size_t{3} * triangle_count());
  for (Index t = 0; t < triangle_count(); ++t)
    for (Index k = 0; k < 3; ++k) links[3 * t + k] = is_linked(half_edge(t, k));
  return links;
}

}  // namespace pstrip
