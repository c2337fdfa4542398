#include "codecs/stripify/multi_path.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <utility>

#include "codecs/stripify/linked_paths.h"
#include "codecs/stripify/stats.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::StripMesh;

std::uint64_t strip_count(const Strips& strips) { return strip_stats(strips).strips; }

// What is left open would be linked, and only a third link or a ring closes an edge.
RC_GTEST_PROP(MultiPath, LeavesNoTwoStripsThatCouldBeOne, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::random_soup(seed, 12, 200));
  const DualGraph graph = make_dual_graph(mesh.input());
  const LinkedPaths paths(graph, multi_path_links(graph));
  for (Index t = 0; t < paths.triangle_count(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const Index h = LinkedPaths::half_edge(t, k);
      if (!paths.has_opposite(h) || paths.is_linked(h)) continue;
      const Index n = LinkedPaths::triangle_of(paths.opposite(h));
      RC_ASSERT(!paths.is_end(t) || !paths.is_end(n) || paths.on_same_path(t, n));
    }
}

// [Vanecek05 table 8.9] has one strip for all of them.
TEST(MultiPath, CoversATorusByOneStrip) {
  for (const Index segments : {20u, 50u, 100u, 200u, 500u}) {
    SCOPED_TRACE(segments);
    const StripMesh mesh = test::strip_mesh(test::torus(segments, 20));
    EXPECT_EQ(strip_count(multi_path(mesh.input(), {})), 1u);
    EXPECT_EQ(strip_count(multi_path_weighted(mesh.input(), {})), 1u);
    EXPECT_LE(strip_count(multi_path_weighted(mesh.input(), {.weight = StripWeight::axis})), 3u);
  }
}

// The mean distance in x between the centres of triangles that follow each other in a strip.
double step_along_x(const StripMesh& mesh, const Strips& strips) {
  double sum = 0, last = 0;
  std::size_t steps = 0;
  bool follows = false;
  for (std::size_t i = 0; i + 2 < strips.size(); ++i) {
    const Index a = strips[i], b = strips[i + 1], c = strips[i + 2];
    if (a == kRestart || b == kRestart || c == kRestart) {
      follows = false;
    } else if (a != b && b != c && a != c) {
      const auto x = [&](Index w) { return mesh.positions[std::size_t{3} * w] / 3; };
      const double centre = x(a) + x(b) + x(c);
      if (follows) sum += std::abs(centre - last);
      steps += follows;
      last = centre;
      follows = true;
    }
  }
  return sum / static_cast<double>(steps);
}

// Only where there is a choice: in a regular grid with a border there is none.
TEST(MultiPath, PrefersStripsAcrossTheAxis) {
  StripMesh mesh = test::strip_mesh(test::torus(20, 80));
  for (const char* turned : {"as it is", "with x and y exchanged"}) {
    SCOPED_TRACE(turned);
    const Strips strips = multi_path_weighted(mesh.input(), {.weight = StripWeight::axis});
    const double without = step_along_x(mesh, multi_path(mesh.input(), {}));
    EXPECT_LT(step_along_x(mesh, strips), 0.95 * without);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      std::swap(mesh.positions[i], mesh.positions[i + 1]);
  }
}

TEST(MultiPath, WeighsByDistanceWhereThereAreNoPositions) {
  StripMesh mesh = test::strip_mesh(test::torus(30, 20));
  const Strips by_distance = multi_path_weighted(mesh.input(), {});
  EXPECT_NE(multi_path_weighted(mesh.input(), {.weight = StripWeight::axis}), by_distance);
  mesh.positions.clear();
  EXPECT_EQ(multi_path_weighted(mesh.input(), {.weight = StripWeight::axis}), by_distance);
}

// Powers of two, so that no position is rounded; the last one brings x near the largest double.
TEST(MultiPath, WeighsAlikeAtAnyScale) {
  const StripMesh mesh = test::strip_mesh(test::torus(30, 20));
  const StripOptions axis{.weight = StripWeight::axis};
  const Strips strips = multi_path_weighted(mesh.input(), axis);
  for (const int exponent : {-900, -1, 10, 1022}) {
    SCOPED_TRACE(exponent);
    StripMesh scaled = mesh;
    for (double& x : scaled.positions) x = std::ldexp(x / 2, exponent);
    EXPECT_EQ(multi_path_weighted(scaled.input(), axis), strips);
  }
}

}  // namespace
}  // namespace pstrips
