#include "codecs/simplify/placement.h"

#include <cmath>
#include <initializer_list>

namespace pstrips::inline codecs {
namespace {

// Pull to the middle of the edge, as a share of the quadric's mean curvature.
constexpr double kPull = 1e-6;
// The farthest place from the middle, in lengths of the edge, squared.
constexpr double kFarthest = 4;

using Float2 = float __attribute__((vector_size(8)));
using Double2 = double __attribute__((vector_size(16)));

// What follows is for T a double or several side by side.
template <class T>
struct Matrix {
  T xx, yy, zz, xy, xz, yz;
};

// A symmetric positive definite matrix plus `pull` as L·D·L', to solve with.
template <class T>
struct Factors {
  T l10, l20, l21, d0, d1, d2;  // the inverses of D

  Factors(const Matrix<T>& m, T pull) {
    d0 = 1 / (m.xx + pull);
    l10 = m.xy * d0, l20 = m.xz * d0;
    d1 = 1 / (m.yy + pull - l10 * m.xy);
    const T yz = m.yz - l10 * m.xz;
    l21 = yz * d1;
    d2 = 1 / (m.zz + pull - l20 * m.xz - l21 * yz);
  }
  Vec3<T> solve(const Vec3<T>& r) const {
    const T y = r.y - l10 * r.x, z = (r.z - l20 * r.x - l21 * y) * d2;
    const T v = y * d1 - l21 * z;
    return {r.x * d0 - l10 * v - l20 * z, v, z};
  }
};

// Not finite where the quadric is nothing. `near` says whether the place is not too far off.
template <class T, class Bool>
Vec3<T> least(const Matrix<T>& a, const Vec3<T>& b, const Vec3<T>& area, T volume,
              const Vec3<T>& offset, Bool& near) {
  const Vec3<T> m = {offset.x * 0.5, offset.y * 0.5, offset.z * 0.5};
  const T pull = (a.xx + a.yy + a.zz) * (kPull / 3);
  const Factors<T> factors(a, pull);
  Vec3<T> x = factors.solve({pull * m.x - b.x, pull * m.y - b.y, pull * m.z - b.z});
  const Vec3<T> u = factors.solve(area);
  const T slope = dot(area, u);
  const T step = slope > 0 ? (volume - dot(area, x)) / slope : T{};
  x = {x.x + step * u.x, x.y + step * u.y, x.z + step * u.z};
  const Vec3<T> far = {x.x - m.x, x.y - m.y, x.z - m.z};
  near = dot(far, far) <= kFarthest * dot(offset, offset);
  return x;
}

Vec3f middle_or_end(const Quadric& q, Vec3f offset) {
  Vec3f best = offset * 0.5f;
  for (const Vec3f end : {Vec3f{}, offset})
    if (q.at(end) < q.at(best)) best = end;
  return best;
}

Double2 half_of(Float4 x, std::size_t half) {
  const Float2 two =
      half == 0 ? __builtin_shufflevector(x, x, 0, 1) : __builtin_shufflevector(x, x, 2, 3);
  return __builtin_convertvector(two, Double2);
}
Vec3<Double2> half_of(const Vec3x4& v, std::size_t half) {
  return {half_of(v.x, half), half_of(v.y, half), half_of(v.z, half)};
}
Vec3<double> widened(Vec3f a) { return {a.x, a.y, a.z}; }

}  // namespace

Vec3f best_place(const Quadric& q, const Volume& volume, Vec3f offset) {
  bool near = false;
  const Vec3<double> x =
      least<double>({q.xx, q.yy, q.zz, q.xy, q.xz, q.yz}, widened(q.b), widened(volume.area),
                    volume.constant, widened(offset), near);
  return near ? Vec3f{static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)}
              : middle_or_end(q, offset);
}

Vec3x4 best_place(const EdgeSums& s) {
  Vec3x4 place;
  for (std::size_t half = 0; half < 2; ++half) {
    const Matrix<Double2> matrix = {half_of(s.xx, half), half_of(s.yy, half), half_of(s.zz, half),
                                    half_of(s.xy, half), half_of(s.xz, half), half_of(s.yz, half)};
    decltype(Double2{} < Double2{}) near = {};
    const Vec3<Double2> x = least(matrix, half_of(s.b, half), half_of(s.area, half),
                                  half_of(s.volume, half), half_of(s.offset, half), near);
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t at = 2 * half + i;
      const Vec3f p = near[i] ? Vec3f{static_cast<float>(x.x[i]), static_cast<float>(x.y[i]),
                                      static_cast<float>(x.z[i])}
                              : middle_or_end(s.quadric(at), lane(s.offset, at));
      place.x[at] = p.x, place.y[at] = p.y, place.z[at] = p.z;
    }
  }
  return place;
}

void EdgeSums::add_plane(const Vec3x4& n, Float4 amount) {
  const Vec3x4 w = {n.x * amount, n.y * amount, n.z * amount};
  xx += w.x * n.x, yy += w.y * n.y, zz += w.z * n.z;
  xy += w.x * n.y, xz += w.x * n.z, yz += w.y * n.z;
  area = {area.x + w.x, area.y + w.y, area.z + w.z};
}

Float4 EdgeSums::at(const Vec3x4& p) const {
  const Vec3x4 a = {xx * p.x + xy * p.y + xz * p.z + 2 * b.x,
                    xy * p.x + yy * p.y + yz * p.z + 2 * b.y,
                    xz * p.x + yz * p.y + zz * p.z + 2 * b.z};
  return dot(p, a);
}

Quadric EdgeSums::quadric(std::size_t i) const {
  return {xx[i], yy[i], zz[i], xy[i], xz[i], yz[i], lane(b, i), 0};
}

}  // namespace pstrips::inline codecs
