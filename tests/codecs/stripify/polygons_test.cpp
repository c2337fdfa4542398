// What holds of every algorithm that takes polygons, and of the faces they work on.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "codecs/stripify/check.h"
#include "codecs/stripify/random.h"
#include "codecs/stripify/stats.h"
#include "codecs/stripify/stripify.h"
#include "tests/support/growth.h"
#include "tests/support/meshes.h"
#include "tests/support/polygon_check.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::find_strip_fault;
using test::PolygonMesh;

PolygonMesh polygons(Index wedge_count, const std::vector<std::vector<Index>>& faces) {
  PolygonMesh mesh;
  mesh.wedge_count = wedge_count;
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
    mesh.group.push_back(0);
  }
  return mesh;
}

PolygonMesh quads(const Mesh& triangles) {
  return test::polygon_mesh(test::joined_to_quads(triangles));
}

PolygonMesh one_polygon(Index corners) {
  std::vector<Index> loop(corners);
  for (Index i = 0; i < corners; ++i) loop[i] = i;
  return polygons(corners, {loop});
}

// A polygon with a quad at each of its edges, closed by another polygon.
PolygonMesh prism(Index sides) {
  std::vector<std::vector<Index>> faces(2);
  for (Index i = 0; i < sides; ++i) {
    const Index j = (i + 1) % sides;
    faces[0].push_back(i);
    faces[1].push_back(2 * sides - 1 - i);
    faces.push_back({j, i, sides + i, sides + j});
  }
  return polygons(2 * sides, faces);
}

// Quads of a grid, every other one with a vertex in the middle that only its two halves share, as
// in figure 7.6 of the thesis.
PolygonMesh halved_quads(Index side) {
  const Mesh grid = test::joined_to_quads(test::grid(side));
  std::vector<std::vector<Index>> faces;
  Index wedges = grid.wedge_count();
  for (Index f = 0; f < grid.face_count(); ++f) {
    const auto q = grid.face(f);
    if (f % 2 == 0) {
      faces.push_back({q.begin(), q.end()});
    } else {
      faces.push_back({q[0], q[1], wedges, q[3]});
      faces.push_back({q[2], q[3], wedges, q[1]});
      ++wedges;
    }
  }
  return polygons(wedges, faces);
}

struct NamedMesh {
  const char* name;
  PolygonMesh mesh;
};

std::vector<NamedMesh> meshes() {
  return {
      {"empty", {}},
      {"isolated wedges only", {{}, {0}, {}, 5}},
      {"one triangle", one_polygon(3)},
      {"one quad", one_polygon(4)},
      {"one polygon", one_polygon(9)},
      {"cube", quads(test::cube(false))},
      {"cube with seams", quads(test::cube(true))},
      {"grid", quads(test::grid(13))},
      {"torus", quads(test::torus(20, 50))},
      {"thin torus", quads(test::torus(3, 3))},
      {"prism", prism(5)},
      {"large prism", prism(40)},
      {"pillow", polygons(4, {{0, 1, 2, 3}, {3, 2, 1, 0}})},
      {"pillow, turned", polygons(4, {{0, 1, 2, 3}, {0, 3, 2, 1}})},
      {"pillow of pentagons", polygons(5, {{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}})},
      {"quad and triangle with two common edges", polygons(4, {{0, 1, 2, 3}, {2, 1, 0}})},
      {"quads with two common edges", halved_quads(8)},
      {"pile of quads", polygons(4, {{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1, 2, 3}})},
      {"soup", test::polygon_mesh(test::polygon_soup(7, 40, 300))},
  };
}

