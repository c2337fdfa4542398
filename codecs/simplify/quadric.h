#pragma once

#include "core/vec3.h"

namespace pstrips::inline codecs {

using Vec3f = Vec3<float>;

/// Sum of weighted squared distances to planes, x'Ax + 2b'x, with x relative to the vertex that
/// owns it. [Garland97 §3.4] The constant term is kept by the owner: it is the error where the
/// owner stands. Being relative keeps the terms small, and single precision good.
struct Quadric {
  float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  Vec3f b;
  float weight = 0;  ///< of all planes and lines

  /// Adds the plane through the owner with this unit normal.
  void add_plane(Vec3f normal, float amount) {
    weight += amount;
    const Vec3f w = normal * amount;
    xx += w.x * normal.x, yy += w.y * normal.y, zz += w.z * normal.z;
    xy += w.x * normal.y, xz += w.x * normal.z, yz += w.y * normal.z;
  }

  /// Adds the line through the owner in this direction, of unit length.
  void add_line(Vec3f direction, float amount) {
    add_plane(direction, -amount);
    xx += amount, yy += amount, zz += amount;
    weight += 2 * amount;
  }

  Vec3f times(Vec3f d) const {
    return {xx * d.x + xy * d.y + xz * d.z, xy * d.x + yy * d.y + yz * d.z,
            xz * d.x + yz * d.y + zz * d.z};
  }
  /// Without the constant term.
  float at(Vec3f d) const {
    const Vec3f a = times(d);
    return dot(d, {a.x + 2 * b.x, a.y + 2 * b.y, a.z + 2 * b.z});
  }

  /// The owner moves. Its constant term grows by at(offset), taken before.
  void move(Vec3f offset) {
    const Vec3f a = times(offset);
    b.x += a.x, b.y += a.y, b.z += a.z;
  }

  /// Adds the quadratic terms and the weight of another.
  void add_matrix(const Quadric& other) {
    xx += other.xx, yy += other.yy, zz += other.zz;
    xy += other.xy, xz += other.xz, yz += other.yz;
    weight += other.weight;
  }

  /// Adds one whose owner stands at `offset` from this one's. The constant term of the sum grows by
  /// other.at(-offset).
  void add(const Quadric& other, Vec3f offset) {
    const Vec3f a = other.times(offset);
    add_matrix(other);
    b.x += other.b.x - a.x, b.y += other.b.y - a.y, b.z += other.b.z - a.z;
  }
};

}  // namespace pstrips::inline codecs
