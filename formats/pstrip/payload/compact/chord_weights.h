#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/progressive_strips.h"

namespace pstrips::inline formats {

/// How likely the chords of a ring are, learned: a sum of weights for what is seen of a chord, each
/// from a table, is the logarithm of its probability but for a constant.
class ChordWeights {
 public:
  static constexpr unsigned kClasses = 24;
  static constexpr unsigned kOneBit = 1u << 11;  ///< in units of a weight
  enum Kind : unsigned {
    ends,    ///< a neighbour where the chord ends, by its distance; the last is for an absent one
    near,    ///< the side that the new vertex gets, by the distance of its mean
    far,     ///< the other side, ends included as well
    length,  ///< the near side, by the mean of its distances
    faces,   ///< a neighbour where the chord ends, by the number of its faces; the last as above
    turns,   ///< a neighbour where the chord ends, by its Turn; the last as above
    kKinds,
  };

  explicit ChordWeights(Placement placement);

  std::int32_t of(Kind kind, unsigned index) const { return weights_[kind][index]; }
  /// slope  what happened less its probability, of 2^15; up to 2^16 either way
  void learn(Kind kind, unsigned index, std::int32_t slope) {
    constexpr std::int32_t kLargest = 8 * kOneBit - 1;
    std::int16_t& weight = weights_[kind][index];
    weight = static_cast<std::int16_t>(
        std::clamp(weight + ((slope + (1 << 8)) >> 9), -kLargest, kLargest));
  }

 private:
  std::array<std::array<std::int16_t, kClasses>, kKinds> weights_;
};

using ChordWeightTable =
    std::array<std::array<std::int8_t, ChordWeights::kClasses>, ChordWeights::kKinds>;
// What 13 scanned, modelled and CAD meshes taught, in 1/32 of a bit.
// clang-format off
inline constexpr ChordWeightTable kSubsetChords = {{
    {36, 49, 53, 54, 54, 54, 51, 49, 36, 32, 31, 53, 48, 46, 36, 38, 26, 18, 5, -7, -22, -34, -68, 36},
    {-63, -63, -59, -48, -54, -63, -64, -40, -41, -28, -11, -25, -19, -17, 4, -3, -1, 0, 6, 12, 21, 22, 17, 30},
    {95, 53, 49, 39, 44, 38, 36, 35, 32, 28, 23, 16, 4, 8, -6, -13, -26, -46, -61, -78, -93, -94, -43, -1},
    {-54, -43, -50, -55, -49, -49, -50, -55, -54, -54, -52, -42, -35, -21, -5, 12, 31, 49, 65, 77, 76, 45, 21, 9},
    {0, 0, 30, 9, 3, 17, -20, 1, -22, -10, -7, 0, -1, 5, 5, 9, 16, 1, -7, 0, 0, 0, 0, 36},
    {20, 25, -18, -25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
}};
inline constexpr ChordWeightTable kOptimalChords = {{
    {48, 49, 57, 49, 67, 69, 68, 74, 86, 82, 49, 33, 31, 63, 46, 51, 37, 23, 5, -14, -38, -48, -91, 26},
    {-5, -2, 5, 9, 9, 22, 43, 41, 49, 41, 40, 39, 35, 35, 36, 17, 5, -15, -26, -47, -60, -50, -19, 0},
    {-30, -40, -36, -33, -30, -12, 8, 5, -2, -12, -7, -6, -4, 10, 17, 19, 15, 0, -29, -36, -41, -14, 0, 0},
    {-10, -23, -20, -32, -34, -33, -42, -48, -50, -39, -30, -22, -13, -1, 4, 8, 10, 10, 17, 15, 6, 3, -2, 0},
    {0, -11, 14, -1, -5, 16, -24, 3, -17, -1, 5, 11, 12, 18, 14, 15, 15, 1, -3, 0, 0, 0, 0, 26},
    {20, 25, -18, -25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
}};
// clang-format on

inline ChordWeights::ChordWeights(Placement placement) {
  const ChordWeightTable& table = placement == Placement::subset ? kSubsetChords : kOptimalChords;
  for (unsigned kind = 0; kind < kKinds; ++kind)
    for (unsigned i = 0; i < kClasses; ++i)
      weights_[kind][i] = static_cast<std::int16_t>(table[kind][i] * std::int32_t{kOneBit / 32});
}

}  // namespace pstrips::inline formats