// Two quads in a row and the triangles of the left one's other diagonal.
TEST(PolygonStripCheck, SeesEveryKindOfFault) {
  const PolygonMesh mesh = polygons(7, {{0, 1, 4, 3}, {1, 2, 5, 4}});
  constexpr Index kR = kRestart;
  const std::pair<const char*, std::vector<Index>> kCases[] = {
      {"", {0, 1, 3, 4, kR, 1, 2, 4, 5}},
      {"", {3, 0, 4, 1, kR, 1, 2, 4, 5}},
      {"", {1, 2, 4, 5, kR, 0, 1, 3, 4}},
      {"ends with a restart", {0, 1, 3, 4, kR, 1, 2, 4, 5, kR}},
      {"has an entry that is no wedge", {0, 1, 7, 4, kR, 1, 2, 4, 5}},
      {"has a strip without a triangle", {0, 1, 3, 4, kR, 1, 2, kR, 1, 2, 4, 5}},
      {"has too few triangles", {0, 1, 3, 4, kR, 1, 2, 4}},
      {"has too many triangles", {0, 1, 3, 4, kR, 1, 2, 4, 5, kR, 0, 1, 3}},
      {"has triangles that do not make up the faces", {1, 0, 4, 3, kR, 1, 2, 4, 5}},
      {"has triangles that do not make up the faces", {0, 1, 3, kR, 3, 0, 4, kR, 1, 2, 4, 5}},
      {"has triangles that do not make up the faces", {0, 1, 3, 4, kR, 0, 1, 3, 4}},
      {"has triangles that do not make up the faces", {0, 1, 6, 4, kR, 1, 2, 4, 5}},
  };
  for (const auto& [fault, strips] : kCases) {
    EXPECT_EQ(find_strip_fault(mesh.input(), strips), fault) << testing::PrintToString(strips);
    EXPECT_EQ(find_polygon_strip_fault(mesh.input(), strips).empty(), *fault == 0)
        << testing::PrintToString(strips);
  }
  PolygonMesh parted = mesh;
  parted.group = {0, 1};
  EXPECT_EQ(find_strip_fault(parted.input(), std::vector<Index>{0, 1, 3, 4, 5}),
            "has a strip across groups");
  EXPECT_EQ(find_strip_fault(parted.input(), kCases[2].second),
            "has triangles that do not make up the faces");
}

// Two equal quads may be cut the same way or not.
TEST(PolygonStripCheck, SharesTrianglesOutAmongEqualFaces) {
  const PolygonMesh mesh = polygons(4, {{0, 1, 2, 3}, {1, 2, 3, 0}});
  constexpr Index kR = kRestart;
  EXPECT_EQ(find_strip_fault(mesh.input(), std::vector<Index>{0, 1, 3, 2, kR, 0, 1, 3, 2}), "");
  EXPECT_EQ(find_strip_fault(mesh.input(), std::vector<Index>{0, 1, 3, 2, kR, 3, 0, 2, 1}), "");
  EXPECT_NE(
      find_strip_fault(mesh.input(), std::vector<Index>{0, 1, 3, 2, kR, 0, 1, 2, kR, 1, 2, 3}), "");
}

template <class Test>
void for_each_polygon_stripifier(Test&& run) {
  int count = 0;
  for (const NamedStripifier& stripifier : stripifiers()) {
    if (stripifier.run_polygons == nullptr) continue;
    ++count;
    for (const StripGoal goal : {StripGoal::indices, StripGoal::strips}) {
      SCOPED_TRACE(testing::Message() << stripifier.name << ", goal " << static_cast<int>(goal));
      run(stripifier.run_polygons, StripOptions{.goal = goal});
    }
  }
  EXPECT_GT(count, 0);
}

TEST(PolygonStripifiers, CoverEveryMeshOnce) {
  for_each_polygon_stripifier([](PolygonStripifier stripify, const StripOptions& options) {
    for (auto [name, mesh] : meshes()) {
      SCOPED_TRACE(name);
      EXPECT_EQ(find_strip_fault(mesh.input(), stripify(mesh.input(), options)), "");
      mesh.positions.clear();
      EXPECT_EQ(find_strip_fault(mesh.input(), stripify(mesh.input(), options)), "");
    }
  });
}

