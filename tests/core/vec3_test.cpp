#include "core/vec3.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/point.h"

namespace pstrips {
namespace {

using Two = double __attribute__((vector_size(16)));

TEST(Vec3, IsRightHanded) {
  constexpr Vec3<int> x{1, 0, 0}, y{0, 1, 0};
  constexpr Vec3<int> z = cross(x, y);
  static_assert(z.x == 0 && z.y == 0 && z.z == 1);
  static_assert(dot(Vec3<int>{1, 2, 3}, Vec3<int>{4, -5, 6}) == 12);
}

TEST(Vec3, WorksLaneByLane) {
  const Vec3<Two> a = {Two{1, 2}, Two{3, 4}, Two{5, 6}};
  const Vec3<Two> b = {Two{1, 0}, Two{1, 0}, Two{2, 1}};
  const Vec3<Two> c = (a - b) * Two{2, 3} + a;
  EXPECT_EQ(c.x[0], 1);
  EXPECT_EQ(c.y[1], 16);
  EXPECT_EQ(c.z[0], 11);
  EXPECT_EQ(dot(a, b)[0], 1 + 3 + 10);
  EXPECT_EQ(dot(a, {Two{}, Two{}, Two{1, 2}})[1], 12);
}

TEST(Point, AddsScalesAndMeasures) {
  const Point a{1, 2, 2}, b{0, -2, 1};
  EXPECT_EQ(a + b, (Point{1, 0, 3}));
  EXPECT_EQ(a - b, (Point{1, 4, 1}));
  EXPECT_EQ(a * 0.5, (Point{0.5, 1, 1}));
  EXPECT_EQ(length(a), 3);
  EXPECT_EQ(cross(a, b), (Point{6, -1, -2}));
  EXPECT_EQ(dot(cross(a, b), a), 0);
  EXPECT_TRUE(is_finite(a));
  EXPECT_FALSE(is_finite({0, 0, std::numeric_limits<double>::infinity()}));
}

}  // namespace
}  // namespace pstrips
