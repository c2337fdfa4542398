#include "codecs/simplify/new_face_distance.h"

#include <gtest/gtest.h>

#include <vector>

namespace pstrips {
namespace {

// In squared model units: of a tip over a square of side 2 when it goes to the corner (1, 1, 0).
double distance_of(double x, double y, double z) {
  const std::vector<double> positions = {x, y, z, 1, 1, 0, -1, 1, 0, -1, -1, 0, 1, -1, 0, 9, 9, 9};
  const std::vector<Index> triangles = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
  Complex complex(positions, {}, triangles);
  Star star;
  complex.gather(0, star);
  star.measure();
  const double unit = complex.scale[0] * complex.scale[1];
  return squared_new_face_distance(star, complex.offset(0, 1)) / (unit * unit);
}

TEST(NewFaceDistance, IsNothingOnAPlane) { EXPECT_NEAR(distance_of(0.25, -0.5, 0), 0, 1e-6); }

TEST(NewFaceDistance, IsTheHeightOfATip) {
  EXPECT_NEAR(distance_of(0, 0, 3), 9, 1e-4);
  EXPECT_NEAR(distance_of(0.5, 0.25, -0.1), 0.01, 1e-5);
  EXPECT_NEAR(distance_of(-0.9, 0.9, 8), 64, 1e-3);
}

TEST(NewFaceDistance, IsToAnEdgeWhereNoFaceIsBelow) {
  EXPECT_NEAR(distance_of(4, 0, 1), 10, 1e-4);  // (1, 0, 0) is nearest
  EXPECT_NEAR(distance_of(0, 3, 2), 8, 1e-4);   // (0, 1, 0)
}

TEST(NewFaceDistance, IsToTheOtherEndWhereNothingElseIsNear) {
  EXPECT_NEAR(distance_of(4, 5, 0), 25, 1e-4);
}

}  // namespace
}  // namespace pstrips
