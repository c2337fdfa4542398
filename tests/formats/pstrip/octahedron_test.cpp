// Directions as points of a square: every point comes back from its direction, directions have
// unit length, and known ones are where the page says.

#include "formats/pstrip/payload/compact/octahedron.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pstrips {
namespace {

double length_of(const Octahedron::Vector& v) {
  return std::hypot(std::ldexp(static_cast<double>(v[0]), -24),
                    std::ldexp(static_cast<double>(v[1]), -24),
                    std::ldexp(static_cast<double>(v[2]), -24));
}

void expect_back(const Octahedron& octahedron, Octahedron::Point point) {
  const Octahedron::Vector unit = octahedron.unit(point);
  ASSERT_EQ(octahedron.near(unit), point) << point.u << ' ' << point.v;
  ASSERT_NEAR(length_of(unit), 1, 1e-7) << point.u << ' ' << point.v;
  const Octahedron::Point turned = octahedron.turned(point);
  ASSERT_EQ(octahedron.unit(octahedron.turned(turned)), unit);
  ASSERT_FALSE(octahedron.is_below(point) && octahedron.is_below(turned));
}

TEST(Octahedron, GivesEveryPointBack) {
  for (unsigned bits = Octahedron::kMinBits; bits <= 8; ++bits) {
    const Octahedron octahedron(bits);
    for (std::int32_t u = -octahedron.reach(); u <= octahedron.reach(); ++u)
      for (std::int32_t v = -octahedron.reach(); v <= octahedron.reach(); ++v)
        expect_back(octahedron, octahedron.placed(u, v));
  }
}

TEST(Octahedron, GivesPointsOfFinerSquaresBack) {
  std::mt19937 random(1);
  for (unsigned bits = 9; bits <= Octahedron::kMaxBits; ++bits) {
    const Octahedron octahedron(bits);
    std::uniform_int_distribution<std::int32_t> any(-octahedron.reach(), octahedron.reach());
    for (int i = 0; i < 20000; ++i)
      expect_back(octahedron, octahedron.placed(any(random), any(random)));
    for (const std::int32_t u : {-octahedron.reach(), 0, octahedron.reach()})
      expect_back(octahedron, octahedron.placed(u, any(random)));
  }
}

TEST(Octahedron, HasTheAxes) {
  for (unsigned bits = Octahedron::kMinBits; bits <= Octahedron::kMaxBits; ++bits) {
    const Octahedron octahedron(bits);
    constexpr std::int64_t kOne = 1 << 24;
    const std::int32_t m = octahedron.reach();
    EXPECT_EQ(octahedron.unit({0, 0}), (Octahedron::Vector{0, 0, kOne}));
    EXPECT_EQ(octahedron.unit({m, m}), (Octahedron::Vector{0, 0, -kOne}));
    EXPECT_EQ(octahedron.unit({-m, 0}), (Octahedron::Vector{-kOne, 0, 0}));
    EXPECT_EQ(octahedron.unit({0, m}), (Octahedron::Vector{0, kOne, 0}));
    // All four corners are -z.
    for (const auto& [u, v] : {std::pair(-m, -m), std::pair(-m, m), std::pair(m + 5, -m - 9)})
      EXPECT_EQ(octahedron.placed(u, v), (Octahedron::Point{m, m}));
    EXPECT_EQ(octahedron.near({0, 0, 0}), (Octahedron::Point{0, 0}));
  }
}

// The formula of the page, worked out by hand: of 4 bits, M = 7, the point 3, -2 has the vector
// 3, -2, 2; (3, -2, 2) / sqrt(17) in 2^-24 to the nearest.
TEST(Octahedron, HasTheUnitOfThePage) {
  const Octahedron octahedron(4);
  EXPECT_EQ(octahedron.on_faces({3, -2}), (Octahedron::Vector{3, -2, 2}));
  EXPECT_EQ(octahedron.unit({3, -2}), (Octahedron::Vector{12207218, -8138145, 8138145}));
  EXPECT_EQ(octahedron.on_faces({-6, 5}), (Octahedron::Vector{-2, 1, -4}));
}

// No direction is much farther from its point than two steps of the square.
TEST(Octahedron, FindsPointsNearDirections) {
  std::mt19937 random(2);
  std::uniform_int_distribution<std::int64_t> any(-(1 << 20), 1 << 20);
  for (unsigned bits = Octahedron::kMinBits; bits <= Octahedron::kMaxBits; ++bits) {
    const Octahedron octahedron(bits);
    for (int i = 0; i < 3000; ++i) {
      const Octahedron::Vector d = {any(random), any(random), any(random)};
      const double size = std::hypot(d[0], d[1], d[2]);
      const Octahedron::Vector unit = octahedron.unit(octahedron.near(d));
      double square = 0;
      for (unsigned k = 0; k < 3; ++k) {
        const double off =
            static_cast<double>(d[k]) / size - std::ldexp(static_cast<double>(unit[k]), -24);
        square += off * off;
      }
      ASSERT_LT(std::sqrt(square), 2.2 / octahedron.reach() + 1e-6);
    }
  }
}

}  // namespace
}  // namespace pstrips