RC_GTEST_PROP(PolygonStripifiers, CoverRandomSoupsOnce, (std::uint32_t seed)) {
  const auto vertices = *rc::gen::inRange<Index>(5, 60);
  const auto faces = *rc::gen::inRange<Index>(0, 120);
  const PolygonMesh mesh = test::polygon_mesh(test::polygon_soup(seed, vertices, faces));
  for_each_polygon_stripifier([&](PolygonStripifier stripify, const StripOptions& options) {
    const Strips strips = stripify(mesh.input(), options);
    RC_ASSERT(find_strip_fault(mesh.input(), strips) == "");
    RC_ASSERT(find_polygon_strip_fault(mesh.input(), strips) == "");
    RC_ASSERT(stripify(mesh.input(), options) == strips);
  });
}

TEST(PolygonStripifiers, DoNotCrossSeams) {
  const PolygonMesh mesh = quads(test::cube(true));
  for_each_polygon_stripifier([&](PolygonStripifier stripify, const StripOptions& options) {
    EXPECT_EQ(strip_stats(stripify(mesh.input(), options)).strips, 6u);
  });
}

// Twice the area of a triangle in the plane z = 0.
double area(const PolygonMesh& mesh, Index a, Index b, Index c) {
  const auto x = [&](Index w) { return mesh.positions[3 * std::size_t{w}]; };
  const auto y = [&](Index w) { return mesh.positions[3 * std::size_t{w} + 1]; };
  return (x(b) - x(a)) * (y(c) - y(a)) - (x(c) - x(a)) * (y(b) - y(a));
}

// Faces of `cells` grid cells in a row, in the plane, their corners moved by up to 0.45 of a cell:
// simple, and concave more often than not.
PolygonMesh jittered(std::uint32_t seed, Index side, Index cells) {
  PolygonMesh mesh;
  Random random(seed);
  const Index width = side * cells + 1;
  const auto jitter = [&] { return (random.below(91) - 45.) / 100; };
  for (Index y = 0; y <= side; ++y)
    for (Index x = 0; x < width; ++x) {
      const double dx = jitter(), dy = jitter();
      mesh.positions.insert(mesh.positions.end(), {x + dx, y + dy, 0});
    }
  mesh.wedge_count = width * (side + 1);
  for (Index y = 0; y < side; ++y)
    for (Index x = 0; x + cells < width; x += cells) {
      for (Index i = 0; i <= cells; ++i) mesh.corners.push_back(y * width + x + i);
      for (Index i = cells + 1; i-- > 0;) mesh.corners.push_back((y + 1) * width + x + i);
      mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
      mesh.group.push_back(cells > 1 ? y : 0);  // no two edges to the same neighbour
    }
  return mesh;
}

RC_GTEST_PROP(PolygonStripifiers, DoNotFoldConcaveFaces, (std::uint32_t seed)) {
  for (const Index cells : {1u, 2u, 3u}) {
    const PolygonMesh mesh = jittered(seed, 6, cells);
    for_each_polygon_stripifier([&](PolygonStripifier stripify, const StripOptions& options) {
      const Strips strips = stripify(mesh.input(), options);
      RC_ASSERT(find_strip_fault(mesh.input(), strips) == "");
      RC_ASSERT(find_polygon_strip_fault(mesh.input(), strips) == "");
      for_each_triangle(
          strips, [](Index w) { return w; },
          [&](Index a, Index b, Index c) { RC_ASSERT(area(mesh, a, b, c) > 0); });
    });
  }
}

// Back to back with another one. [Vanecek05 figure 7.6 b]
TEST(PolygonStripifiers, ShowNoTriangleFromBothSides) {
  for (const PolygonMesh& mesh : {halved_quads(12), polygons(4, {{0, 1, 2, 3}, {3, 2, 1, 0}}),
                                  polygons(4, {{0, 1, 2, 3}, {2, 1, 0}, {0, 3, 2}})})
    for_each_polygon_stripifier([&](PolygonStripifier stripify, const StripOptions& options) {
      PolygonInput input = mesh.input();
      input.positions = {};
      std::set<std::array<Index, 3>> seen;
      for_each_triangle(
          stripify(input, options), [](Index w) { return w; },
          [&](Index a, Index b, Index c) {
            std::array<Index, 3> t{a, b, c};
            std::ranges::sort(t);
            EXPECT_TRUE(seen.insert(t).second);
          });
    });
}

