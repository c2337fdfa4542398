#include "codecs/filter/derived_strips.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

constexpr Index kR = kRestart;
using Corners = std::vector<Index>;
using Triples = std::vector<std::array<Index, 3>>;

Index same(Index wedge) { return wedge; }

/// Each from its lowest wedge on, in ascending order.
Triples sorted(Triples triangles) {
  for (auto& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
  std::ranges::sort(triangles);
  return triangles;
}

Triples triangles_of(const DisplayStrips& strips) {
  Triples out;
  for_each_triangle(strips, same, [&](Index a, Index b, Index c) { out.push_back({a, b, c}); });
  return out;
}

Triples triples_of(const Corners& corners) {
  Triples out;
  for (std::size_t i = 0; i < corners.size(); i += 3)
    out.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return out;
}

double indices_a_triangle(const test::StripMesh& mesh) {
  const DisplayStrips strips = derive_strips(mesh.triangles, mesh.group, mesh.wedge_count);
  EXPECT_EQ(sorted(triangles_of(strips)), sorted(triples_of(mesh.triangles)));
  return 3 * static_cast<double>(strips.size()) / static_cast<double>(mesh.triangles.size());
}

struct Case {
  const char* name;
  Corners corners, group;
  DisplayStrips strips;
};

// Worked out by hand from spec/compact.md.
const Case kCases[] = {
    {"nothing", {}, {}, {}},
    {"one", {4, 1, 2}, {}, {4, 1, 2}},
    {"two", {0, 1, 2, 2, 1, 3}, {}, {0, 1, 2, 3}},
    {"two that are wound against each other", {0, 1, 2, 1, 2, 3}, {}, {0, 1, 2, kR, 1, 2, 3}},
    {"two groups", {0, 1, 2, 2, 1, 3}, {0, 1}, {0, 1, 2, kR, 2, 1, 3}},
    {"a fan swaps", {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5}, {}, {1, 2, 0, 3, 0, 4, 5}},
};

TEST(DerivedStrips, ByExample) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    EXPECT_EQ(derive_strips(c.corners, c.group, 6), c.strips);
  }
}

// Few wedges, so that edges have many triangles, some of them twice.
RC_GTEST_PROP(DerivedStrips, ShowEachTriangleOnceGroupAfterGroup, ()) {
  const auto wedges = *rc::gen::inRange<Index>(3, 12);
  const auto count = *rc::gen::inRange<std::size_t>(0, 40);
  Corners corners;
  std::vector<Index> group = *rc::gen::container<std::vector<Index>>(
      count, rc::gen::inRange<Index>(0, *rc::gen::inRange<Index>(1, 4)));
  std::ranges::sort(group);
  for (std::size_t t = 0; t < count; ++t) {
    const Index a = *rc::gen::inRange<Index>(0, wedges), b = *rc::gen::inRange<Index>(1, wedges),
                c = *rc::gen::inRange<Index>(1, wedges);
    if (b == c) {
      group.pop_back();
      continue;
    }
    corners.insert(corners.end(), {a, (a + b) % wedges, (a + c) % wedges});
  }
  const DisplayStrips strips = derive_strips(corners, group, wedges);
  const Triples shown = triangles_of(strips);
  RC_ASSERT(sorted(shown) == sorted(triples_of(corners)));
  RC_ASSERT(strips.size() <= 4 * shown.size());
  std::size_t first = 0;
  for (Index g = 0; g < 4; ++g) {
    const auto size = static_cast<std::size_t>(std::ranges::count(group, g));
    const auto part = [&](const Triples& all) {
      return sorted(Triples(all.begin() + static_cast<std::ptrdiff_t>(first),
                            all.begin() + static_cast<std::ptrdiff_t>(first + size)));
    };
    RC_ASSERT(part(shown) == part(triples_of(corners)));
    first += size;
  }
}

TEST(DerivedStrips, AreLongOnOrderlyMeshes) {
  EXPECT_LT(indices_a_triangle(test::strip_mesh(test::torus(40, 30))), 1.1);
  EXPECT_LT(indices_a_triangle(test::strip_mesh(test::grid(50))), 1.1);
}

// A million triangles around one edge, and around one vertex: no search through lists.
TEST(DerivedStrips, TakeLinearTimeWhateverTheTriangles) {
  constexpr Index kMany = 1'000'000;
  Corners edge, fan;
  for (Index t = 0; t < kMany; ++t) {
    edge.insert(edge.end(), {0, 1, t + 2});
    fan.insert(fan.end(), {0, t + 1, t + 2});
  }
  EXPECT_EQ(derive_strips(edge, {}, kMany + 2).size(), 4 * kMany - 1);
  EXPECT_LE(derive_strips(fan, {}, kMany + 2).size(), 2 * kMany + 1);
}

// A level leaves out what has no three vertices, and sorts what its records mix.
TEST(DerivedStrips, OfALevelAreOfItsGroups) {
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::triangles;
  mesh.single_wedges = false;
  mesh.groups.resize(2);
  mesh.group_entries = {6, 6};
  mesh.base_vertices = 4;
  mesh.base_wedges = 5;
  mesh.base_wedge_vertex = {0, 1, 2, 3, 0};
  mesh.base_map = {0, 1, 2, 2, 1, 3, 0, 4, 2, 1, 0, 3};
  mesh.triangle_group = {1, 0, 0, 1};
  const Level level(mesh);
  EXPECT_EQ(derive_strips(level.view()), (DisplayStrips{2, 1, 3, kR, 2, 0, 1, 3}));
}

}  // namespace
}  // namespace pstrips
