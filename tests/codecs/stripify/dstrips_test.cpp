#include "codecs/stripify/dstrips.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "codecs/stripify/stats.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::find_strip_fault;
using test::StripMesh;

StripStats stats_of(const StripMesh& mesh, Stripifier stripify) {
  const Strips strips = stripify(mesh.input(), {});
  EXPECT_EQ(find_strip_fault(mesh.input(), strips), "");
  return strip_stats(strips);
}

RC_GTEST_PROP(DStripsGreedyNoSwap, NeverRepeatsAnEntry, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::random_soup(seed, 30, 200));
  RC_ASSERT(strip_stats(dstrips_greedy_no_swap(mesh.input(), {})).swaps == 0u);
}

// A row of three triangles, the third with one more on each of its other sides.
constexpr Index kFork[] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 2, 4, 6};

TEST(DStripsAdjacency, JoinsTwoDeadEndsOverTheTriangleBetween) {
  const StripMesh fork{{std::begin(kFork), std::end(kFork)}, {}, 7};
  EXPECT_EQ(stats_of(fork, dstrips_greedy).singletons, 1u);
  const StripStats joined = stats_of(fork, dstrips_adjacency);
  EXPECT_EQ(joined.strips, 2u);
  EXPECT_EQ(joined.singletons, 0u);
}

// The same fork as the strip's second triangle: to join the dead ends would leave the first alone.
TEST(DStripsAdjacency, DoesNotTradeOneLoneTriangleForAnother) {
  const StripMesh fork{{std::begin(kFork) + 3, std::end(kFork)}, {}, 7};
  EXPECT_EQ(stats_of(fork, dstrips_adjacency).strips, 2u);
  EXPECT_EQ(stats_of(fork, dstrips_adjacency).singletons, 1u);
}

// After the first triangle of a square grid, FIFO order leaves no part of it out.
TEST(DStrips, ComeBackToWhatTheyPassedBy) {
  const StripMesh mesh = test::strip_mesh(test::grid(20));
  for (const Stripifier stripify : {dstrips_greedy, dstrips_greedy_no_swap, dstrips_adjacency})
    EXPECT_EQ(stats_of(mesh, stripify).triangles, 2u * 19 * 19);
}

// A torus with small holes everywhere.
StripMesh moth_eaten() {
  const StripMesh torus = test::strip_mesh(test::torus(60, 60));
  StripMesh mesh;
  mesh.wedge_count = torus.wedge_count;
  for (std::size_t t = 0; t < torus.triangles.size() / 3; ++t)
    for (std::size_t k = 0; k < 3 && t * t % 7 != 2; ++k)
      mesh.triangles.push_back(torus.triangles[3 * t + k]);
  return mesh;
}

// Few strips by adjacency, few swaps by alternation. [Shafae03 §6, tables 2 and 3]
TEST(DStrips, RankAsInThePaper) {
  const StripMesh mesh = moth_eaten();
  const StripStats greedy = stats_of(mesh, dstrips_greedy);
  const StripStats no_swap = stats_of(mesh, dstrips_greedy_no_swap);
  const StripStats adjacency = stats_of(mesh, dstrips_adjacency);
  EXPECT_LT(adjacency.strips, greedy.strips);
  EXPECT_LT(greedy.strips, no_swap.strips);
  EXPECT_LT(greedy.swaps, adjacency.swaps);
}

}  // namespace
}  // namespace pstrips
