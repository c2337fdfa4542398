#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "codecs/simplify/quadric.h"

namespace pstrips::inline codecs {

/// Four numbers side by side, as the compiler's own vectors: arithmetic and comparisons work lane
/// by lane, `mask ? a : b` chooses.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 all4(float x) { return Float4{x, x, x, x}; }
inline Float4 sqrt4(Float4 x) {
  return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }
inline float sum4(Float4 x) { return (x[0] + x[1]) + (x[2] + x[3]); }
inline Float4 load4(const void* four_floats) {
  Float4 x;
  std::memcpy(&x, four_floats, sizeof x);
  return x;
}
/// Whether any lane of a mask is set.
inline bool any4(Int4 mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }

/// Four vectors.
using Vec3x4 = Vec3<Float4>;
inline Vec3x4 operator-(const Vec3x4& a, Vec3f b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float4 dot(const Vec3x4& a, Vec3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3f lane(const Vec3x4& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }

/// Turns rows into columns: lane i of the k-th result is lane k of row i.
inline void transpose4(Float4& a, Float4& b, Float4& c, Float4& d) {
  const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

}  // namespace pstrips::inline codecs
