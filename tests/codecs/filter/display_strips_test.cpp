#include "codecs/filter/display_strips.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>

#include "codecs/filter/restrip.h"
#include "codecs/stripify/stripify.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

constexpr Index kR = kRestart;
using Map = std::vector<Index>;

// All triangles, lowest wedge first, in ascending order.
std::vector<std::array<Index, 3>> triangles_of(const Map& map, const Map& wedge_vertex) {
  std::vector<std::array<Index, 3>> out;
  for_each_triangle(
      map, [&](Index w) { return wedge_vertex.empty() ? w : wedge_vertex[w]; },
      [&](Index a, Index b, Index c) {
        std::array<Index, 3> triangle{a, b, c};
        std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
        out.push_back(triangle);
      });
  std::ranges::sort(out);
  return out;
}

struct Case {
  const char* name;
  const char* filter;
  Map map, wedge_vertex, display;
};

// Fig. 2 (e) and 8 of [Kim04] among them; the paper's own display strips of Fig. 8 lose the winding
// of the last two triangles, and STSS's has a triangle too many, so ours are longer.
const Map kFigure8{615, 615, 502, 615, 502, 615, 206, 620, 206, 620, 620, 620, 620,
                   620, 580, 66,  580, 66,  580, 66,  761, 761, 761, 761, 258, 761};
const Case kCases[] = {
    {"nothing", "dtfs", {}, {}, {}},
    {"a lone edge", "dtfs", {1, 2}, {}, {}},
    {"figure 2 (e)", "stss", {3, 4, 3, 4, 3, 6, 3, 6}, {}, {3, 4, 3, 6}},
    {"figure 2 (e)", "dtfs", {3, 4, 3, 4, 3, 6, 3, 6}, {}, {4, 4, 3, 6}},
    {"figure 8",
     "stss",
     kFigure8,
     {},
     {615, 615, 502, 615, 206, 620, 620, 620, 580, 66, 761, 761, 258, 761}},
    {"figure 8", "dtfs", kFigure8, {}, {502, 615, 206, 620, kR, 620, 620, 580, 66, 761}},
    {"regular", "dtfs", {0, 1, 2, 1, 2, 3}, {}, {0, 1, 2, 3}},
    {"swap", "dtfs", {0, 1, 2, 1, 3}, {}, {0, 1, 2, 1, 3}},
    {"split", "dtfs", {0, 1, 2, 2, 3, 4}, {}, {0, 1, 2, kR, 2, 2, 3, 4}},
    {"starts clockwise", "dtfs", {0, 0, 1, 2, 3}, {}, {0, 0, 1, 2, 3}},
    {"conflicting winding splits", "dtfs", {0, 1, 2, 1, 1, 2, 3}, {}, {0, 1, 2, kR, 1, 2, 3}},
    {"seam splits", "dtfs", {0, 1, 2, 1, 5, 3}, {0, 1, 2, 3, 9, 2}, {0, 1, 2, kR, 1, 1, 5, 3}},
    {"other wedges of a vertex are degenerate", "dtfs", {0, 1, 2, 3}, {0, 1, 2, 2}, {0, 1, 2}},
    {"collapsed strips vanish", "stss", {1, 1, 1, 1, kR, 2, 3, 2, 3, kR, 0, 1, 2}, {}, {0, 1, 2}},
    {"collapsed strips vanish", "dtfs", {1, 1, 1, 1, kR, 2, 3, 2, 3, kR, 0, 1, 2}, {}, {0, 1, 2}},
    {"everything stays", "none", {1, 1, 1, kR, 0, 1, 2}, {}, {1, 1, 1, kR, 0, 1, 2}},
};

TEST(DisplayFilters, ByExample) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(testing::Message() << c.filter << ": " << c.name);
    const Map display = filter_strips(c.map, c.wedge_vertex, *find_display_filter(c.filter));
    EXPECT_EQ(display, c.display);
    EXPECT_EQ(triangles_of(display, c.wedge_vertex), triangles_of(c.map, c.wedge_vertex));
  }
}

TEST(DisplayCost, CountsRestartsApart) {
  const DisplayCost cost = display_cost(Map{0, 1, 2, kR, 3, 4, 5, 6});
  EXPECT_EQ(cost.vertices_sent, 7u);
  EXPECT_EQ(cost.restarts, 1u);
}

// Few different wedges, so that every pattern of repetition comes up.
RC_GTEST_PROP(DisplayFilters, KeepTheTrianglesOfAnyMap, ()) {
  const auto wedges = *rc::gen::inRange<Index>(1, 9);
  const auto wedge_vertex = *rc::gen::element(
      Map{}, *rc::gen::container<Map>(wedges, rc::gen::inRange<Index>(0, wedges)));
  const Map map = *rc::gen::container<Map>(rc::gen::weightedOneOf<Index>(
      {{12, rc::gen::inRange<Index>(0, wedges)}, {1, rc::gen::just(kR)}}));
  const auto expected = triangles_of(map, wedge_vertex);
  for (const NamedFilter& filter : display_filters()) {
    RC_LOG() << filter.name;
    const Map display = filter_strips(map, wedge_vertex, filter.filter);
    RC_ASSERT(triangles_of(display, wedge_vertex) == expected);
    const DisplayCost cost = display_cost(display);
    if (filter.name == "dtfs") RC_ASSERT(cost.vertices_sent <= 4 * expected.size());
    if (filter.name == "stss") RC_ASSERT(cost.vertices_sent <= map.size());
  }
  const Map display = restrip(map, wedge_vertex);
  RC_ASSERT(triangles_of(display, wedge_vertex) == expected);
  RC_ASSERT(display_cost(display).vertices_sent <= 3 * expected.size());
}

// The strips of a mesh, with vertices merged at random as collapses do.
RC_GTEST_PROP(DisplayFilters, KeepTheTrianglesOfCollapsedStrips, (std::uint32_t seed)) {
  const test::StripMesh mesh = test::strip_mesh(test::torus(8, 9));
  Map map = find_stripifier("sgi-strips")->run(mesh.input(), {});
  Map merged(mesh.wedge_count);
  for (Index w = 0; w < merged.size(); ++w)
    merged[w] = (seed + w * w) % 3 == 0 ? w - w % (1 + seed % 7) : w;
  for (Index& entry : map)
    if (entry != kR) entry = merged[entry];
  const auto expected = triangles_of(map, {});
  for (const NamedFilter& filter : display_filters()) {
    RC_LOG() << filter.name;
    RC_ASSERT(triangles_of(filter_strips(map, {}, filter.filter), {}) == expected);
  }
  RC_ASSERT(triangles_of(restrip(map, {}), {}) == expected);
}

}  // namespace
}  // namespace pstrips
