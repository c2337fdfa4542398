#include "tests/support/appearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/meshes.h"
#include "tests/support/seamed_meshes.h"

namespace pstrips::test {
namespace {

constexpr Index kSize = 64;
const Camera kAbove{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, 1};

// A square from -1/2 to 1/2 with the texture once over it.
RenderMesh square() {
  const auto corner = [](double x, double y) {
    return RenderMesh::Corner{{x, y, 0}, {0, 0, 1}, {x + 0.5, y + 0.5}};
  };
  constexpr double h = 0.5;
  return {
      {corner(-h, -h), corner(h, -h), corner(h, h), corner(-h, -h), corner(h, h), corner(-h, h)},
      {0, 0}};
}

template <class Change>
RenderMesh changed(Change&& change) {
  RenderMesh mesh = square();
  for (RenderMesh::Corner& c : mesh.corners) change(c);
  return mesh;
}

Appearance compared(const RenderMesh& other) {
  const Texture checks = checker_texture(64, 8);
  return compare_appearance(square(), other, std::span(&checks, 1), std::span(&kAbove, 1), kSize);
}

TEST(Appearance, OfTheSameMeshDiffersInNothing) {
  const Index texture = 0;
  const RenderMesh mesh = render_mesh(cube_sphere(8, 2), std::span(&texture, 1));
  const Texture checks = checker_texture(64, 8);
  const auto cameras = icosahedron_cameras({0, 0, 0}, 1.2);
  const Appearance a = compare_appearance(mesh, mesh, std::span(&checks, 1), cameras, kSize);
  for (const double x : {a.silhouette, a.depth, a.unlit, a.face_lit, a.vertex_lit, a.uv, a.stretch})
    EXPECT_EQ(x, 0);
  for (const double x : {a.face_normal, a.vertex_normal, a.structure}) EXPECT_NEAR(x, 0, 1e-5);
}

TEST(Appearance, TellsDepth) {
  const Appearance a = compared(changed([](auto& c) { c.position[2] = 0.125; }));
  EXPECT_DOUBLE_EQ(a.depth, 0.125);
  EXPECT_EQ(a.unlit, 0);
}

TEST(Appearance, TellsTheOutline) {
  const Appearance a = compared(changed([](auto& c) { c.position[0] += 0.25; }));
  EXPECT_DOUBLE_EQ(a.silhouette, 0.5);
  EXPECT_GT(a.unlit, 0.05);
  EXPECT_GT(a.structure, 0.1);
}

TEST(Appearance, TellsNormals) {
  constexpr double kTilt = std::numbers::pi / 6;
  const Appearance a = compared(changed([](auto& c) {
    c.position[2] = c.position[0] * std::tan(kTilt);
    c.normal = {std::sin(kTilt / 2), 0, std::cos(kTilt / 2)};
  }));
  EXPECT_NEAR(a.face_normal, 30, 1e-9);
  EXPECT_NEAR(a.vertex_normal, 15, 1e-9);
  EXPECT_EQ(a.unlit, 0);
  EXPECT_GT(a.face_lit, a.vertex_lit);
}

TEST(Appearance, TellsWhereTheTextureIs) {
  EXPECT_NEAR(compared(changed([](auto& c) { c.uv[0] += 0.03; })).uv, 0.03, 1e-12);
  EXPECT_NEAR(compared(changed([](auto& c) { c.uv[0] += 0.4; })).uv, kMaxUv, 1e-12);
}

TEST(Appearance, ComparesTexturesOfTheSameSurface) {
  const auto moved = [](double depth) {
    return changed([depth](auto& c) {
      c.position[2] = depth;
      c.uv = {c.uv[0] / 4, 0.4 + c.uv[1] / 4};
    });
  };
  EXPECT_GT(compared(moved(0.5 * kSameSurface)).uv, 0.05);
  EXPECT_NEAR(compared(moved(0.5 * kSameSurface)).stretch, 2, 1e-12);
  EXPECT_EQ(compared(moved(2 * kSameSurface)).uv, 0);
  EXPECT_EQ(compared(moved(2 * kSameSurface)).stretch, 0);
}

TEST(Appearance, TellsHowTheTextureIsStretched) {
  EXPECT_NEAR(compared(changed([](auto& c) {
                c.uv = {c.uv[0] / 4, c.uv[1] / 4};
              })).stretch,
              2, 1e-12);
  EXPECT_DOUBLE_EQ(compared(changed([](auto& c) { c.uv[0] = 0.5; })).stretch, kMaxStretch);
  EXPECT_DOUBLE_EQ(compared(changed([](auto& c) { c.uv[0] = -c.uv[0]; })).stretch, kMaxStretch);
}

TEST(Stretch, IsThatOfEachDirection) {
  const Stretch same = stretch(square());
  EXPECT_DOUBLE_EQ(same.l2, 1);
  EXPECT_DOUBLE_EQ(same.maximum, 1);
  EXPECT_EQ(same.collapsed, 0);
  const Stretch wide = stretch(changed([](auto& c) { c.uv[0] /= 4; }));
  EXPECT_DOUBLE_EQ(wide.l2, std::sqrt((16 + 1) / 2.0));
  EXPECT_DOUBLE_EQ(wide.maximum, 4);
}

TEST(Stretch, LeavesOutWhatHasNoAreaInTheTexture) {
  RenderMesh mesh = square();
  for (std::size_t i = 0; i < 3; ++i) mesh.corners[i].uv = {0.25, 0.25};
  const Stretch s = stretch(mesh);
  EXPECT_DOUBLE_EQ(s.collapsed, 0.5);
  EXPECT_DOUBLE_EQ(s.maximum, 1);
}

}  // namespace
}  // namespace pstrips::test
