#include "codecs/stripify/best.h"

#include <algorithm>

#include "codecs/stripify/anneal.h"
#include "codecs/stripify/few_strips.h"
#include "codecs/stripify/multi_path.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/straight_strips.h"

namespace pstrip {

namespace {

// Above, strips are also joined over longer ways; annealing finds those that add fewer swaps.
constexpr std::uint32_t kJoiningPrice = 6;
// Next to no cut is accepted at this price: strips are joined and straightened only.
constexpr std::uint32_t kHighStripPrice = 20;

StripOptions before_joining(StripOptions options) {
  if (options.goal == StripGoal::strips) options.strip_price = kHighStripPrice;
  options.strip_price = std::min(options.strip_price, kHighStripPrice);
  options.effort = std::max(options.effort / 4, 1u);  // joining gains more by the rest
  return options;
}

// A long search forgets where it began, but falls back on it: on very regular meshes SGI's spirals
// are hard to beat. A short one gets further from straight strips, or from those of many paths,
// which are few but wind.
Links start(const DualGraph& graph, const StripOptions& options, bool joins) {
  if (!joins) return options.effort < 10 ? straight_strips(graph) : sgi_strips_links(graph);
  return options.goal == StripGoal::strips && options.effort < 100 ? multi_path_links(graph)
                                                                   : sgi_strips_links(graph);
}

}  // namespace

Strips best_strips(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  const bool joins = options.goal == StripGoal::strips || options.strip_price > kJoiningPrice;
  const StripOptions annealing = joins ? before_joining(options) : options;
  LinkedPaths paths(graph, start(graph, options, joins));
  anneal(paths, annealing);
  if (joins)
    join_strips(paths, options,
                options.goal == StripGoal::strips
                    ? kAnySwaps
                    : static_cast<int>(std::min(options.strip_price, kMostStripPrice)));
  return emit_strips(input, graph, paths.links());
}

}  // namespace pstrip
