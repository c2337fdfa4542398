#include "codecs/stripify/best.h"

#include <algorithm>

#include "codecs/stripify/anneal.h"
#include "codecs/stripify/delaunay.h"
#include "codecs/stripify/few_strips.h"
#include "codecs/stripify/qstrip.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/stats.h"
#include "codecs/stripify/straight_strips.h"
#include "codecs/stripify/tunneling.h"

namespace pstrips::inline codecs {

namespace {

// Above, strips are also joined by tunnels; annealing finds those that add fewer swaps.
constexpr std::uint32_t kJoiningPrice = 6;
// Next to no cut is accepted at this price: strips are joined and straightened only.
constexpr std::uint32_t kHighStripPrice = 20;
// Tunnels in edges, the cheap ones first. Beyond, nearly all of them are too dear for a price.
constexpr std::uint32_t kTunnels[] = {15, 31, 75};
constexpr std::uint32_t kLongTunnels[] = {151, 301, 601};
constexpr std::uint32_t kMaxRounds = 8;

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
               static_cast<int>(std::min(options.strip_price, kMaxStripPrice)));
  dig(paths, options, kTunnels, kAnySwaps);
  dig(paths, options, kLongTunnels, kAnySwaps);
  // Walks shake the last ends up; what they leave apart, tunnels may join then.
  StripOptions walk = options;
  walk.effort = std::max(options.effort / 32, 1u);
  const std::uint32_t rounds = std::min(kMaxRounds, 1 + options.effort / 50);
  for (std::uint32_t round = 0; round < rounds; ++round, ++walk.seed) {
    join_strips(paths, walk);
    dig(paths, options, kTunnels, kAnySwaps);
    dig(paths, options, kLongTunnels, kAnySwaps);
  }
}

// The triangles that strips over polygons show.
struct Triangles {
  std::vector<Index> corners, group;
};

Triangles triangles_of(const Strips& strips, const PolygonInput& input) {
  Triangles out;
  for_each_triangle(
      strips, [](Index wedge) { return wedge; },
      [&](Index a, Index b, Index c) {
        out.corners.insert(out.corners.end(), {a, b, c});
      });
  if (input.group.empty()) return out;
  // Strips come in ascending order of group, so the numbers of their triangles part them.
  for (std::size_t f = 0; f + 1 < input.face_first.size(); ++f)
    out.group.insert(out.group.end(), input.face_first[f + 1] - input.face_first[f] - 2,
                     input.group[f]);
  std::ranges::sort(out.group);
  return out;
}

// Links the triangles of `strips`, numbered as the strips show them.
Links links_of(const Strips& strips, const DualGraph& graph) {
  Links links(graph.half_edge_count());
  Index triangle = 0;
  bool is_first = true;
  for (std::size_t i = 0; i + 2 < strips.size(); ++i) {
    const Index a = strips[i], b = strips[i + 1], c = strips[i + 2];
    if (c == kRestart) is_first = true;
    if (a == kRestart || b == kRestart || c == kRestart || a == b || b == c || a == c) continue;
    for (Index h = 3 * triangle; h < 3 * triangle + 3 && !is_first; ++h)
      if (graph.neighbor(h) == triangle - 1) {
        set_link(graph, links, h, true);
        break;
      }
    is_first = false;
    ++triangle;
  }
  return links;
}

bool joins(const StripOptions& options) {
  return options.goal == StripGoal::strips || options.strip_price > kJoiningPrice;
}

StripOptions annealing(StripOptions options) {
  if (!joins(options)) return options;
  options.strip_price = options.goal == StripGoal::strips
                            ? kHighStripPrice
                            : std::min(options.strip_price, kHighStripPrice);
  options.effort = std::max(options.effort / 2, 1u);
  return options;
}

// From straight strips a short run gets further. A long one forgets where it began, but falls back
// on it: on very regular meshes SGI's spirals are hard to beat.
Links start(const DualGraph& graph, const StripOptions& options) {
  return options.effort < 10 && !joins(options) ? straight_strips(graph) : sgi_strips_links(graph);
}

// What annealing brings down, the start of strips included.
std::int64_t cost(const Strips& strips, const StripOptions& options) {
  const StripStats stats = strip_stats(strips);
  const std::uint32_t price =
      options.goal == StripGoal::strips ? kMaxStripPrice : options.strip_price;
  return std::int64_t{price} * static_cast<std::int64_t>(stats.strips) +
         static_cast<std::int64_t>(stats.swaps);
}

Strips improve(const StripInput& input, const DualGraph& graph, const Links& links,
               const StripOptions& given) {
  StripOptions options = given;
  bool stopped = false;  // by any search; those after it end at once
  if (given.stop) options.stop = [&] { return stopped = stopped || given.stop(); };
  LinkedPaths paths(graph, links, input.step_cost);
  anneal(paths, annealing(options));
  if (joins(options)) join(paths, options);
  return emit_strips(input, graph, paths.links());
}

}  // namespace

Strips best_strips(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  return improve(input, graph, start(graph, options), options);
}

Strips best_polygon_strips(const PolygonInput& polygons, const StripOptions& options) {
  const Strips strips = qstrip_polygons(polygons, options);
  const Triangles triangles = triangles_of(strips, polygons);
  const StripInput input{.triangles = triangles.corners,
                         .group = triangles.group,
                         .wedge_count = polygons.wedge_count,
                         .positions = polygons.positions};
  const DualGraph graph = make_dual_graph(input);
  const Strips improved = improve(input, graph, links_of(strips, graph), options);
  // Around non-manifold edges, triangles may pair up in other ways than their faces did.
  return cost(improved, options) <= cost(strips, options) ? improved : strips;
}

Strips best_point_strips(std::span<const double> positions, const StripOptions& options) {
  const std::vector<Index> triangles = delaunay_triangles(positions, options);
  return best_strips({.triangles = triangles,
                      .group = {},
                      .wedge_count = static_cast<Index>(positions.size() / 3)},
                     options);
}

}  // namespace pstrips::inline codecs
