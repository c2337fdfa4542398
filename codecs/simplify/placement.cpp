#include "codecs/simplify/placement.h"

#include <array>
#include <cmath>

namespace pstrip {
namespace {

// Pull to the middle of the edge, as a share of the quadric's mean curvature.
constexpr double kPull = 1e-6;
// The farthest place from the middle, in lengths of the edge, squared.
constexpr double kFarthest = 4;

struct Vec3d {
  double x, y, z;
};
Vec3d widened(Vec3f a) { return {a.x, a.y, a.z}; }
double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// A symmetric positive definite matrix as L·D·L', to solve with.
struct Factors {
  double l10, l20, l21, d0, d1, d2;  // the inverses of D

  Factors(const Quadric& q, double pull) {
    d0 = 1 / (q.xx + pull);
    l10 = q.xy * d0, l20 = q.xz * d0;
    d1 = 1 / (q.yy + pull - l10 * q.xy);
    const double yz = q.yz - l10 * q.xz;
    l21 = yz * d1;
    d2 = 1 / (q.zz + pull - l20 * q.xz - l21 * yz);
  }
  Vec3d solve(Vec3d r) const {
    const double y = r.y - l10 * r.x, z = (r.z - l20 * r.x - l21 * y) * d2;
    const double v = y * d1 - l21 * z;
    return {r.x * d0 - l10 * v - l20 * z, v, z};
  }
};

}  // namespace

Vec3f best_place(const Quadric& q, const Volume& volume, Vec3f offset) {
  const Vec3f middle = offset * 0.5f;
  const double pull = kPull * (double{q.xx} + q.yy + q.zz) / 3;
  if (pull > 0) {
    const Factors factors(q, pull);
    const Vec3d m = widened(middle);
    Vec3d x = factors.solve({pull * m.x - q.b.x, pull * m.y - q.b.y, pull * m.z - q.b.z});
    const Vec3d area = widened(volume.area);
    const Vec3d u = factors.solve(area);
    const double slope = dot(area, u);
    if (slope > 0) {
      const double step = (volume.constant - dot(area, x)) / slope;
      x = {x.x + step * u.x, x.y + step * u.y, x.z + step * u.z};
    }
    const Vec3d far = {x.x - m.x, x.y - m.y, x.z - m.z};
    const Vec3d o = widened(offset);
    if (dot(far, far) <= kFarthest * dot(o, o))
      return {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)};
  }
  Vec3f best = middle;
  for (const Vec3f end : {Vec3f{}, offset})
    if (q.at(end) < q.at(best)) best = end;
  return best;
}

}  // namespace pstrip
