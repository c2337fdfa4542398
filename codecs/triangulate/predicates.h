#pragma once

#include <cmath>

namespace pstrips::inline codecs {

// Signs of determinants of points in the plane, exactly right for all finite doubles.
//
// A rounded evaluation answers when its error bound is below its value. Otherwise the determinant
// is computed without rounding: as an expansion, a sum of doubles that do not overlap, when no
// coordinate is below 2^-200 or above 2^240 in magnitude (0 aside); beyond that as an integer.
// [Shewchuk97 §2, §4.2, §4.4; our stages are the first and the last of each predicate's four]

struct Point2 {
  double x, y;
  friend bool operator==(const Point2&, const Point2&) = default;
};

namespace predicates {

// The error bounds of [Shewchuk97 fig. 21, fig. 24] for a unit roundoff of 2^-53; kUnderflow is
// ours and covers what products below the normal numbers lose.
inline constexpr double kRoundoff = 0x1p-53;
inline constexpr double kOrientBound = (3 + 16 * kRoundoff) * kRoundoff;
inline constexpr double kCircleBound = (10 + 96 * kRoundoff) * kRoundoff;
inline constexpr double kUnderflow = 0x1p-900;

int orient_exact(const Point2& a, const Point2& b, const Point2& c);
int in_circle_exact(const Point2& a, const Point2& b, const Point2& c, const Point2& d);

}  // namespace predicates

/// 1 when a, b, c turn counter-clockwise, -1 when clockwise, 0 when they are on a line.
inline int orient(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double value = left - right;
  const double bound =
      predicates::kOrientBound * (std::abs(left) + std::abs(right)) + predicates::kUnderflow;
  if (value > bound) return 1;
  if (value < -bound) return -1;
  return predicates::orient_exact(a, b, c);  // also when something overflowed
}

/// 1 when d is inside the circle through a, b, c, -1 outside, 0 on it; the other way round when a,
/// b, c turn clockwise.
inline int in_circle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const double ax = a.x - d.x, bx = b.x - d.x, cx = c.x - d.x;
  const double ay = a.y - d.y, by = b.y - d.y, cy = c.y - d.y;
  const double bc = bx * cy, cb = cx * by, a_lift = ax * ax + ay * ay;
  const double ca = cx * ay, ac = ax * cy, b_lift = bx * bx + by * by;
  const double ab = ax * by, ba = bx * ay, c_lift = cx * cx + cy * cy;
  const double value = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
  const double size = (std::abs(bc) + std::abs(cb)) * a_lift +
                      (std::abs(ca) + std::abs(ac)) * b_lift +
                      (std::abs(ab) + std::abs(ba)) * c_lift;
  const double bound =
      predicates::kCircleBound * size + predicates::kUnderflow * (a_lift + b_lift + c_lift + 1);
  if (value > bound) return 1;
  if (value < -bound) return -1;
  return predicates::in_circle_exact(a, b, c, d);
}

}  // namespace pstrips::inline codecs
