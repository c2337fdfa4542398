#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "formats/pstrip/payload/compact/chord_weights.h"
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

/// Signed numbers about whose size something is known: the bit length as a symbol, by what is
/// known; two leading bits, by how the length compares with it; the rest and the sign as they are.
class ScaledNumberModel {
 public:
  /// |value| < 2^30. size  of the values that are expected, in quarter octaves
  template <class Coder>
  std::int32_t code(Coder& coder, std::int32_t value, unsigned size) {
    const auto magnitude = static_cast<std::uint32_t>(value < 0 ? -value : value);
    const auto wanted = static_cast<std::uint32_t>(std::bit_width(magnitude));
    unsigned bits = coder.symbol(lengths_[std::min(size / 3, kSizes - 1)], std::min(wanted, kLong));
    if (bits == 0) return 0;
    if (bits == kLong) bits += coder.raw(wanted - kLong, 4);
    const unsigned relative = 4 * bits + 40 > size ? (4 * bits + 40 - size) / 4 : 0;
    BitModel* const leading = leading_[bits == 2 ? 1 : 0][std::min(relative, kRelative - 1)].data();
    std::uint32_t coded = 1;  // the bits so far
    unsigned left = bits - 1;
    for (unsigned depth = 0; depth < 2 && left > 0; ++depth) {
      --left;
      BitModel& model = leading[depth == 0 ? 0 : coded - 1];
      coded = coded << 1 | (coder.bit(model, magnitude >> left & 1) ? 1u : 0u);
    }
    // The rest and the sign, which is last, at once where they fit a step.
    const std::uint32_t rest = (magnitude & ((1u << left) - 1)) << 1 | (value < 0 ? 1u : 0u);
    const std::uint32_t last = coder.raw(rest, left + 1);
    const auto size_of = static_cast<std::int32_t>(coded << left | last >> 1);
    return (last & 1) != 0 ? -size_of : size_of;
  }

 private:
  static constexpr std::uint32_t kLong = 15;
  static constexpr unsigned kSizes = 32, kRelative = 32;
  std::array<SymbolModel, kSizes> lengths_;
  std::array<std::array<std::array<BitModel, 3>, kRelative>, 2> leading_;
};

/// All that is learned while the splits of a mesh go by; the same on both sides.
struct SplitModels {
  explicit SplitModels(Placement placement) : chord(placement) {}

  static constexpr unsigned kFaces = 16;  ///< of a vertex, more count as one less than this
  static constexpr unsigned kSplit = 8;   ///< neighbours split in this batch
  static constexpr unsigned kRings = 24;  ///< sizes of rings

  std::array<std::array<std::array<BitModel, kSplit>, kFaces>, 2> splits;  ///< new, faces, seen
  std::array<std::array<SymbolModel, kRings>, 3> sector;  ///< ring closed, open, none; its size
  ChordWeights chord;
  std::array<ScaledNumberModel, 2> tangential;  ///< first and second
  ScaledNumberModel normal;
  // Splits that are no chord of a ring.
  BitModel moves;
  SymbolModel faces;
  std::array<NumberModel, 3> free_step;
};

}  // namespace pstrips::inline formats
