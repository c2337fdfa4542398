#include "codecs/triangulate/predicates.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>

#include "codecs/stripify/random.h"

namespace pstrips {
namespace {

using Whole = __int128;
using Points = std::array<Point2, 4>;

int sign(Whole value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

struct WholePoint {
  Whole x, y;
};
WholePoint minus(const Point2& a, const Point2& b) {
  return {static_cast<Whole>(a.x) - static_cast<Whole>(b.x),
          static_cast<Whole>(a.y) - static_cast<Whole>(b.y)};
}
Whole cross(const WholePoint& a, const WholePoint& b) { return a.x * b.y - a.y * b.x; }
Whole lift(const WholePoint& a) { return a.x * a.x + a.y * a.y; }

// For coordinates that are whole and below 2^28.
int whole_orient(const Points& p) { return sign(cross(minus(p[0], p[2]), minus(p[1], p[2]))); }
int whole_in_circle(const Points& p) {
  const auto a = minus(p[0], p[3]), b = minus(p[1], p[3]), c = minus(p[2], p[3]);
  return sign(lift(a) * cross(b, c) + lift(b) * cross(c, a) + lift(c) * cross(a, b));
}

int orient_of(const Points& p) { return orient(p[0], p[1], p[2]); }
int in_circle_of(const Points& p) { return in_circle(p[0], p[1], p[2], p[3]); }

Points scaled(Points p, double factor) {
  for (Point2& point : p) point = {point.x * factor, point.y * factor};
  return p;
}

// Four points on a circle or a line, some of them a step off.
Points nearly_degenerate(Random& random, double size) {
  const auto coordinate = [&] {
    return static_cast<double>(random.below(static_cast<std::uint32_t>(size)));
  };
  const double x = coordinate(), y = coordinate(), r = coordinate(), s = coordinate();
  Points p = random.below(2)
                 ? Points{{{x + r, y + s}, {x - s, y + r}, {x - r, y - s}, {x + s, y - r}}}
                 : Points{{{x, y}, {x + r, y + s}, {x + 2 * r, y + 2 * s}, {x - r, y - s}}};
  for (Point2& point : p)
    if (random.below(3) == 0) point.x += static_cast<double>(random.below(3)) - 1;
  return p;
}

RC_GTEST_PROP(Predicates, AgreeWithWholeNumbers, (std::uint32_t seed)) {
  Random random(seed);
  for (const double size : {4.0, 1e3, 0x1p26}) {
    const Points p = nearly_degenerate(random, size);
    RC_ASSERT(orient_of(p) == whole_orient(p));
    RC_ASSERT(in_circle_of(p) == whole_in_circle(p));
  }
}

// Far beyond what a rounded evaluation can tell, without over- and underflow, with either.
RC_GTEST_PROP(Predicates, AreTheSameAtAnyScale, (std::uint32_t seed)) {
  Random random(seed);
  const Points p = nearly_degenerate(random, 0x1p26);
  for (const double factor :
       {0x1p-1074, 0x1p-1000, 0x1p-540, 0x1p-226, 0x1p-150, 0x1p200, 0x1p400, 0x1p990}) {
    RC_ASSERT(orient_of(scaled(p, factor)) == whole_orient(p));
    RC_ASSERT(in_circle_of(scaled(p, factor)) == whole_in_circle(p));
  }
}

// Coordinates with all their bits in use, so that differences are not exact: expansions against
// whole numbers of any size.
RC_GTEST_PROP(Predicates, AreTheSameInEitherArithmetic, (std::uint32_t seed)) {
  Random random(seed);
  const auto fraction = [&] { return random.bits() * 0x1p-32 + random.bits() * 0x1p-64; };
  const double x = fraction(), y = fraction(), dx = fraction() * 1e-9, dy = fraction() * 1e-9;
  const Points p{{{x, y}, {x + dx, y + dy}, {x - dy, y + dx}, {x + dx - dy, y + dx + dy}}};
  RC_ASSERT(orient_of(p) == orient_of(scaled(p, 0x1p-300)));
  RC_ASSERT(in_circle_of(p) == in_circle_of(scaled(p, 0x1p-300)));
  const Points line{{{x, y}, {x * 3, y * 3}, {x * 7, y * 7}, {x * 5, y * 5}}};
  RC_ASSERT(orient_of(line) == orient_of(scaled(line, 0x1p-300)));
  RC_ASSERT(in_circle_of(line) == in_circle_of(scaled(line, 0x1p-300)));
}

TEST(Predicates, TellTheLastBit) {
  constexpr double kNext = 0x1.0000000000001p0;
  EXPECT_EQ(orient({0, 0}, {1, 1}, {kNext, kNext}), 0);
  EXPECT_EQ(orient({0, 0}, {1, 1}, {1, kNext}), 1);
  EXPECT_EQ(orient({0, 0}, {1, 1}, {kNext, 1}), -1);
  EXPECT_EQ(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -1}), 0);
  EXPECT_EQ(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -kNext}), -1);
  EXPECT_EQ(in_circle({kNext, 0}, {0, 1}, {-1, 0}, {0, -1}), 1);
  EXPECT_EQ(in_circle({-1, 0}, {0, 1}, {kNext, 0}, {0, -1}), -1) << "clockwise";
}

TEST(Predicates, TakeAnyRange) {
  constexpr double kLeast = 0x1p-1074, kMax = 0x1.fffffffffffffp1023;
  EXPECT_EQ(orient({-kMax, -kMax}, {kMax, kMax}, {0, kLeast}), 1);
  EXPECT_EQ(orient({-kMax, -kMax}, {kMax, kMax}, {kLeast, 0}), -1);
  EXPECT_EQ(orient({-kMax, -kMax}, {kMax, kMax}, {0, -0.0}), 0);
  EXPECT_EQ(in_circle({kMax, 0}, {0, kMax}, {-kMax, 0}, {kLeast, kLeast}), 1);
  EXPECT_EQ(in_circle({kLeast, 0}, {0, kLeast}, {-kLeast, 0}, {0, -kMax}), -1);
  EXPECT_EQ(in_circle({kLeast, 0}, {0, kLeast}, {-kLeast, 0}, {0, -kLeast}), 0);
}

}  // namespace
}  // namespace pstrips
