#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/star_mesh.h"

// For formats/pstrip/payload/compact: what a function on a surface is expected to be at a point, by
// what it is at its neighbours. [spec/compact.md §7.3]

namespace pstrips::inline formats {

/// The plane of least squares through what neighbours have, over two of the axes. It is drawn a
/// little towards the mean, so that neighbours in a line tell nothing of what lies beside it.
///
/// Widths: arms 10 bits, sums of their products 24, numerators 62.
class PlaneFit {
 public:
  static constexpr unsigned kMost = 16;  ///< neighbours

  /// arms  kMost neighbours less the point at most
  /// up    the axis that is left out
  PlaneFit(std::span<const GridPoint> arms, unsigned up)
      : count_(static_cast<std::int64_t>(arms.size())) {
    place(arms, up);
    solve();
  }

  /// What a function is expected to be, and how well the plane agrees with the neighbours.
  struct Guess {
    std::int64_t value;
    std::uint64_t missed;  ///< mean square
  };
  /// value_of(i)  of neighbour i, 24 bits at most
  /// returns      zeros without neighbours
  template <class ValueOf>
  Guess of(ValueOf&& value_of) const {
    if (count_ == 0) return {0, 0};
    std::array<std::int64_t, kMost> value;  // less the first
    std::int64_t at_point = 0, along_a = 0, along_b = 0, sum = 0;
    for (unsigned i = 0; i < count_; ++i) {
      value[i] = value_of(i) - value_of(0u);
      at_point += share_[i] * value[i];
      along_a += slope_a_[i] * value[i];
      along_b += slope_b_[i] * value[i];
      sum += value[i];
    }
    const std::int64_t mean = sum / count_;
    std::uint64_t squares = 0;
    for (unsigned i = 0; i < count_; ++i) {
      const std::int64_t plane = mean + ((along_a * a_[i] + along_b * b_[i]) >> kShareBits);
      const std::int64_t off = std::clamp(value[i] - plane, -kFarthest, kFarthest);
      squares += static_cast<std::uint64_t>(off * off);
    }
    return {value_of(0u) + ((at_point + kHalf) >> kShareBits),
            squares / static_cast<std::uint64_t>(count_)};
  }

 private:
  static constexpr unsigned kShareBits = 14;
  static constexpr std::int64_t kHalf = std::int64_t{1} << (kShareBits - 1);
  static constexpr std::int64_t kFarthest = std::int64_t{1} << 28;
  static constexpr std::int64_t kStiffness = 32;

  void place(std::span<const GridPoint> arms, unsigned up) {
    constexpr unsigned kArmBits = 9;
    std::uint32_t farthest = 0;
    for (unsigned i = 0; i < count_; ++i) {
      const std::array<std::int32_t, 3> arm = {arms[i].x, arms[i].y, arms[i].z};
      a_[i] = arm[(up + 1) % 3];
      b_[i] = arm[(up + 2) % 3];
      farthest |= static_cast<std::uint32_t>(std::abs(a_[i]) | std::abs(b_[i]));
    }
    const auto bits = static_cast<unsigned>(std::bit_width(farthest));
    const unsigned excess = bits > kArmBits ? bits - kArmBits : 0;
    for (unsigned i = 0; i < count_; ++i) {
      mean_a_ += a_[i] >>= excess;
      mean_b_ += b_[i] >>= excess;
    }
    if (count_ == 0) return;
    mean_a_ /= count_;
    mean_b_ /= count_;
  }

  void solve() {
    std::int64_t aa = 0, ab = 0, bb = 0;
    for (unsigned i = 0; i < count_; ++i) {
      a_[i] -= static_cast<std::int32_t>(mean_a_);
      b_[i] -= static_cast<std::int32_t>(mean_b_);
      aa += std::int64_t{a_[i]} * a_[i];
      ab += std::int64_t{a_[i]} * b_[i];
      bb += std::int64_t{b_[i]} * b_[i];
    }
    const std::int64_t stiff = (aa + bb) / kStiffness + 1;
    aa += stiff;
    bb += stiff;
    const std::int64_t determinant = aa * bb - ab * ab, scale = std::int64_t{1} << kShareBits;
    const std::int64_t p = ab * mean_b_ - bb * mean_a_, q = ab * mean_a_ - aa * mean_b_;
    for (unsigned i = 0; i < count_; ++i) {
      slope_a_[i] = (bb * a_[i] - ab * b_[i]) * scale / determinant;
      slope_b_[i] = (aa * b_[i] - ab * a_[i]) * scale / determinant;
      share_[i] = scale / count_ + (p * a_[i] + q * b_[i]) * scale / determinant;
    }
  }

  std::int64_t count_, mean_a_ = 0, mean_b_ = 0;
  std::array<std::int32_t, kMost> a_, b_;
  std::array<std::int64_t, kMost> share_, slope_a_, slope_b_;
};

}  // namespace pstrips::inline formats
