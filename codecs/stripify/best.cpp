#include "codecs/stripify/best.h"

#include <algorithm>

#include "codecs/stripify/anneal.h"
#include "codecs/stripify/few_strips.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/straight_strips.h"

namespace pstrip {

namespace {

// Next to no cut is accepted at this price: strips are joined and straightened only.
constexpr std::uint32_t kHighStripPrice = 20;

StripOptions before_joining(StripOptions options) {
  options.strip_price = std::max(options.strip_price, kHighStripPrice);
  options.effort = std::max(options.effort / 4, 1u);  // joining gains more by the rest
  return options;
}

}  // namespace

Strips best_strips(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  const bool joins = options.goal == StripGoal::strips;
  const StripOptions annealing = joins ? before_joining(options) : options;
  // From straight strips a short run gets further. A long one forgets where it began, but falls
  // back on it: on very regular meshes SGI's spirals are hard to beat.
  const bool is_short = annealing.effort < 10;
  LinkedPaths paths(graph, is_short && !joins ? straight_strips(graph) : sgi_strips_links(graph));
  anneal(paths, annealing);
  if (joins) join_strips(paths, options);
  return emit_strips(input, graph, paths.links());
}

}  // namespace pstrip
