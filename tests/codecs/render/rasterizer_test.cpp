#include "codecs/render/rasterizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/appearance.h"
#include "tests/support/meshes.h"

namespace pstrips::test {
namespace {

// From above, 8 pixels for the square from -1 to 1.
constexpr Index kSize = 8;
const Camera kAbove{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, 1};

Point centre_of(Index row, Index column) {
  return {(column + 0.5) / kSize * 2 - 1, 1 - (row + 0.5) / kSize * 2, 0};
}

// The square from -1 to 1 at a height, texture coordinates from 0 to 1.
RenderMesh square(double z, Index texture = 0) {
  const auto corner = [&](double x, double y) {
    return RenderMesh::Corner{{x, y, z}, {0, 0, 1}, {(x + 1) / 2, (y + 1) / 2}};
  };
  return {
      {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, -1), corner(1, 1), corner(-1, 1)},
      {texture, texture}};
}

RenderMesh joined(RenderMesh a, const RenderMesh& b) {
  a.corners.insert(a.corners.end(), b.corners.begin(), b.corners.end());
  a.texture.insert(a.texture.end(), b.texture.begin(), b.texture.end());
  return a;
}

// Each texel another colour.
const Texture kFourColours{2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
const Texture kBlack{1, 1, {{0, 0, 0}}};

TEST(Render, CoversThePixelsWhoseCentresAreInside) {
  RenderMesh half = square(0);
  half.corners.resize(3);  // below the diagonal
  half.texture.resize(1);
  const Picture picture = render(half, std::span(&kBlack, 1), kAbove, kSize);
  ASSERT_EQ(picture.pixels.size(), kSize * kSize);
  for (Index row = 0; row < kSize; ++row)
    for (Index column = 0; column < kSize; ++column) {
      const Point p = centre_of(row, column);
      EXPECT_EQ(picture.pixels[row * kSize + column].is_covered(), p[1] <= p[0])
          << row << ' ' << column;
    }
}

TEST(Render, ShowsTheTextureOnASquare) {
  const Picture picture = render(square(0.25), std::span(&kFourColours, 1), kAbove, kSize);
  for (Index row = 0; row < kSize; ++row)
    for (Index column = 0; column < kSize; ++column) {
      const Pixel& pixel = picture.pixels[row * kSize + column];
      const Point p = centre_of(row, column);
      ASSERT_TRUE(pixel.is_covered());
      EXPECT_DOUBLE_EQ(pixel.depth, -0.25);
      EXPECT_NEAR(pixel.uv[0], (p[0] + 1) / 2, 1e-12);
      EXPECT_NEAR(pixel.uv[1], (p[1] + 1) / 2, 1e-12);
      EXPECT_EQ(pixel.colour, kFourColours.at(pixel.uv));
    }
}

TEST(Render, ShowsWhatIsNearestInAnyOrder) {
  const Texture textures[] = {kBlack, kFourColours};
  const RenderMesh far = square(-0.5, 0), near = square(0.5, 1);
  for (const RenderMesh& mesh : {joined(far, near), joined(near, far)})
    for (const Pixel& pixel : render(mesh, textures, kAbove, kSize).pixels) {
      EXPECT_DOUBLE_EQ(pixel.depth, -0.5);
      EXPECT_EQ(mesh.texture[pixel.triangle], 1u);
    }
}

TEST(Render, TurnsNormalsToTheViewer) {
  Camera below = kAbove;
  below.right = {-1, 0, 0};
  below.toward = {0, 0, -1};
  for (const auto& [camera, from_behind] : {std::pair{kAbove, false}, std::pair{below, true}})
    for (const Pixel& pixel : render(square(0), std::span(&kBlack, 1), camera, kSize).pixels) {
      EXPECT_EQ(pixel.from_behind, from_behind);
      EXPECT_EQ(pixel.face_normal, camera.toward);
      EXPECT_EQ(pixel.vertex_normal, camera.toward);
    }
}

TEST(Render, LeavesOutWhatIsOutsideOrSeenFromTheSide) {
  RenderMesh outside = square(0), upright = square(0);
  for (RenderMesh::Corner& c : outside.corners) c.position[0] += 3;
  for (RenderMesh::Corner& c : upright.corners) c.position = {c.position[0], 0, c.position[1]};
  for (const RenderMesh& mesh : {outside, upright})
    EXPECT_TRUE(std::ranges::none_of(render(mesh, std::span(&kBlack, 1), kAbove, kSize).pixels,
                                     &Pixel::is_covered));
}

TEST(Texture, IsTheMeanBetweenTexelsAndRepeats) {
  EXPECT_EQ(kFourColours.at({0.25, 0.25}), (std::array{1.f, 0.f, 0.f}));
  EXPECT_EQ(kFourColours.at({0.5, 0.25}), (std::array{0.5f, 0.5f, 0.f}));
  EXPECT_EQ(kFourColours.at({0.5, 0.5}), (std::array{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(kFourColours.at({-3.75, 5.25}), kFourColours.at({0.25, 0.25}));
  EXPECT_EQ(kFourColours.halved().at({0.3, 0.8}), (std::array{0.5f, 0.5f, 0.5f}));
}

TEST(Cameras, LookFromAllSides) {
  const auto cameras = icosahedron_cameras({1, 2, 3}, 4);
  for (const Camera& camera : cameras) {
    for (const Point& axis : {camera.right, camera.up, camera.toward})
      EXPECT_NEAR(dot(axis, axis), 1, 1e-12);
    const Point right = cross(camera.up, camera.toward);
    EXPECT_NEAR(dot(right, camera.right), 1, 1e-12);
    // The nearest other corners of an icosahedron are 63.4 degrees away.
    double nearest = -1;
    for (const Camera& other : cameras)
      if (&other != &camera) nearest = std::max(nearest, dot(camera.toward, other.toward));
    EXPECT_NEAR(nearest, 1 / std::sqrt(5), 1e-12);
  }
}

TEST(RenderMesh, HasTheMeshsAttributes) {
  const Index texture = 7;
  const RenderMesh mesh = render_mesh(cube(true), std::span(&texture, 1));
  ASSERT_EQ(mesh.triangle_count(), 12u);
  std::set<Uv> uvs;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const RenderMesh::Corner* const c = &mesh.corners[i - i % 3];
    const Point n = cross(c[1].position - c[0].position, c[2].position - c[0].position);
    EXPECT_EQ(mesh.corners[i].normal, n);  // sides of length 1
    EXPECT_EQ(mesh.texture[i / 3], 7u);
    uvs.insert(mesh.corners[i].uv);
  }
  EXPECT_EQ(uvs, (std::set<Uv>{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
}

TEST(RenderMesh, AveragesNormalsThatTheMeshHasNotGot) {
  const Index texture = 0;
  for (const auto& corner : render_mesh(torus(24, 16), std::span(&texture, 1)).corners) {
    // Away from the circle in the middle of the tube.
    const double r = std::hypot(corner.position[0], corner.position[1]);
    const Point out = {corner.position[0] * (1 - 2 / r), corner.position[1] * (1 - 2 / r),
                       corner.position[2]};
    EXPECT_GT(std::abs(dot(corner.normal, out)), 0.98);
  }
}

TEST(RenderMesh, LeavesOutTrianglesWithoutAPlace) {
  Mesh mesh = grid(3);
  set_component(mesh.position, 0, 2, std::nan(""));
  const Index texture = 0;
  EXPECT_EQ(render_mesh(mesh, std::span(&texture, 1)).triangle_count(), 7u);
}

}  // namespace
}  // namespace pstrips::test
