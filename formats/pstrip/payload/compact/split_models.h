#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "formats/pstrip/payload/compact/rans.h"

namespace pstrips::inline formats {

/// log2 of n in half steps, rounded down; 0 for 0 and 1.
constexpr unsigned half_octaves(std::uint64_t n) {
  if (n < 2) return 0;
  const auto log = static_cast<unsigned>(std::bit_width(n)) - 1;
  return 2 * log + static_cast<unsigned>(n >> (log - 1) & 1);
}

/// Signed numbers: the bit length as a symbol, two leading bits learned, the rest as it is.
class NumberModel {
 public:
  /// |value| < 2^30.
  template <class Coder>
  std::int32_t code(Coder& coder, std::int32_t value) {
    const std::uint32_t size = static_cast<std::uint32_t>(value < 0 ? -value : value);
    std::uint32_t bits = static_cast<std::uint32_t>(std::bit_width(size));
    const bool is_long = bits >= kLong;
    bits = coder.symbol(length_, is_long ? kLong : bits);
    if (bits == 0) return 0;
    if (bits == kLong)
      bits = kLong +
             coder.raw(is_long ? static_cast<std::uint32_t>(std::bit_width(size)) - kLong : 0, 4);
    std::uint32_t magnitude = 1;  // the bits so far
    unsigned left = bits - 1;
    const auto learned = [&](BitModel& model) {
      --left;
      magnitude = magnitude << 1 | (coder.bit(model, size >> left & 1) ? 1u : 0u);
    };
    BitModel* const models = leading_[bits < kLong ? bits : kLong].data();
    if (left > 0) learned(models[0]);
    if (left > 0) learned(models[1 + (magnitude & 1)]);
    magnitude = magnitude << left | coder.raw(size & ((1u << left) - 1), left);
    const bool negative = coder.raw(value < 0 ? 1 : 0, 1) != 0;
    return negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
  }

 private:
  static constexpr unsigned kLong = 15;
  SymbolModel length_;
  std::array<std::array<BitModel, 3>, kLong + 1> leading_;
};

/// How far along the difference of two sector means a new vertex lies, learned: a fraction in
/// units of 2^-16.
class StepModel {
 public:
  std::int64_t fraction() const { return fraction_; }
  /// dot  of the step with the difference of the means; square  of that difference.
  void learn(std::int64_t dot, std::int64_t square) {
    constexpr std::int64_t kLargest = std::int64_t{1} << 40;
    if (square >= kLargest || dot >= kLargest || dot <= -kLargest) return;
    dots_ += dot;
    squares_ += square;
    if (squares_ >= kLargest) {
      dots_ >>= 1;
      squares_ >>= 1;
    }
    if ((++seen_ & 15) != 0 || squares_ == 0) return;
    fraction_ =
        std::clamp(dots_ * (1 << 16) / squares_, std::int64_t{-4 << 16}, std::int64_t{4 << 16});
  }

 private:
  std::int64_t dots_ = 0, squares_ = 0, fraction_ = (1 << 16) / 3;
  unsigned seen_ = 0;
};

/// All that is learned while the splits of a mesh go by; the same on both sides.
struct SplitModels {
  static constexpr unsigned kFaces = 16;    ///< of a vertex, more count as one less than this
  static constexpr unsigned kSplit = 8;     ///< neighbours split in this batch
  static constexpr unsigned kRings = 24;    ///< sizes of rings
  static constexpr unsigned kChoices = 12;  ///< how many chords there are
  static constexpr unsigned kLeads = 8;     ///< by how much the likeliest chord leads
  static constexpr unsigned kSectors = 6;
  static constexpr unsigned kSizes = 64;  ///< half octaves

  std::array<std::array<std::array<BitModel, kSplit>, kFaces>, 2> splits;  ///< new, faces, seen
  std::array<std::array<SymbolModel, kRings>, 3> sector;  ///< ring closed, open, none; its size
  std::array<std::array<SymbolModel, kLeads>, kChoices> chord;
  std::array<std::array<StepModel, kSectors>, 2> step;
  std::array<std::array<NumberModel, kSizes>, 2> tangential;  ///< first and second
  std::array<NumberModel, kSizes> normal;
  // Splits that are no chord of a ring.
  BitModel moves;
  SymbolModel faces;
  std::array<NumberModel, 3> free_step;
};

}  // namespace pstrips::inline formats
