#include "codecs/simplify/quadric.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pstrips {
namespace {

const Vec3f kNormal = {0.6f, 0, 0.8f}, kOther = {0, 1, 0};

TEST(Quadric, IsTheWeightedSquaredDistanceToItsPlanes) {
  Quadric q;
  q.add_plane(kNormal, 2);
  q.add_plane(kOther, 3);
  EXPECT_FLOAT_EQ(q.weight, 5);
  const Vec3f x = {1, 2, -3};
  const float d1 = dot(kNormal, x), d2 = dot(kOther, x);
  EXPECT_FLOAT_EQ(q.at(x), 2 * d1 * d1 + 3 * d2 * d2);
  EXPECT_FLOAT_EQ(q.at({0, 0, 0}), 0);
}

TEST(Quadric, OfALineIsTheSquaredDistanceToIt) {
  Quadric q;
  q.add_line(kNormal, 2);
  const Vec3f x = {1, 2, -3};
  const float along = dot(kNormal, x);
  EXPECT_NEAR(q.at(x), 2 * (dot(x, x) - along * along), 1e-5);
  EXPECT_NEAR(q.at(kNormal * 7), 0, 1e-5);
}

// The sum of two quadrics, measured anywhere, less its constant term.
TEST(Quadric, AddsOneThatStandsElsewhere) {
  Quadric here, there;
  here.add_plane(kNormal, 1);
  there.add_plane(kOther, 4);
  there.add_plane(kNormal, 0.5f);
  const Vec3f offset = {3, -1, 2};  // from here to there
  const float constant = there.at(offset * -1);
  Quadric sum = here;
  sum.add(there, offset);
  for (const Vec3f x : {Vec3f{0, 0, 0}, Vec3f{1, 2, 3}, Vec3f{-4, 0.5f, 2}})
    EXPECT_NEAR(sum.at(x) + constant, here.at(x) + there.at(x - offset), 1e-4);
  EXPECT_FLOAT_EQ(sum.weight, 5.5f);
}

TEST(Quadric, StaysTheSameWhenItsOwnerMoves) {
  Quadric here;
  here.add_plane(kNormal, 2);
  here.add_plane(kOther, 3);
  here.b = {1, -2, 0.5f};
  const Vec3f offset = {0.5f, 3, -1};
  Quadric moved = here;
  moved.move(offset);
  for (const Vec3f x : {Vec3f{0, 0, 0}, Vec3f{1, 2, 3}})
    EXPECT_NEAR(moved.at(x - offset) + here.at(offset), here.at(x), 1e-4);
}

}  // namespace
}  // namespace pstrips
