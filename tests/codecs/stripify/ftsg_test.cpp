#include "codecs/stripify/ftsg.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <utility>

#include "codecs/stripify/linked_paths.h"
#include "codecs/stripify/random.h"
#include "codecs/stripify/stats.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::StripMesh;

constexpr Stripifier kAll[] = {ftsg, ftsg_sgi, ftsg_alt};

// Triangles glued on at random, each with a vertex of its own: the dual graph is a tree.
StripMesh random_tree(std::uint32_t seed, Index triangles) {
  StripMesh mesh{{0, 1, 2}, {}, 3, {}};
  Random random(seed);
  std::vector<Index> border{0, 1, 2};  // half-edges
  while (mesh.triangles.size() < std::size_t{3} * triangles) {
    const Index place = random.below(static_cast<Index>(border.size()));
    const Index h = std::exchange(border[place], border.back());
    border.pop_back();
    const Index first = static_cast<Index>(mesh.triangles.size());
    const Index a = mesh.triangles[h], b = mesh.triangles[next_in_triangle(h)];
    mesh.triangles.insert(mesh.triangles.end(), {b, a, mesh.wedge_count++});
    border.insert(border.end(), {first + 1, first + 2});
  }
  return mesh;
}

struct Cost {
  std::uint64_t strips, swaps;
  friend auto operator<=>(const Cost&, const Cost&) = default;
};

// Without the swap that some strips take at their start.
Cost cost_of(const Strips& strips) {
  std::uint64_t swaps = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i + 2 < strips.size(); ++i) {
    if (strips[i] == kRestart) start = i + 1;
    swaps += i >= start + 2 && strips[i + 1] != kRestart && strips[i] == strips[i + 2];
  }
  return {strip_stats(strips).strips, swaps};
}

// By trying every set of links.
Cost least_cost(const StripInput& input) {
  const DualGraph graph = make_dual_graph(input);
  std::vector<Index> edges;
  for (Index h = 0; h < graph.half_edge_count(); ++h)
    if (graph.opposite[h] != kNone && graph.opposite[h] > h) edges.push_back(h);
  Cost least{std::numeric_limits<std::uint64_t>::max(), 0};
  for (std::uint32_t set = 0; set < 1u << edges.size(); ++set) {
    Links links(graph.half_edge_count());
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (set >> i & 1) set_link(graph, links, edges[i], true);
    bool is_legal = true;
    for (std::size_t h = 0; h < links.size(); h += 3)
      is_legal = is_legal && links[h] + links[h + 1] + links[h + 2] <= 2;
    if (is_legal) least = std::min(least, cost_of(emit_strips(input, graph, links)));
  }
  return least;
}

RC_GTEST_PROP(Ftsg, CutsATreeIntoTheFewestStripsWithTheFewestSwaps, (std::uint32_t seed)) {
  const StripMesh mesh = random_tree(seed, 1 + seed % 9);
  const Cost least = least_cost(mesh.input());
  for (const Stripifier run : kAll) {
    const Cost cost = cost_of(run(mesh.input(), {}));
    RC_ASSERT(cost.strips == least.strips);
    RC_ASSERT(cost.swaps == least.swaps);
  }
}

// [Vanecek05 table 8.9]: FTS and FTV.
TEST(Ftsg, CoversATorusAsTheThesisHasIt) {
  constexpr std::pair<Index, std::uint64_t> kAltStrips[] = {
      {20, 19}, {50, 9}, {100, 19}, {200, 19}, {500, 19}};
  for (const auto& [segments, strips] : kAltStrips) {
    SCOPED_TRACE(segments);
    const StripMesh mesh = test::strip_mesh(test::torus(segments, 20));
    EXPECT_EQ(strip_stats(ftsg_sgi(mesh.input(), {})).strips, 1u);
    EXPECT_EQ(strip_stats(ftsg_alt(mesh.input(), {})).strips, strips);
  }
}

// A tree that is one path of a million triangles.
TEST(Ftsg, GoesAsDeepAsTheMeshIsLarge) {
  constexpr Index kTriangles = 1'000'000;
  StripMesh mesh{{}, {}, kTriangles + 2, {}};
  for (Index t = 0; t < kTriangles; ++t)
    mesh.triangles.insert(mesh.triangles.end(), {t, t + 1 + t % 2, t + 2 - t % 2});
  for (const Stripifier run : kAll) EXPECT_EQ(cost_of(run(mesh.input(), {})), (Cost{1, 0}));
}

}  // namespace
}  // namespace pstrips
