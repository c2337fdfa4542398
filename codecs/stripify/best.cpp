#include "codecs/stripify/best.h"

#include <algorithm>

#include "codecs/stripify/anneal.h"
#include "codecs/stripify/few_strips.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/straight_strips.h"
#include "codecs/stripify/tunneling.h"

namespace pstrip {

namespace {

// Above, strips are also joined by tunnels; annealing finds those that add fewer swaps.
constexpr std::uint32_t kJoiningPrice = 6;
// Next to no cut is accepted at this price: strips are joined and straightened only.
constexpr std::uint32_t kHighStripPrice = 20;
// Tunnels in edges, the cheap ones first. Beyond, nearly all of them are too dear for a price.
constexpr std::uint32_t kTunnels[] = {15, 31, 75};
constexpr std::uint32_t kLongTunnels[] = {151, 301, 601};
constexpr std::uint32_t kMostRounds = 8;

void dig(LinkedPaths& paths, StripOptions options, std::span<const std::uint32_t> lengths,
         int most_swaps) {
  options.tunnel_effort = std::max(options.effort / 16, 4u);
  for (const std::uint32_t length : lengths) {
    options.tunnel_length = length;
    dig_tunnels(paths, options, most_swaps);
  }
}

void join(LinkedPaths& paths, StripOptions options) {
  if (options.goal == StripGoal::indices)
    return dig(paths, options, kTunnels,
               static_cast<int>(std::min(options.strip_price, kMostStripPrice)));
  dig(paths, options, kTunnels, kAnySwaps);
  dig(paths, options, kLongTunnels, kAnySwaps);
  // Walks shake the last ends up; what they leave apart, tunnels may join then.
  StripOptions walk = options;
  walk.effort = std::max(options.effort / 32, 1u);
  const std::uint32_t rounds = std::min(kMostRounds, 1 + options.effort / 50);
  for (std::uint32_t round = 0; round < rounds; ++round, ++walk.seed) {
    join_strips(paths, walk);
    dig(paths, options, kTunnels, kAnySwaps);
    dig(paths, options, kLongTunnels, kAnySwaps);
  }
}

}  // namespace

Strips best_strips(const StripInput& input, const StripOptions& given) {
  const DualGraph graph = make_dual_graph(input);
  StripOptions options = given;
  bool stopped = false;  // by whichever search asked; the ones after it are over at once
  if (given.stop) options.stop = [&] { return stopped = stopped || given.stop(); };
  const bool joins = options.goal == StripGoal::strips || options.strip_price > kJoiningPrice;
  StripOptions annealing = options;
  if (joins) {
    annealing.strip_price = options.goal == StripGoal::strips
                                ? kHighStripPrice
                                : std::min(options.strip_price, kHighStripPrice);
    annealing.effort = std::max(options.effort / 2, 1u);
  }
  // From straight strips a short run gets further. A long one forgets where it began, but falls
  // back on it: on very regular meshes SGI's spirals are hard to beat.
  const bool is_short = annealing.effort < 10 && !joins;
  LinkedPaths paths(graph, is_short ? straight_strips(graph) : sgi_strips_links(graph));
  anneal(paths, annealing);
  if (joins) join(paths, options);
  return emit_strips(input, graph, paths.links());
}

}  // namespace pstrip
