#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "codecs/stripify/tetra_multi_path.h"
#include "tests/support/tetra_meshes.h"

namespace pstrips {
namespace {

using Vertices = std::vector<Index>;

TetraStrips strips_of(const TetraMesh& mesh, const StripOptions& options = {}) {
  return tetra_multi_path(mesh.tetrahedra, mesh.vertex_count(), options);
}

// A row of tetrahedra in which each four vertices in a row are one.
Vertices row(Index count) {
  Vertices out;
  for (Index i = 0; i < count; ++i) out.insert(out.end(), {i, i + 1, i + 2, i + 3});
  return out;
}

struct Case {
  const char* name;
  Vertices tetrahedra;
  std::uint64_t strips;
};

const Case kCases[] = {
    {"nothing", {}, 0},
    {"one", {0, 1, 2, 3}, 1},
    {"one with a vertex twice", {0, 1, 1, 3}, 1},
    {"two", {0, 1, 2, 3, 0, 2, 1, 4}, 1},
    {"two that are turned over against each other", {0, 1, 2, 3, 0, 1, 2, 4}, 2},
    {"two without a common face", {0, 1, 2, 3, 2, 3, 4, 5}, 2},
    {"back to back", {0, 1, 2, 3, 0, 2, 1, 3}, 1},
    {"three at a face", {0, 1, 2, 3, 0, 2, 1, 4, 0, 2, 1, 5}, 2},
    {"one again and again", {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, 3},
    {"a row", row(50), 1},
    {"a ring around an edge", {0, 1, 2, 3, 0, 1, 3, 4, 0, 1, 4, 5, 0, 1, 5, 2}, 1},
};

TEST(TetraMultiPath, OfFewTetrahedra) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const TetraStrips strips = tetra_multi_path(c.tetrahedra, 60, {});
    EXPECT_EQ(find_tetra_strip_fault(c.tetrahedra, strips), "");
    EXPECT_EQ(tetra_strip_stats(strips).strips, c.strips);
  }
}

TEST(TetraMultiPath, MakesLongStripsOfDelaunayMeshes) {
  const TetraMesh mesh = test::delaunay_tetrahedra(1, 1000);
  const TetraStrips strips = strips_of(mesh);
  EXPECT_EQ(find_tetra_strip_fault(mesh.tetrahedra, strips), "");
  const TetraStripStats stats = tetra_strip_stats(strips);
  EXPECT_GT(stats.tetrahedra, 6000u);
  EXPECT_GE(stats.tetrahedra, 400 * stats.strips);
  EXPECT_EQ(stats.entries, stats.tetrahedra + 3 * stats.strips);
  EXPECT_EQ(stats.singletons, 0u);
  // Without moving ends, as published: 106 to 186 on meshes of this size. [Vanecek05 table 6.2]
  const TetraStripStats plain = tetra_strip_stats(strips_of(mesh, {.effort = 0}));
  EXPECT_GE(plain.tetrahedra, 106 * plain.strips);
  EXPECT_LT(stats.strips, plain.strips);
}

RC_GTEST_PROP(TetraMultiPath, CoversRandomTetrahedraOnce, (std::uint32_t seed)) {
  const auto vertices = *rc::gen::inRange<Index>(1, 12);
  const auto count = *rc::gen::inRange<Index>(0, 200);
  const TetraMesh mesh = test::random_tetrahedra(seed, vertices, count);
  const TetraStrips strips = strips_of(mesh, {.seed = seed, .effort = 3});
  RC_ASSERT(find_tetra_strip_fault(mesh.tetrahedra, strips) == "");
  RC_ASSERT(strips == strips_of(mesh, {.seed = seed, .effort = 3}));
}

TEST(TetraMultiPath, StopsWhenAsked) {
  const TetraMesh mesh = test::delaunay_tetrahedra(2, 200);
  int asked = 0;
  const TetraStrips strips = strips_of(mesh, {.effort = 1000, .stop = [&] { return ++asked > 3; }});
  EXPECT_EQ(asked, 4);
  EXPECT_EQ(find_tetra_strip_fault(mesh.tetrahedra, strips), "");
}

// King's own example and one for each place. [King01; Vanecek05 figure 6.2]
TEST(TetraStrips, AreReadAsKingHasThem) {
  const TetraStrips strips{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
                           {0, 0, 0, 0, 1, 3, 2, 4, 0, 0, 0, 0}};
  std::vector<Tetra> found;
  std::vector<bool> first;
  for_each_tetra(strips, [&](const Tetra& t, bool is_first) {
    found.push_back(t);
    first.push_back(is_first);
  });
  // 2 goes for 6, then 6 for 7: both turn the window over.
  const std::vector<Tetra> expected{{0, 1, 2, 3}, {1, 2, 3, 4}, {1, 2, 4, 5},
                                    {4, 1, 5, 6}, {1, 4, 5, 7}, {8, 9, 10, 11}};
  EXPECT_EQ(found, expected);
  EXPECT_EQ(first, (std::vector<bool>{true, false, false, false, false, true}));
}

struct Fault {
  const char* fault;
  TetraStrips strips;
};

TEST(TetraStrips, AreCheckedByThemselves) {
  const Vertices two{0, 1, 2, 3, 0, 2, 1, 4};
  const Fault kFaults[] = {
      {"", {{3, 0, 2, 1, 4}, {0, 0, 0, 0, 1}}},
      {"", {{0, 1, 2, 3, 2, 1, 0, 4}, {0, 0, 0, 0, 0, 0, 0, 0}}},
      {"a tetrahedron is turned over", {{3, 0, 1, 2, 4}, {0, 0, 0, 0, 1}}},
      {"a tetrahedron is missing", {{3, 0, 2, 1}, {0, 0, 0, 0}}},
      {"a tetrahedron is missing", {{3, 0, 2, 1, 5}, {0, 0, 0, 0, 1}}},
      {"a tetrahedron is there too often", {{3, 0, 2, 1, 4, 3}, {0, 0, 0, 0, 1, 4}}},
      {"a strip is cut short or a place is none of four", {{3, 0, 2}, {0, 0, 0}}},
      {"a strip is cut short or a place is none of four", {{3, 0, 2, 1, 4}, {0, 0, 0, 1, 1}}},
      {"a strip is cut short or a place is none of four", {{3, 0, 2, 1, 4}, {0, 0, 0, 0, 5}}},
      {"a strip is cut short or a place is none of four", {{4}, {1}}},
  };
  for (const Fault& f : kFaults) EXPECT_EQ(find_tetra_strip_fault(two, f.strips), f.fault);
}

}  // namespace
}  // namespace pstrips
