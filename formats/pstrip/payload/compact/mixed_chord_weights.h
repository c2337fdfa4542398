#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "formats/pstrip/payload/compact/chord_weights.h"

namespace pstrips::inline formats {

/// How likely all chords of a ring are, learned: as ChordWeights, with more that is seen.
class MixedChordWeights {
 public:
  static constexpr unsigned kOneBit = 1u << 12;  ///< in units of a weight
  static constexpr unsigned kClasses = ChordWeights::kClasses;
  /// Those of ChordWeights come first.
  enum Kind : unsigned {
    bends = ChordWeights::kKinds,  ///< a neighbour where the chord ends: how the faces beside it
                                   ///< bend; the last is for a missing face
    angles,                        ///< the same, the corner that the ring makes there
    to_ends,                       ///< how far from each end the new vertex is expected
    inner,                         ///< how the faces bend inside the near side, on average
    nearest,   ///< the least distance from the near side at which the new vertex is expected
    farthest,  ///< the largest
    areas,     ///< the share of the near side's faces, by its places
    sizes,     ///< places of the ring, by those of the near side
    kKinds,
  };
  static constexpr unsigned kAreaPlaces = 8, kSides = 16;

  explicit MixedChordWeights(Placement placement);

  /// A place among all weights.
  static constexpr unsigned at(unsigned kind, unsigned index) {
    return (kind > areas ? kClasses * (areas + kAreaPlaces) : kClasses * kind) + index;
  }
  std::int32_t operator[](unsigned place) const { return weights_[place]; }
  /// Whether learn() changes anything: most chords are hardly probable.
  static constexpr bool teaches(std::int32_t slope) { return slope < -(1 << 8) || slope >= 1 << 8; }
  /// slope  what happened less its probability, of 2^15; up to 2^16 either way
  void learn(unsigned place, std::int32_t slope) {
    constexpr std::int32_t kLargest = 8 * kOneBit - 1;
    std::int32_t& weight = weights_[place];
    weight = std::clamp(weight + ((slope + (1 << 8)) >> 9), -kLargest, kLargest);
  }

 private:
  std::array<std::int32_t, kClasses*(areas + kAreaPlaces + kSides)> weights_{};
};

inline MixedChordWeights::MixedChordWeights(Placement placement) {
  const ChordWeightTable& table = placement == Placement::subset ? kSubsetChords : kOptimalChords;
  for (unsigned kind = 0; kind < table.size(); ++kind)
    for (unsigned i = 0; i < kClasses; ++i)
      weights_[at(kind, i)] = table[kind][i] * std::int32_t{kOneBit / 32};
}

}  // namespace pstrips::inline formats
