#include "codecs/stripify/mstrip.h"

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

StripStats stats_of(const StripMesh& mesh, StripGoal goal) {
  const Strips strips = mstrip(mesh.input(), {.goal = goal});
  EXPECT_EQ(find_strip_fault(mesh.input(), strips), "");
  return strip_stats(strips);
}

// stripify_test covers the other goal.
RC_GTEST_PROP(MStrip, CoversRandomSoupsByFewStrips, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::random_soup(seed, 20, 200));
  const Strips strips = mstrip(mesh.input(), {.goal = StripGoal::strips});
  RC_ASSERT(find_strip_fault(mesh.input(), strips) == "");
}

// The original leaves two, or up to nineteen for few vertices. [Vanecek05 table 8.9]
TEST(MStrip, ConnectsItsTwoStripsOnATorus) {
  for (const Index segments : {20u, 50u, 100u, 200u}) {
    const StripMesh mesh = test::strip_mesh(test::torus(segments, 20));
    EXPECT_LE(stats_of(mesh, StripGoal::strips).strips, 2u);
    EXPECT_LE(stats_of(mesh, StripGoal::indices).strips, 19u);
  }
}

// The strips meet in the middle of a row of triangles, each having started at an end.
TEST(MStrip, ConnectsStripsThatMeet) {
  StripMesh row;
  for (Index t = 0; t < 20; ++t)
    row.triangles.insert(row.triangles.end(), {t + t % 2, t + 1 - t % 2, t + 2});
  row.wedge_count = 22;
  EXPECT_EQ(stats_of(row, StripGoal::strips).strips, 1u);
  EXPECT_EQ(stats_of(row, StripGoal::indices).swaps, 0u);
}

TEST(MStrip, TradesStripsForSwapsByTheGoal) {
  StripMesh mesh = test::strip_mesh(test::torus(60, 60));
  for (std::size_t t = mesh.group.size(); t-- > 0;) {  // with small holes everywhere
    if (t * t % 7 != 2) continue;
    const auto corner = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t);
    mesh.triangles.erase(corner, corner + 3);
    mesh.group.erase(mesh.group.begin() + static_cast<std::ptrdiff_t>(t));
  }
  const StripStats few_strips = stats_of(mesh, StripGoal::strips);
  const StripStats few_indices = stats_of(mesh, StripGoal::indices);
  EXPECT_LT(few_strips.strips, few_indices.strips);
  EXPECT_LT(few_indices.swaps, few_strips.swaps);
}

}  // namespace
}  // namespace pstrips
