#include "codecs/measure/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/meshes.h"

namespace pstrips {
namespace {

struct Owned {
  std::vector<double> positions;
  std::vector<Index> triangles;
  operator Surface() const { return {positions, triangles}; }
};

const Owned kSquare = {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3}};

Owned moved(Owned surface, double x, double y, double z) {
  for (std::size_t i = 0; i < surface.positions.size(); i += 3) {
    surface.positions[i] += x;
    surface.positions[i + 1] += y;
    surface.positions[i + 2] += z;
  }
  return surface;
}

Owned torus(Index u, Index v) {
  const Mesh mesh = test::torus(u, v);
  return {positions_as_double(mesh), mesh.corners};
}

TEST(MeasureDistance, IsZeroFromASurfaceToItself) {
  const Owned t = torus(40, 20);
  const Distance d = measure_distance(t, t, 20000);
  EXPECT_NEAR(d.hausdorff, 0, 1e-6);
  EXPECT_NEAR(d.rms, 0, 1e-7);
}

TEST(MeasureDistance, OfParallelSquaresIsTheirGap) {
  const Distance d = measure_distance(kSquare, moved(kSquare, 0, 0, 0.25), 1000);
  EXPECT_DOUBLE_EQ(d.hausdorff, 0.25);
  EXPECT_NEAR(d.rms, 0.25, 1e-12);
}

TEST(MeasureDistance, TellsTheTwoSidesApart) {
  // Every point of the square lies on the larger one, whose far corner is √2 away.
  Owned large = kSquare;
  for (double& x : large.positions) x *= 2;
  const Distance d = measure_distance(kSquare, large, 100000);
  EXPECT_NEAR(d.a_to_b.maximum, 0, 1e-12);
  EXPECT_DOUBLE_EQ(d.b_to_a.maximum, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(d.hausdorff, std::sqrt(2.0));
  // Mean of the squares: 1/4 · 0 + 2/4 · 1/3 + 1/4 · 2/3.
  EXPECT_NEAR(d.b_to_a.rms, std::sqrt(1 / 3.0), 1e-3);
  EXPECT_NEAR(d.rms, std::sqrt(1 / 6.0), 1e-3);
}

TEST(MeasureDistance, AgreesWithAllPairsOnRandomTriangles) {
  // A slow reference: the distance to a triangle is the least over a dense sampling of it.
  const Mesh soup = test::random_soup(5, 30, 20);
  std::vector<Index> triangles;
  for (const Index w : soup.corners) triangles.push_back(soup.vertex_of(w));
  const Owned target = {positions_as_double(soup), triangles};
  const Owned points = {{3, 4, 5, 20, -3, 8, 7.5, 7.5, 7.5, 0, 0, 0}, {}};
  constexpr int kSteps = 150;
  double worst = 0;
  for (std::size_t p = 0; p < points.positions.size(); p += 3) {
    double least = 1e30;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
          double sum = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](std::size_t c) {
              return target.positions[3 * triangles[t + c] + k];
            };
            const double x = at(0) + (at(1) - at(0)) * i / kSteps + (at(2) - at(0)) * j / kSteps;
            sum += (x - points.positions[p + k]) * (x - points.positions[p + k]);
          }
          least = std::min(least, sum);
        }
    worst = std::max(worst, std::sqrt(least));
  }
  EXPECT_NEAR(measure_distance(points, target, 1).a_to_b.maximum, worst, 0.02);
}

TEST(MeasureDistance, HasAnAnswerForEveryKindOfSurface) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Owned empty, one_point = {{1, 2, 3}, {}}, other_point = {{1, 2, 7}, {}};
  const Owned not_finite = {{kNan, 0, 0, 0, kInfinity, 0, 0, 0, 0}, {0, 1, 2}};
  const Owned needle = {{0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2}};  // no area
  const struct {
    const char* name;
    Owned a, b;
    double hausdorff, rms;
  } kCases[] = {
      {"both empty", empty, empty, 0, 0},
      {"one empty", empty, kSquare, kInfinity, kInfinity},
      {"nothing finite", not_finite, one_point, kInfinity, kInfinity},
      {"points", one_point, other_point, 4, 4},
      {"needle", needle, moved(needle, 0, 3, 0), 3, 3},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.name);
    const Distance d = measure_distance(c.a, c.b, 100);
    EXPECT_DOUBLE_EQ(d.hausdorff, c.hausdorff);
    EXPECT_DOUBLE_EQ(d.rms, c.rms);
  }
}

TEST(BoundingBoxDiagonal, LooksAtFinitePointsOnly) {
  EXPECT_DOUBLE_EQ(bounding_box_diagonal({}), 0);
  const double positions[] = {0, 0, 0, 2, 3, 6, std::nan(""), 100, 100};
  EXPECT_DOUBLE_EQ(bounding_box_diagonal(positions), 7);
}

}  // namespace
}  // namespace pstrips
