// The face table of the compact profile: what joins give, what is listed, and broken runs.

#include "formats/pstrip/payload/compact/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pstrips {
namespace {

/// side × side quads, each two triangles of the base; every third one is left as triangles.
ProgressiveMesh quads(Index side, bool with_triangles) {
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::triangles;
  mesh.single_wedges = true;
  mesh.groups.resize(1);
  mesh.vertices = mesh.wedges = mesh.base_vertices = mesh.base_wedges = (side + 1) * (side + 1);
  FaceTable& table = mesh.faces;
  table.first = table.replaced_first = {0};
  for (Index i = 0; i < side * side; ++i) {
    const Index a = i / side * (side + 1) + i % side, b = a + 1, c = b + side + 1, d = c - 1;
    mesh.base_map.insert(mesh.base_map.end(), {a, b, c, a, c, d});
    if (with_triangles && i % 3 == 0) continue;
    // The first half-edge that is not joined starts at a.
    table.corners.insert(table.corners.end(), {a, b, c, d});
    table.first.push_back(static_cast<Index>(table.corners.size()));
    table.group.push_back(0);
    table.replaced.insert(table.replaced.end(), {2 * i, 2 * i + 1});
    table.replaced_first.push_back(static_cast<Index>(table.replaced.size()));
  }
  mesh.triangles = static_cast<Index>(mesh.base_map.size() / 3);
  return mesh;
}

void add_face(FaceTable& table, std::vector<Index> corners, Index group,
              std::vector<Index> replaced) {
  table.corners.insert(table.corners.end(), corners.begin(), corners.end());
  table.first.push_back(static_cast<Index>(table.corners.size()));
  table.group.push_back(group);
  table.replaced.insert(table.replaced.end(), replaced.begin(), replaced.end());
  table.replaced_first.push_back(static_cast<Index>(table.replaced.size()));
}

void expect_back(const ProgressiveMesh& mesh, const CodedFaces& coded) {
  ProgressiveMesh read = mesh;
  read.faces = {};
  const auto ok = read_faces(coded.run, coded.listed, read);
  ASSERT_TRUE(ok) << ok.error().message;
  EXPECT_EQ(read.faces, mesh.faces);
}

TEST(CompactFaces, OfQuadsTakeLittle) {
  const ProgressiveMesh mesh = quads(40, false);
  const CodedFaces coded = code_faces(mesh);
  EXPECT_EQ(coded.listed, 0u);
  EXPECT_LT(coded.run.size(), 60u);  // of 1600 quads that all have the same diagonal
  expect_back(mesh, coded);
  const ProgressiveMesh mixed = quads(40, true);
  EXPECT_EQ(code_faces(mixed).listed, 0u);
  expect_back(mixed, code_faces(mixed));
}

TEST(CompactFaces, OfAnyKindComeBack) {
  ProgressiveMesh mesh = quads(5, true);
  mesh.groups.resize(3);
  mesh.triangle_group.assign(mesh.triangles, 0);
  add_face(mesh.faces, {}, 0, {});
  add_face(mesh.faces, {7}, 2, {});
  add_face(mesh.faces, {7, 8}, 2, {});
  add_face(mesh.faces, {3, 3, 35}, 1, {0, 1});
  add_face(mesh.faces, std::vector<Index>(40, 5), 0, {6});
  add_face(mesh.faces, {0xffff'fff0, 0}, 0, {0xffff'ffff});  // no index: others refuse it
  const CodedFaces coded = code_faces(mesh);
  EXPECT_EQ(coded.listed, 6u);
  expect_back(mesh, coded);
}

TEST(CompactFaces, InAnotherOrderAreListed) {
  ProgressiveMesh mesh = quads(5, false);
  std::rotate(mesh.faces.corners.begin(), mesh.faces.corners.begin() + 4, mesh.faces.corners.end());
  std::rotate(mesh.faces.replaced.begin(), mesh.faces.replaced.begin() + 2,
              mesh.faces.replaced.end());
  EXPECT_EQ(code_faces(mesh).listed, 1u);  // the last one, whose triangles come first
  expect_back(mesh, code_faces(mesh));
  ProgressiveMesh turned = quads(5, false);
  std::rotate(turned.faces.corners.begin(), turned.faces.corners.begin() + 1,
              turned.faces.corners.begin() + 4);
  EXPECT_EQ(code_faces(turned).listed, 25u);
  expect_back(turned, code_faces(turned));
}

TEST(CompactFaces, OfBrokenRunsAreRefused) {
  ProgressiveMesh mesh = quads(8, true);
  add_face(mesh.faces, {7, 8, 11}, 0, {0});
  const CodedFaces coded = code_faces(mesh);
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    Bytes run = coded.run;
    run[random() % run.size()] ^= std::byte{1} << random() % 8;
    if (i % 4 == 0) run.resize(random() % run.size());
    ProgressiveMesh read = mesh;
    if (!read_faces(run, coded.listed + i % 3, read)) ++refused;
  }
  EXPECT_GT(refused, 1990);
  // Faces that are announced take bits: a short run is no reason to make room for many.
  ProgressiveMesh read = mesh;
  EXPECT_FALSE(read_faces(coded.run, 0xffff'ffff, read));
}

}  // namespace
}  // namespace pstrips
