#include "codecs/triangulate/triangulate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/strips.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

// One polygon in the plane z = 0, counter-clockwise.
Mesh polygon(const std::vector<std::array<float, 2>>& points) {
  std::vector<float> positions;
  std::vector<Index> corners;
  for (const auto& p : points) {
    corners.push_back(static_cast<Index>(corners.size()));
    positions.insert(positions.end(), {p[0], p[1], 0.f});
  }
  Mesh mesh = test::triangle_mesh(positions, corners);
  mesh.face_first = {0, static_cast<Index>(points.size())};
  canonicalize(mesh);
  return mesh;
}

double signed_area(const Mesh& mesh, const Index* t) {
  const auto p = positions_as_double(mesh);
  const auto x = [&](int k) { return p[3 * t[k]]; };
  const auto y = [&](int k) { return p[3 * t[k] + 1]; };
  return ((x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0))) / 2;
}

struct Case {
  const char* name;
  std::vector<std::array<float, 2>> points;
  double area;
};

const Case kSimplePolygons[] = {
    {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1},
    {"dart, concave at the second corner", {{0, 0}, {1, 1}, {2, 0}, {1, 3}}, 2},
    {"dart, concave at the first corner", {{1, 1}, {2, 0}, {1, 3}, {0, 0}}, 2},
    {"pentagon", {{0, 0}, {2, 0}, {3, 1}, {1, 3}, {0, 1}}, 5.5},
    {"L", {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3},
    {"comb",
     {{0, 0},
      {5, 0},
      {5, 3},
      {4, 3},
      {4, 1},
      {3, 1},
      {3, 3},
      {2, 3},
      {2, 1},
      {1, 1},
      {1, 3},
      {0, 3}},
     11},
};

TEST(Triangulate, SimplePolygonsAreCoveredOnceWithTheirWinding) {
  for (const Case& c : kSimplePolygons) {
    SCOPED_TRACE(c.name);
    const Mesh mesh = polygon(c.points);
    const Triangulation t = triangulate(mesh);
    ASSERT_EQ(t.face.size(), c.points.size() - 2);
    double area = 0;
    for (std::size_t i = 0; i < t.face.size(); ++i) {
      const double a = signed_area(mesh, &t.corners[3 * i]);
      EXPECT_GE(a, 0);
      area += a;
    }
    EXPECT_NEAR(area, c.area, 1e-6);
  }
}

TEST(Triangulate, DegenerateTrianglesGiveNothing) {
  const Mesh mesh = test::triangle_mesh(std::vector<float>(9), {0, 1, 2, 0, 0, 1});
  EXPECT_EQ(triangulate(mesh).corners, (std::vector<Index>{0, 1, 2}));
}

TEST(Triangulate, LinesAndPointsGiveNothing) {
  Mesh mesh = polygon(kSimplePolygons[4].points);
  mesh.groups[0].kind = FaceKind::lines;
  EXPECT_TRUE(triangulate(mesh).face.empty());
}

TEST(Triangulate, HugePolygonsStayLinear) {
  std::vector<std::array<float, 2>> points;
  constexpr int kCorners = 200'000;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners, r = i % 2 ? 1 : 0.5;
    points.push_back({static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a))});
  }
  EXPECT_EQ(triangulate(polygon(points)).face.size(), kCorners - 2u);
}

}  // namespace
}  // namespace pstrips
