#include "codecs/stripify/dual_graph.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using Opposite = std::vector<Index>;
constexpr Index kNo = kNone;

struct Case {
  const char* name;
  std::vector<Index> triangles, group;
  Opposite opposite;
};

const Case kCases[] = {
    {"neighbours", {0, 1, 2, 2, 1, 3}, {}, {kNo, 3, kNo, 1, kNo, kNo}},
    {"neighbours in other groups", {0, 1, 2, 2, 1, 3}, {0, 1}, {kNo, kNo, kNo, kNo, kNo, kNo}},
    {"the same direction", {0, 1, 2, 1, 2, 3}, {}, {kNo, kNo, kNo, kNo, kNo, kNo}},
    {"third one left over",
     {0, 1, 2, 1, 0, 3, 1, 0, 4},
     {},
     {3, kNo, kNo, 0, kNo, kNo, kNo, kNo, kNo}},
    {"in order of appearance",
     {0, 1, 2, 0, 1, 3, 1, 0, 4, 1, 0, 5},
     {},
     {6, kNo, kNo, 9, kNo, kNo, 0, kNo, kNo, 3, kNo, kNo}},
    {"by group first",
     {0, 1, 2, 0, 1, 3, 1, 0, 4, 1, 0, 5},
     {1, 0, 0, 1},
     {9, kNo, kNo, 6, kNo, kNo, 3, kNo, kNo, 0, kNo, kNo}},
};

TEST(DualGraph, PairsEdgesByTheStatedRule) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    EXPECT_EQ(make_dual_graph({c.triangles, c.group, 6}).opposite, c.opposite);
  }
}

RC_GTEST_PROP(DualGraph, OppositesRunTheOtherWayInTheSameGroup, (std::uint32_t seed)) {
  const test::StripMesh mesh = test::strip_mesh(test::random_soup(seed, 12, 200));
  const DualGraph graph = make_dual_graph(mesh.input());
  for (Index h = 0; h < graph.half_edge_count(); ++h) {
    const Index o = graph.opposite[h];
    if (o == kNone) continue;
    RC_ASSERT(graph.opposite[o] == h);
    RC_ASSERT(triangle_of(o) != triangle_of(h));
    RC_ASSERT(mesh.group[triangle_of(o)] == mesh.group[triangle_of(h)]);
    RC_ASSERT(mesh.triangles[o] == mesh.triangles[next_in_triangle(h)]);
    RC_ASSERT(mesh.triangles[h] == mesh.triangles[next_in_triangle(o)]);
  }
}

}  // namespace
}  // namespace pstrips