StripStats stats_of(const PolygonMesh& mesh, const char* name, StripGoal goal) {
  const Strips strips = find_stripifier(name)->run_polygons(mesh.input(), {.goal = goal});
  EXPECT_EQ(find_strip_fault(mesh.input(), strips), "");
  return strip_stats(strips);
}

// The patch is the whole grid: a strip a row.
TEST(Stripe, CoversAGridOfQuadsRowByRow) {
  for (const char* name : {"stripe-lookahead", "stripe-noswap"}) {
    const StripStats stats = stats_of(quads(test::grid(31)), name, StripGoal::indices);
    EXPECT_EQ(stats.strips, 30u);
    EXPECT_EQ(stats.swaps, 0u);
  }
}

// Ten times fewer strips than STRIPE on surfaces from slices. [Vanecek05 table 7.1]
TEST(QStrip, MakesFewerStripsThanStripe) {
  const PolygonMesh mesh = test::polygon_mesh(test::voxel_torus(80));
  const std::uint64_t strips = stats_of(mesh, "qstrip", StripGoal::strips).strips;
  EXPECT_GE(stats_of(mesh, "stripe-lookahead", StripGoal::indices).strips, 8 * strips);
  EXPECT_GE(stats_of(mesh, "stripe-noswap", StripGoal::indices).strips, 10 * strips);
}

// A straight row of quads needs no swap, a turn one, and the next turn the same way two.
TEST(QStrip, PaysForTurnsAsInTheThesis) {  // [Vanecek05 figure 7.5]
  const auto swaps = [](const std::vector<std::vector<Index>>& faces) {
    return stats_of(polygons(20, faces), "qstrip", StripGoal::indices).swaps;
  };
  EXPECT_EQ(swaps({{0, 1, 2, 3}, {3, 2, 4, 5}, {5, 4, 6, 7}}), 0u);
  EXPECT_EQ(swaps({{0, 1, 2, 3}, {3, 2, 4, 5}, {2, 8, 9, 4}}), 1u);
  // A spiral of five quads: two turns to the same side with one quad between.
  EXPECT_EQ(swaps({{0, 1, 2, 3}, {3, 2, 4, 5}, {2, 8, 9, 4}, {8, 10, 11, 9}, {10, 8, 12, 13}}), 3u);
}

// Quads around one edge.
PolygonMesh book(Index pages) {
  std::vector<std::vector<Index>> quads;
  for (Index i = 0; i < pages; ++i) quads.push_back({i % 2, 1 - i % 2, 2 + 2 * i, 3 + 2 * i});
  return polygons(2 + 2 * pages, quads);
}

// A hub polygon of 160,000 corners among quads, and as many quads around one edge.
TEST(PolygonStripifiers, AreLinearAroundOneFaceAndOneEdge) {
  for (const auto& shape : {prism, book})
    for_each_polygon_stripifier([&](PolygonStripifier stripify, const StripOptions& options) {
      const auto make = [&](Index size) {
        PolygonMesh mesh = shape(size);
        mesh.positions.clear();
        return mesh;
      };
      Strips strips;
      const auto run = [&](const PolygonMesh& mesh) { strips = stripify(mesh.input(), options); };
      EXPECT_TRUE(test::grows_linearly(40'000, make, run));
      const PolygonMesh mesh = make(160'000);
      EXPECT_EQ(strip_stats(strips).triangles, mesh.corners.size() - 2 * mesh.group.size());
    });
}

}  // namespace
}  // namespace pstrips
