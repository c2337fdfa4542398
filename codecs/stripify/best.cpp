#include "codecs/stripify/best.h"

#include "codecs/stripify/anneal.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/straight_strips.h"

namespace pstrip {

Strips best_strips(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  // From straight strips a short run gets further. A long one forgets where it began, but falls
  // back on it: on very regular meshes SGI's spirals are hard to beat.
  const bool is_short = options.effort < 10;
  LinkedPaths paths(graph, is_short ? straight_strips(graph) : sgi_strips_links(graph));
  anneal(paths, options);
  return emit_strips(input, graph, paths.links());
}

}  // namespace pstrip
