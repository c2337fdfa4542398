#include "codecs/simplify/placement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pstrips {
namespace {

void expect_near(Vec3f a, Vec3f b, float distance) {
  EXPECT_NEAR(a.x, b.x, distance);
  EXPECT_NEAR(a.y, b.y, distance);
  EXPECT_NEAR(a.z, b.z, distance);
}

// The planes of three faces through `point`, relative to the origin.
Quadric corner_at(Vec3f point) {
  Quadric planes;
  planes.add_plane({1, 0, 0}, 1);
  planes.add_plane({0, 0.6f, 0.8f}, 2);
  planes.add_plane({0, 0.8f, -0.6f}, 1);
  Quadric out;
  out.add(planes, point);
  return out;
}

constexpr Vec3f kOffset = {2, 0, 0};

TEST(BestPlace, IsWherePlanesMeet) {
  const Vec3f corner = {1, 0.5f, -0.25f};
  expect_near(best_place(corner_at(corner), {}, kOffset), corner, 2e-3f);
}

TEST(BestPlace, IsOnThePlaneOfTheVolume) {
  const Volume volume{{0, 0.5f, 2}, 1.5f};
  const Vec3f place = best_place(corner_at({1, 0.5f, -0.25f}), volume, kOffset);
  EXPECT_NEAR(dot(place, volume.area), volume.constant, 1e-5f);
}

TEST(BestPlace, IsTheMiddleWhereNothingElseIsAsked) {
  expect_near(best_place({}, {}, kOffset), {1, 0, 0}, 0);
  Quadric flat;
  flat.add_plane({0, 0, 1}, 5);
  expect_near(best_place(flat, {}, kOffset), {1, 0, 0}, 1e-6f);
  // A volume that a plane has whatever the place.
  expect_near(best_place(flat, {{0, 0, 3}, 0}, kOffset), {1, 0, 0}, 1e-6f);
}

TEST(BestPlace, IsAnEndWhenTheBestIsFarOff) {
  expect_near(best_place(corner_at({100, 0, 0}), {}, kOffset), kOffset, 0);
  expect_near(best_place(corner_at({-100, 0, 0}), {}, kOffset), {0, 0, 0}, 0);
}

TEST(BestPlace, IsTheSameForFourEdgesAtOnce) {
  const Quadric quadrics[] = {corner_at({1, 0.5f, -0.25f}), corner_at({100, 0, 0}), Quadric{},
                              corner_at({0.5f, 0, 0.1f})};
  const Volume volumes[] = {{{0, 0.5f, 2}, 1.5f}, {}, {}, {{0.1f, 0, 0}, 0.06f}};
  const Vec3f offsets[] = {kOffset, kOffset, {1, 2, 3}, {1, 0, 0.5f}};
  EdgeSums sums;
  const auto set = [](Vec3x4& four, std::size_t i, Vec3f v) {
    four.x[i] = v.x, four.y[i] = v.y, four.z[i] = v.z;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Quadric& q = quadrics[i];
    sums.xx[i] = q.xx, sums.yy[i] = q.yy, sums.zz[i] = q.zz;
    sums.xy[i] = q.xy, sums.xz[i] = q.xz, sums.yz[i] = q.yz;
    set(sums.b, i, q.b);
    set(sums.area, i, volumes[i].area);
    sums.volume[i] = volumes[i].constant;
    set(sums.offset, i, offsets[i]);
  }
  const Vec3x4 places = best_place(sums);
  const Float4 values = sums.at(places);
  for (std::size_t i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    expect_near(lane(places, i), best_place(quadrics[i], volumes[i], offsets[i]), 1e-6f);
    EXPECT_NEAR(values[i], quadrics[i].at(lane(places, i)), 1e-6f * (1 + std::abs(values[i])));
  }
}

}  // namespace
}  // namespace pstrips
