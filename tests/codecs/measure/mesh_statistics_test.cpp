#include "codecs/measure/mesh_statistics.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tests/support/meshes.h"

namespace pstrips {
namespace {

Mesh mesh_of(Index vertices, std::vector<Index> corners, std::vector<Index> face_first = {}) {
  std::vector<float> positions(std::size_t{3} * vertices, 0);
  Mesh mesh = test::triangle_mesh(std::move(positions), std::move(corners));
  mesh.face_first = std::move(face_first);
  return mesh;
}

TEST(MeshStatistics, CountsEachKind) {
  const struct {
    const char* name;
    Mesh mesh;
    MeshStatistics expected;
  } kRows[] = {
      {"nothing", mesh_of(0, {}), {}},
      {"torus", test::torus(6, 5), {.components = 1}},
      {"isolated", mesh_of(5, {0, 1, 2}), {.isolated_vertices = 2, .components = 1}},
      {"fin", mesh_of(5, {0, 1, 2, 1, 0, 3, 0, 1, 4}), {.non_manifold_edges = 1, .components = 1}},
      {"bow_tie", mesh_of(5, {0, 1, 2, 2, 3, 4}), {.non_manifold_vertices = 1, .components = 1}},
      {"three_fans",
       mesh_of(7, {0, 1, 2, 0, 3, 4, 0, 5, 6}),
       {.non_manifold_vertices = 1, .components = 1}},
      {"doubled", mesh_of(3, {0, 1, 2, 1, 2, 0}), {.duplicate_faces = 1, .components = 1}},
      {"both_sides", mesh_of(3, {0, 1, 2, 2, 1, 0}), {.duplicate_faces = 1, .components = 1}},
      {"three_times",
       mesh_of(3, {0, 1, 2, 1, 2, 0, 2, 1, 0}),
       {.non_manifold_edges = 3, .duplicate_faces = 2, .components = 1}},
      {"degenerate", mesh_of(3, {0, 1, 1, 2, 2, 2}), {.degenerate_faces = 2, .components = 2}},
      {"quad_and_pentagon",
       mesh_of(9, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 4, 9}),
       {.other_faces = 2, .components = 2}},
      {"two_corners", mesh_of(2, {0, 1}, {0, 2}), {.other_faces = 1, .components = 1}},
      {"no_corners", mesh_of(1, {}, {0, 0}), {.isolated_vertices = 1, .other_faces = 1}},
  };
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.name);
    EXPECT_EQ(mesh_statistics(row.mesh), row.expected);
  }
}

TEST(MeshStatistics, LinesAndPointsAreNoPolygons) {
  Mesh mesh = mesh_of(6, {0, 1, 2, 3, 4, 5});
  mesh.groups[0].kind = FaceKind::lines;
  EXPECT_EQ(mesh_statistics(mesh), (MeshStatistics{.other_faces = 2, .components = 2}));
}

TEST(MeshStatistics, FindsWhatIsNotFinite) {
  Mesh mesh = test::grid(3);
  set_component(mesh.position, 1, 2, std::nan(""));
  set_component(mesh.position, 5, 0, -std::numeric_limits<double>::infinity());
  set_component(mesh.position, 6, 0, -0.0);
  EXPECT_EQ(mesh_statistics(mesh).non_finite_vertices, 2u);
}

TEST(MeshStatistics, TopologyIsByVertexNotByWedge) {
  EXPECT_EQ(mesh_statistics(test::cube(true)), mesh_statistics(test::cube(false)));
  EXPECT_EQ(mesh_statistics(test::cube(true)), MeshStatistics{.components = 1});
}

// The definitions, word for word.
MeshStatistics slow_statistics(const Mesh& mesh) {
  MeshStatistics out;
  std::map<std::set<Index>, std::vector<Index>> edges;
  std::set<std::multiset<Index>> seen;
  std::vector<std::set<Index>> faces_at(mesh.vertex_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::vector<Index> loop;
    for (const Index w : mesh.face(f)) loop.push_back(mesh.vertex_of(w));
    const std::multiset<Index> all(loop.begin(), loop.end());
    if (loop.size() != 3) ++out.other_faces;
    if (!seen.insert(all).second) ++out.duplicate_faces;
    if (std::set<Index>(loop.begin(), loop.end()).size() < loop.size()) {
      ++out.degenerate_faces;
      continue;
    }
    for (std::size_t k = 0; k < loop.size(); ++k) {
      edges[{loop[k], loop[(k + 1) % loop.size()]}].push_back(f);
      faces_at[loop[k]].insert(f);
    }
  }
  for (const auto& [edge, faces] : edges)
    if (faces.size() > 2) ++out.non_manifold_edges;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (faces_at[v].empty()) continue;
    std::set<Index> fan, next{*faces_at[v].begin()};
    while (!next.empty()) {
      const Index f = *next.begin();
      next.erase(next.begin());
      if (!fan.insert(f).second) continue;
      for (const auto& [edge, faces] : edges)
        if (edge.contains(v) && std::ranges::find(faces, f) != faces.end())
          next.insert(faces.begin(), faces.end());
    }
    if (fan.size() < faces_at[v].size()) ++out.non_manifold_vertices;
  }
  return out;
}

RC_GTEST_PROP(MeshStatistics, AgreesWithItsDefinitionOnAnySoup, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(1, 30);
  const auto faces = *rc::gen::inRange<Index>(0, 50);
  const Mesh mesh = seed % 2 ? test::random_soup(seed, vertices, faces)
                             : test::polygon_soup(seed, vertices, faces);
  MeshStatistics ours = mesh_statistics(mesh);
  RC_ASSERT(ours.components + ours.isolated_vertices <= vertices);
  ours.components = ours.isolated_vertices = 0;
  RC_ASSERT(ours == slow_statistics(mesh));
}

TEST(MeshStatistics, TakesAVertexOfAHundredThousandFaces) {
  constexpr Index kFaces = 100'000;
  std::vector<Index> corners;
  for (Index i = 1; i <= kFaces; ++i) corners.insert(corners.end(), {0, i, i % kFaces + 1});
  EXPECT_EQ(mesh_statistics(mesh_of(kFaces + 1, corners)), MeshStatistics{.components = 1});
}

TEST(MeshStatistics, CountsTheSameOnSeveralThreads) {
  const Mesh mesh = test::random_soup(1, 40'000, 300'000);
  EXPECT_GT(mesh_statistics(mesh).non_manifold_vertices, 30'000u);
  EXPECT_EQ(mesh_statistics(mesh, 3), mesh_statistics(mesh));
}

}  // namespace
}  // namespace pstrips
