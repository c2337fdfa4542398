#include "codecs/stripify/tunneling.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <utility>

#include "codecs/stripify/random.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/stats.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::find_strip_fault;
using test::StripMesh;

std::uint64_t strip_count(const Strips& strips) { return strip_stats(strips).strips; }

// A torus that lost one triangle in `one_in` at random.
StripMesh moth_eaten(std::uint32_t seed, Index side, Index one_in) {
  StripMesh mesh = test::strip_mesh(test::torus(side, side));
  Random random(seed);
  StripMesh out{{}, {}, mesh.wedge_count, mesh.positions};
  for (std::size_t c = 0; c < mesh.triangles.size(); c += 3)
    if (random.below(one_in) != 0) {
      out.triangles.insert(out.triangles.end(), &mesh.triangles[c], &mesh.triangles[c] + 3);
      out.group.push_back(0);
    }
  return out;
}

// Strips that nothing chose: edges linked at random while no ring is closed.
Links random_links(const DualGraph& graph, std::uint32_t seed) {
  LinkedPaths paths(graph, Links(graph.half_edge_count()));
  Random random(seed);
  for (Index i = 0; i < paths.triangle_count(); ++i) {
    const Index h = LinkedPaths::half_edge(random.below(paths.triangle_count()), random.below(3));
    if (!paths.has_opposite(h) || paths.is_linked(h)) continue;
    const Index s = LinkedPaths::triangle_of(h), t = LinkedPaths::triangle_of(paths.opposite(h));
    if (paths.is_end(s) && paths.is_end(t) && !paths.on_same_path(s, t)) paths.flip(h);
  }
  return paths.links();
}

// Rings would leave triangles out.
RC_GTEST_PROP(Tunneling, KeepsStripsThatCoverTheMesh, (std::uint32_t seed)) {
  const StripMesh mesh =
      seed % 2 ? moth_eaten(seed, 12, 12) : test::strip_mesh(test::random_soup(seed, 20, 300));
  const DualGraph graph = make_dual_graph(mesh.input());
  LinkedPaths paths(graph, random_links(graph, seed));
  const std::uint64_t before = strip_count(emit_strips(mesh.input(), graph, paths.links()));
  dig_tunnels(paths, {.tunnel_length = *rc::gen::inRange(1u, 200u)});
  const Strips strips = emit_strips(mesh.input(), graph, paths.links());
  RC_ASSERT(find_strip_fault(mesh.input(), strips) == "");
  RC_ASSERT(strip_count(strips) <= before);
}

// x - a - b - y are one strip, s beside a and t beside b are alone. The tunnel s . a - b . t makes
// them s - a - x and y - b - t.
TEST(Tunneling, DigsNoLongerTunnelThanAllowed) {
  constexpr Index kA = 0, kB = 3;  // first half-edges
  const std::vector<Index> triangles{0, 1, 2, 2, 1, 3, 1, 0, 4, 0, 2, 5, 3, 1, 6, 2, 3, 7};
  const StripInput input{triangles, {}, 8};
  const DualGraph graph = make_dual_graph(input);
  Links links(graph.half_edge_count());
  for (const Index h : {kA, kA + 1, kB + 1}) set_link(graph, links, h, true);
  for (const auto& [length, strips] : {std::pair{0u, 3u}, {1u, 3u}, {2u, 3u}, {3u, 2u}}) {
    LinkedPaths paths(graph, links);
    dig_tunnels(paths, {.tunnel_length = length});
    EXPECT_EQ(strip_count(emit_strips(input, graph, paths.links())), strips) << length;
  }
}

TEST(Tunneling, JoinsAWholeTorus) {
  const StripMesh mesh = test::strip_mesh(test::torus(30, 20));
  const DualGraph graph = make_dual_graph(mesh.input());
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    LinkedPaths paths(graph, random_links(graph, seed));
    dig_tunnels(paths, {});
    EXPECT_LE(strip_count(emit_strips(mesh.input(), graph, paths.links())), 2u) << seed;
  }
}

// [Vanecek05 table 8.9]
TEST(Tunneling, CoversATorusByOneStrip) {
  for (const Index segments : {20u, 50u, 100u, 200u, 500u}) {
    const StripMesh mesh = test::strip_mesh(test::torus(segments, 20));
    EXPECT_EQ(strip_count(tunneling(mesh.input(), {})), 1u) << segments;
  }
}

TEST(Tunneling, GainsByLength) {
  const StripMesh mesh = moth_eaten(1, 60, 200);
  const auto strips = [&](std::uint32_t length) {
    return strip_count(tunneling(mesh.input(), {.tunnel_length = length}));
  };
  EXPECT_LE(strips(1), strips(0));
  EXPECT_LT(strips(15), strips(1));
  EXPECT_LT(strips(75), strips(15));
}

TEST(Tunneling, EndsWhenToldTo) {
  const StripMesh mesh = moth_eaten(1, 60, 200);
  const Strips start = tunneling(mesh.input(), {.tunnel_length = 0});
  EXPECT_EQ(tunneling(mesh.input(), {.tunnel_effort = 0}), start);
  const std::uint64_t without = strip_count(start);
  const std::uint64_t all = strip_count(tunneling(mesh.input(), {}));
  int asked = 0;
  const Strips stopped =
      tunneling(mesh.input(), {.tunnel_effort = 1000, .stop = [&] { return ++asked == 1; }});
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(find_strip_fault(mesh.input(), stopped), "");
  EXPECT_GE(strip_count(stopped), all);
  EXPECT_LT(strip_count(stopped), without);
}

}  // namespace
}  // namespace pstrips
