#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "formats/pstrip/payload/compact/ring_geometry.h"

namespace pstrips::inline formats {

/// How far the neighbours on the new vertex's side of a chord and the vertex itself lie apart along
/// two axes: about as far as the new vertex may be from where it is expected, and in what
/// direction.
class NearSpread {
 public:
  /// places  from one end of the chord to the other
  NearSpread(const RingGeometry& geometry, unsigned from, unsigned places, unsigned u, unsigned v);

  /// Along u, in quarter octaves.
  unsigned first() const { return first_; }
  /// How far the new vertex is off along v if it is `off` along u.
  std::int64_t second_off(std::int64_t off) const { return (slope_ * off + 128) >> 8; }
  /// Along v, aside from that; in quarter octaves.
  unsigned second() const { return second_; }

 private:
  static constexpr unsigned kKept = 40;            // bits of a product
  static constexpr std::int64_t kSteepest = 4096;  // of a slope
  static constexpr std::int64_t kShare = 179;      // 0.7 of what a regression says

  unsigned first_, second_;
  std::int64_t slope_;  // in units of 2^-8
};

inline NearSpread::NearSpread(const RingGeometry& geometry, unsigned from, unsigned places,
                              unsigned u, unsigned v) {
  std::int64_t n = 1, sum_u = 0, sum_v = 0, uu = 0, uv = 0, vv = 0;
  unsigned i = from;
  for (unsigned left = places + 1; left > 0; --left) {
    const std::int64_t a = geometry.along(u, i), b = geometry.along(v, i);
    n += geometry.is_absent(i) ? 0 : 1;
    sum_u += a;
    sum_v += b;
    uu += a * a;
    uv += a * b;
    vv += b * b;
    i = i + 1 == geometry.size() ? 0 : i + 1;
  }
  // n^2 times the variances, 61 bits.
  uu = n * uu - sum_u * sum_u;
  uv = n * uv - sum_u * sum_v;
  vv = n * vv - sum_v * sum_v;
  const unsigned count = kCounts.length[static_cast<std::size_t>(n)];
  const auto size_of = [&](std::int64_t square, unsigned shift) {
    const unsigned all = half_octaves(static_cast<std::uint64_t>(square)) + 2 * shift;
    return all > count ? all - count : 0;
  };
  first_ = size_of(uu, 0);
  const auto bits =
      static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(std::max(uu, vv))));
  const unsigned shift = bits > kKept ? bits - kKept : 0;
  uu >>= shift;
  uv >>= shift;
  vv >>= shift;
  slope_ = std::clamp(kShare * uv / std::max(uu, std::int64_t{1}), -kSteepest, kSteepest);
  second_ = size_of(std::max(vv - (slope_ * uv >> 8), std::int64_t{1}), shift);
}

}  // namespace pstrips::inline formats
