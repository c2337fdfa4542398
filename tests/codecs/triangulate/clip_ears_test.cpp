#include "codecs/triangulate/clip_ears.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "codecs/triangulate/plane.h"

namespace pstrips {
namespace {

using Loop = std::vector<Point2>;

double area(const Point2& a, const Point2& b, const Point2& c) {
  return ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
}

double area(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += area(loop[0], loop[i], loop[i + 1]);
  return sum;
}

// Triangles that are all wound as the loop and together have its area cover it once.
void expect_covered(const Loop& loop, double expected, std::size_t without_area = 0) {
  const auto triangles = clip_ears(loop);
  ASSERT_EQ(triangles.size(), loop.size() - 2);
  double sum = 0;
  std::size_t flat = 0;
  for (const auto& [a, b, c] : triangles) {
    const double one = area(loop[a], loop[b], loop[c]);
    EXPECT_GE(one, 0);
    flat += one == 0;
    sum += one;
  }
  EXPECT_NEAR(sum, expected, 1e-9 * std::max(1., expected));
  EXPECT_LE(flat, without_area);
}

Loop comb(int teeth) {
  Loop out = {{0, 0}, {2. * teeth - 1, 0}};
  for (int t = teeth; t-- > 0;) {
    out.push_back({2. * t + 1, 3});
    out.push_back({2. * t, 3});
    if (t > 0) {
      out.push_back({2. * t, 1});
      out.push_back({2. * t - 1, 1});
    }
  }
  return out;
}

Loop spiral(int corners) {
  Loop out, back;
  for (int i = 0; i < corners; ++i) {
    const double angle = 0.3 * i, radius = 1 + 0.1 * angle;
    out.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    back.push_back({(radius + 0.3) * std::cos(angle), (radius + 0.3) * std::sin(angle)});
  }
  // The outer side forwards is counter-clockwise, the inner one leads back.
  Loop loop = back;
  loop.insert(loop.end(), out.rbegin(), out.rend());
  return loop;
}

TEST(ClipEars, CoversCombs) {
  for (const int teeth : {2, 8, 75, 5000}) expect_covered(comb(teeth), 4. * teeth - 1);
}

TEST(ClipEars, CoversSpirals) {
  for (const int corners : {8, 150, 20'000}) expect_covered(spiral(corners), area(spiral(corners)));
}

TEST(ClipEars, CoversStars) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (const int corners : {5, 12, 300, 10'000}) {
    Loop loop;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, r = radius(random);
      loop.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    expect_covered(loop, area(loop));
  }
}

TEST(ClipEars, LeavesHolesOpen) {
  // A square ring whose bridge is walked twice.
  expect_covered({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},
                 12);
  // Two holes, the second reached from the first.
  expect_covered({{0, 0},
                  {9, 0},
                  {9, 4},
                  {0, 4},
                  {0, 0},
                  {1, 1},
                  {1, 3},
                  {3, 3},
                  {3, 2},
                  {5, 2},
                  {5, 3},
                  {7, 3},
                  {7, 1},
                  {5, 1},
                  {5, 2},
                  {3, 2},
                  {3, 1},
                  {1, 1}},
                 28);
}

TEST(ClipEars, TakesPolygonsThatTouchThemselves) {
  // Two squares that share a corner.
  expect_covered({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, 2, 2);
  // A corner on the side across.
  expect_covered({{0, 0}, {4, 0}, {4, 3}, {2, 0}, {0, 3}}, 6, 1);
}

TEST(ClipEars, TakesCornersOnALine) {
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, 4);
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}}, 4.5);
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, 0, 2);
}

TEST(ClipEars, TakesCornersThatCoincide) {
  expect_covered({{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 2}, {2, 2}, {1, 1}, {0, 2}}, 3, 3);
}

TEST(ClipEars, TakesWhiskers) {
  expect_covered({{0, 0}, {1, 0}, {1, 1}, {1, 0}, {3, 0}, {3, 3}, {0, 3}}, 9, 2);   // inwards
  expect_covered({{0, 0}, {1, 0}, {1, -1}, {1, 0}, {3, 0}, {3, 3}, {0, 3}}, 9, 2);  // outwards
}

TEST(ClipEars, GivesAsManyTrianglesForAnything) {
  std::mt19937 random(11);
  for (const Index corners : {4u, 5u, 40u, 3000u})
    for (const unsigned places : {2u, 5u, 100'000u}) {
      Loop loop;
      for (Index i = 0; i < corners; ++i)
        loop.push_back(
            {static_cast<double>(random() % places), static_cast<double>(random() % places)});
      EXPECT_EQ(clip_ears(loop).size(), corners - 2);
    }
}

TEST(BestPlane, KeepsNumbersOfFlatLoops) {
  const std::vector<Point> square = {{0, 0, 5}, {0, 0.1, 5.1}, {0.7, 0.1, 5.1}, {0.7, 0, 5}};
  const Loop flat = on_best_plane(square);
  EXPECT_GT(area(flat), 0);
  for (const Point2& p : flat) EXPECT_TRUE(p.x == 0 || p.x == 0.7 || p.y == 0 || p.y == 0.7);
}

TEST(BestPlane, TakesAnyScale) {
  for (const double scale : {1e-300, 1e-20, 1., 1e300}) {
    const std::vector<Point> loop = {{0, 0, 0}, {0, scale, 0}, {0, scale, scale}, {0, 0, scale}};
    const Loop flat = on_best_plane(loop);
    ASSERT_EQ(flat.size(), 4u);
    EXPECT_EQ(orient(flat[0], flat[1], flat[2]), 1) << scale;
  }
  EXPECT_TRUE(on_best_plane(std::vector<Point>{{0, 0, 0}, {NAN, 0, 0}, {0, 1, 0}}).empty());
}

// A ring of corners that go up and down by turns: seen along the normal it is convex.
TEST(BestPlane, IsThatOfTheNormal) {
  std::vector<Point> loop;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * std::numbers::pi * i / 12, up = i % 2 == 0 ? 0.8 : -0.8;
    const double x = std::cos(angle), y = std::sin(angle);
    loop.push_back({x + up, y + up, up - x - y});  // the normal is 1, 1, 1
  }
  expect_covered(on_best_plane(loop), area(on_best_plane(loop)));
  const Loop flat = on_best_plane(loop);
  for (std::size_t i = 0; i < flat.size(); ++i)
    EXPECT_EQ(orient(flat[i], flat[(i + 1) % 12], flat[(i + 2) % 12]), 1);
}

}  // namespace
}  // namespace pstrips
