#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "formats/pstrip/payload/compact/chord_weights.h"
#include "formats/pstrip/payload/compact/ring_geometry.h"
#include "formats/pstrip/payload/compact/split_state.h"

namespace pstrips::inline formats {

/// The chords of a ring that give the new vertex so many places: what is seen of each, and how
/// probable the weights make it.
class ChordChoice {
 public:
  /// side    faces that the new vertex gets
  /// chords  that count: those from the neighbours 0 to chords - 1 on
  ChordChoice(const SplitState& state, const VertexRing& ring, const RingGeometry& geometry,
              unsigned side, unsigned chords);

  const Shares& shares() const { return shares_; }
  /// A step up the slope of the logarithm of the probability of what was chosen.
  void learn(ChordWeights& weights, unsigned chosen) const;

 private:
  static constexpr unsigned kSize = VertexRing::kMaxSize;
  static constexpr unsigned kLast = ChordWeights::kClasses - 1;  ///< an absent end
  using Classes = std::array<std::uint8_t, kSize>;

  void see_ends(const SplitState& state, const VertexRing& ring, const RingGeometry& geometry);
  void see_sides(const RingGeometry& geometry);
  Shares weighed(const ChordWeights& weights) const;

  unsigned size_, side_, chords_;
  Classes end_, faces_, turn_;   // of neighbours
  Classes near_, far_, length_;  // of chords, by the neighbour where they start
  Shares shares_;
};

/// A length beside the mean of the ring, both in quarter octaves.
inline unsigned length_class(int length, unsigned mean) {
  return static_cast<unsigned>(
      std::clamp(length - static_cast<int>(mean) + 20, 0, int{ChordWeights::kClasses} - 1));
}

/// The length of the mean of a run.
inline int mean_length(const RingGeometry::Run& run) {
  return static_cast<int>(half_octaves(RingGeometry::square_of(run.sum))) -
         kCounts.length[run.count];
}

/// 2^-(bits / kOneBit) in units of 2^-15, to a quarter percent.
inline std::uint32_t power_of_half(std::int32_t bits) {
  static_assert(ChordWeights::kOneBit == 1u << 11);
  const auto whole = static_cast<unsigned>(bits) >> 11;
  if (whole > 15) return 0;
  const std::uint32_t x = (1u << 11) - (static_cast<unsigned>(bits) & ((1u << 11) - 1));
  return ((1u << 15) + (x * (21547 + (x * 11221 >> 11)) >> 11)) >> (whole + 1);
}

inline ChordChoice::ChordChoice(const SplitState& state, const VertexRing& ring,
                                const RingGeometry& geometry, unsigned side, unsigned chords)
    : size_(ring.size), side_(side), chords_(chords) {
  see_ends(state, ring, geometry);
  see_sides(geometry);
  shares_ = weighed(state.models.chord);
}

inline void ChordChoice::see_ends(const SplitState& state, const VertexRing& ring,
                                  const RingGeometry& geometry) {
  for (unsigned i = 0; i < size_; ++i) {
    if (geometry.is_absent(i)) {
      end_[i] = faces_[i] = turn_[i] = kLast;
      continue;
    }
    const auto length = static_cast<int>(geometry.length(i));
    end_[i] =
        static_cast<std::uint8_t>(std::min(length_class(length, geometry.length()), kLast - 1));
    faces_[i] =
        static_cast<std::uint8_t>(std::min(state.mesh.face_count_of(ring.vertex[i]), kLast - 1));
    turn_[i] = static_cast<std::uint8_t>(state.turn[ring.vertex[i]]);
  }
}

inline void ChordChoice::see_sides(const RingGeometry& geometry) {
  const unsigned mean = geometry.length();
  RingGeometry::Run near = geometry.run(0, side_ + 1);
  for (unsigned from = 0, to = side_; from < chords_; ++from) {
    const RingGeometry::Run far = geometry.rest_of(near, from, to);
    near_[from] = static_cast<std::uint8_t>(length_class(mean_length(near), mean));
    far_[from] = static_cast<std::uint8_t>(length_class(mean_length(far), mean));
    // Twice as fine.
    const auto lengths =
        static_cast<int>(2 * near.lengths * (kCounts.reciprocal[near.count] + 1) >> 16);
    length_[from] = static_cast<std::uint8_t>(length_class(lengths - 4, 2 * mean));
    to = to + 1 == size_ ? 0 : to + 1;
    geometry.move_on(near, from, to);
  }
}

inline Shares ChordChoice::weighed(const ChordWeights& weights) const {
  std::array<std::int32_t, kSize> of_end, bits;
  for (unsigned i = 0; i < size_; ++i)
    of_end[i] = weights.of(ChordWeights::ends, end_[i]) +
                weights.of(ChordWeights::faces, faces_[i]) +
                weights.of(ChordWeights::turns, turn_[i]);
  std::int32_t most = 0;
  for (unsigned i = 0, to = side_; i < chords_; ++i, to = to + 1 == size_ ? 0 : to + 1) {
    bits[i] = of_end[i] + of_end[to] + weights.of(ChordWeights::near, near_[i]) +
              weights.of(ChordWeights::far, far_[i]) + weights.of(ChordWeights::length, length_[i]);
    most = i == 0 ? bits[0] : std::max(most, bits[i]);
  }
  std::array<std::uint32_t, kSize> weight;
  for (unsigned i = 0; i < chords_; ++i) weight[i] = power_of_half(most - bits[i]);
  return Shares(std::span(weight).first(chords_));
}

inline void ChordChoice::learn(ChordWeights& weights, unsigned chosen) const {
  std::array<std::int32_t, kSize> slope;
  for (unsigned i = 0; i < size_; ++i) slope[i] = 0;
  for (unsigned i = 0, to = side_; i < chords_; ++i, to = to + 1 == size_ ? 0 : to + 1) {
    const std::int32_t own = (i == chosen ? static_cast<std::int32_t>(kShares) : 0) -
                             static_cast<std::int32_t>(shares_.of(i));
    weights.learn(ChordWeights::near, near_[i], own);
    weights.learn(ChordWeights::far, far_[i], own);
    weights.learn(ChordWeights::length, length_[i], own);
    slope[i] += own;
    slope[to] += own;
  }
  for (unsigned i = 0; i < size_; ++i) {
    weights.learn(ChordWeights::ends, end_[i], slope[i]);
    weights.learn(ChordWeights::faces, faces_[i], slope[i]);
    weights.learn(ChordWeights::turns, turn_[i], slope[i]);
  }
}

}  // namespace pstrips::inline formats
