#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "formats/pstrip/payload/compact/chord_choice.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/compact/step_guess.h"

namespace pstrips::inline formats {

/// All chords of a ring, what is seen of each, and how probable the weights make it. First the
/// places of the near side are chosen, by the sums over their chords, then where it starts.
class MixedChords {
 public:
  /// ring  of two places at least
  MixedChords(const SplitState& state, const VertexRing& ring, const RingGeometry& geometry);

  unsigned side_of(const GridSplit& split) const { return ring_.places(split.from, split.to); }
  /// How many chords have a near side of so many places.
  unsigned places(unsigned side) const {
    return optimal_ && 2 * side == ring_.size ? side : ring_.size;
  }
  Shares shares_of_sides() const;
  Shares shares_of_places(unsigned side) const;
  /// A step up the slope of the logarithm of the probability of what was chosen.
  void learn(MixedChordWeights& weights, unsigned from, unsigned side) const;

 private:
  using W = MixedChordWeights;
  using Vector = StepGuess::Vector;
  static constexpr unsigned kSize = VertexRing::kMaxSize, kMostSide = 15;
  static constexpr unsigned kAtEnd = 5, kOfChord = 10, kDistances = 4;
  struct Chord {
    std::array<std::uint16_t, kOfChord> seen;  // places among the weights
    std::int32_t bits;
    std::uint32_t weight;  // its probability, but for a factor
  };
  /// What goes with a near side while it is taken round the ring.
  struct NearSide {
    RingGeometry::Run run;
    Vector normal;
    unsigned bends;
  };

  void see_faces();
  void see_places(const SplitState& state);
  unsigned bend(const Vector& a, const Vector& b) const;
  unsigned angle(unsigned place) const;
  NearSide near_side(unsigned side) const;
  void move_on(NearSide& near, unsigned from, unsigned side) const;
  void see_chords(Placement placement, unsigned side);
  void see_distances(Chord& chord, const NearSide& near, const StepWeights& weights, unsigned from,
                     unsigned side) const;
  void weigh(const W& weights);

  unsigned round(unsigned i) const { return i < ring_.size ? i : i - ring_.size; }
  const Chord& chord(unsigned from, unsigned side) const { return chords_[first_[side] + from]; }

  const VertexRing& ring_;
  const RingGeometry& geometry_;
  bool optimal_;
  unsigned most_side_;
  std::array<Vector, kSize> normal_;  // of faces, 24 bits
  Vector all_normals_{};
  std::array<std::uint8_t, kSize> bend_;
  std::array<std::array<std::uint16_t, kAtEnd>, kSize> at_end_;
  std::array<unsigned, kMostSide + 2> first_;  // chord of each side
  std::vector<Chord> chords_;
};

inline std::uint64_t square_of(const StepGuess::Vector& v) {
  return static_cast<std::uint64_t>(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

inline MixedChords::MixedChords(const SplitState& state, const VertexRing& ring,
                                const RingGeometry& geometry)
    : ring_(ring), geometry_(geometry), optimal_(state.placement == Placement::optimal) {
  most_side_ = std::min(optimal_ ? ring.size / 2 : ring.size - 1, kMostSide);
  see_faces();
  see_places(state);
  chords_.reserve(std::size_t{most_side_} * ring.size);
  for (unsigned side = 1; side <= most_side_; ++side) see_chords(state.placement, side);
  first_[most_side_ + 1] = static_cast<unsigned>(chords_.size());
  weigh(state.mixed->chord);
}

inline void MixedChords::see_faces() {
  std::uint64_t largest = 0;
  for (unsigned i = 0; i < ring_.size; ++i) {
    normal_[i] = {};
    if (ring_.corner[i] == kNone) continue;
    normal_[i] = face_normal(geometry_, i);
    for (const std::int64_t x : normal_[i])
      largest = std::max(largest, static_cast<std::uint64_t>(x < 0 ? -x : x));
  }
  const auto bits = static_cast<unsigned>(std::bit_width(largest));
  const unsigned shift = bits > 24 ? bits - 24 : 0;
  for (unsigned i = 0; i < ring_.size; ++i)
    for (unsigned k = 0; k < 3; ++k) all_normals_[k] += normal_[i][k] >>= shift;
}

/// 0 flat to 21 a right angle, 22 more.
inline unsigned MixedChords::bend(const Vector& a, const Vector& b) const {
  const auto short_of = [](Vector v) {
    std::uint64_t largest = 0;
    for (const std::int64_t x : v)
      largest = std::max(largest, static_cast<std::uint64_t>(x < 0 ? -x : x));
    const auto bits = static_cast<unsigned>(std::bit_width(largest));
    for (std::int64_t& x : v) x >>= bits > 15 ? bits - 15 : 0;
    return v;
  };
  const Vector m = short_of(a), n = short_of(b);
  if (m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < 0) return 22;
  const Vector cross = {m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2],
                        m[0] * n[1] - m[1] * n[0]};
  const int sine = static_cast<int>(half_octaves(square_of(cross))) -
                   static_cast<int>(half_octaves(square_of(m)) + half_octaves(square_of(n)));
  return static_cast<unsigned>(std::clamp((3 * sine >> 2) + 21, 0, 21));
}

/// Of the ring at a place: 0 straight back, 11 right, 22 straight on, by cosines.
inline unsigned MixedChords::angle(unsigned place) const {
  const GridPoint at = geometry_.arm(place),
                  a = geometry_.arm(place == 0 ? ring_.size - 1 : place - 1) - at,
                  b = geometry_.arm(ring_.next(place)) - at;
  const std::int64_t dot =
      std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z;
  const auto length = [](std::uint64_t square) { return static_cast<int>(half_octaves(square)); };
  const int cosine = 2 * length(static_cast<std::uint64_t>(dot < 0 ? -dot : dot)) -
                     length(RingGeometry::square_of(a)) - length(RingGeometry::square_of(b));
  const int off = std::clamp(cosine + 11, 0, 11);
  return static_cast<unsigned>(dot < 0 ? 11 + off : 11 - off);
}

inline void MixedChords::see_places(const SplitState& state) {
  constexpr unsigned kLast = W::kClasses - 1;
  const unsigned mean = geometry_.length();
  for (unsigned i = 0; i < ring_.size; ++i) {
    const unsigned before = i == 0 ? ring_.size - 1 : i - 1;
    const bool inside = ring_.corner[i] != kNone && ring_.corner[before] != kNone;
    bend_[i] = static_cast<std::uint8_t>(inside ? bend(normal_[before], normal_[i]) : kLast);
    const bool absent = geometry_.is_absent(i);
    const Index vertex = ring_.vertex[i];
    const std::array<std::pair<unsigned, unsigned>, kAtEnd> seen = {{
        {ChordWeights::ends,
         absent ? kLast
                : std::min(length_class(static_cast<int>(geometry_.length(i)), mean), kLast - 1)},
        {ChordWeights::faces,
         absent ? kLast : std::min(state.mesh.face_count_of(vertex), kLast - 1)},
        {ChordWeights::turns, absent ? kLast : static_cast<unsigned>(state.turn[vertex])},
        {W::bends, bend_[i]},
        {W::angles, angle(i)},
    }};
    for (unsigned k = 0; k < kAtEnd; ++k)
      at_end_[i][k] = static_cast<std::uint16_t>(W::at(seen[k].first, seen[k].second));
  }
}

/// The one that starts at the first place.
inline MixedChords::NearSide MixedChords::near_side(unsigned side) const {
  NearSide out{geometry_.run(0, side + 1), {}, 0};
  for (unsigned i = 0; i < side; ++i) {
    for (unsigned k = 0; k < 3; ++k) out.normal[k] += normal_[i][k];
    if (i > 0) out.bends += bend_[i];
  }
  return out;
}

/// From `from` to the next place.
inline void MixedChords::move_on(NearSide& near, unsigned from, unsigned side) const {
  const unsigned to = round(from + side);
  geometry_.move_on(near.run, from, round(from + side + 1));
  for (unsigned k = 0; k < 3; ++k) near.normal[k] += normal_[to][k] - normal_[from][k];
  if (side > 1) near.bends += bend_[to] - bend_[round(from + 1)];
}

inline void MixedChords::see_chords(Placement placement, unsigned side) {
  const unsigned mean = geometry_.length(), rest = ring_.size - side;
  const StepWeights& weights = step_weights(placement, ring_.open, side, rest);
  const auto all = static_cast<int>(half_octaves(square_of(all_normals_)));
  first_[side] = static_cast<unsigned>(chords_.size());
  NearSide near = near_side(side);
  for (unsigned from = 0; from < places(side); ++from) {
    const RingGeometry::Run far = geometry_.rest_of(near.run, from, round(from + side));
    const auto lengths =
        static_cast<int>(2 * near.run.lengths * (kCounts.reciprocal[near.run.count] + 1) >> 16);
    const int area = static_cast<int>(half_octaves(square_of(near.normal))) - all + 20;
    const std::array<std::pair<unsigned, unsigned>, kOfChord - kDistances> seen = {{
        {ChordWeights::near, length_class(mean_length(near.run), mean)},
        {ChordWeights::far, length_class(mean_length(far), mean)},
        {ChordWeights::length, length_class(lengths - 4, 2 * mean)},
        {W::inner, side > 1 ? near.bends / (side - 1) : W::kClasses - 1},
        {W::areas, static_cast<unsigned>(std::clamp(area, 0, 23)) * W::kAreaPlaces +
                       std::min(side, W::kAreaPlaces - 1)},
        {W::sizes, std::min(ring_.size, W::kClasses - 1) * W::kSides + side},
    }};
    Chord& out = chords_.emplace_back();
    for (unsigned k = 0; k < seen.size(); ++k)
      out.seen[k] = static_cast<std::uint16_t>(W::at(seen[k].first, seen[k].second));
    see_distances(out, near, weights, from, side);
    move_on(near, from, side);
  }
}

/// From where the new vertex is expected to the near side.
inline void MixedChords::see_distances(Chord& chord, const NearSide& near,
                                       const StepWeights& weights, unsigned from,
                                       unsigned side) const {
  const unsigned to = round(from + side), mean = geometry_.length();
  const std::array<Vector, 3> means = means_beside(geometry_, near.run, from, to);
  Vector expected;
  for (unsigned k = 0; k < 3; ++k)
    expected[k] = (means[0][k] * weights.across[0] + means[1][k] * weights.across[1] +
                   means[2][k] * weights.across[2] + (1 << 15)) >>
                  16;
  const auto distance = [&](unsigned i) {
    return square_of(Vector{expected[0] - geometry_.along(0, i),
                            expected[1] - geometry_.along(1, i),
                            expected[2] - geometry_.along(2, i)});
  };
  const auto class_of = [&](std::uint64_t square) {
    return length_class(static_cast<int>(half_octaves(square)), mean);
  };
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max(), most = 0;
  for (unsigned i = from, left = side + 1; left > 0; --left, i = ring_.next(i)) {
    const std::uint64_t square = distance(i);
    least = std::min(least, square);
    most = std::max(most, square);
  }
  const auto of_end = [&](unsigned i) {
    return geometry_.is_absent(i) ? W::kClasses - 1
                                  : std::min(class_of(distance(i)), W::kClasses - 2);
  };
  chord.seen[6] = static_cast<std::uint16_t>(W::at(W::to_ends, of_end(from)));
  chord.seen[7] = static_cast<std::uint16_t>(W::at(W::to_ends, of_end(to)));
  chord.seen[8] = static_cast<std::uint16_t>(W::at(W::nearest, class_of(least)));
  chord.seen[9] = static_cast<std::uint16_t>(W::at(W::farthest, class_of(most)));
}

inline void MixedChords::weigh(const W& weights) {
  std::array<std::int32_t, kSize> of_end;
  for (unsigned i = 0; i < ring_.size; ++i) {
    of_end[i] = 0;
    for (const unsigned place : at_end_[i]) of_end[i] += weights[place];
  }
  std::int32_t most = std::numeric_limits<std::int32_t>::min();
  for (unsigned side = 1; side <= most_side_; ++side)
    for (unsigned from = 0; from < places(side); ++from) {
      Chord& out = chords_[first_[side] + from];
      out.bits = of_end[from] + of_end[round(from + side)];
      for (const unsigned place : out.seen) out.bits += weights[place];
      most = std::max(most, out.bits);
    }
  for (Chord& chord : chords_) chord.weight = power_of_half((most - chord.bits) >> 1);
}

inline Shares MixedChords::shares_of_sides() const {
  std::array<std::uint32_t, kMostSide> sums;
  for (unsigned side = 1; side <= most_side_; ++side) {
    sums[side - 1] = 0;
    for (unsigned i = first_[side]; i < first_[side + 1]; ++i) sums[side - 1] += chords_[i].weight;
  }
  return Shares(std::span(sums).first(most_side_));
}

inline Shares MixedChords::shares_of_places(unsigned side) const {
  const std::span<const Chord> chords(&chords_[first_[side]], places(side));
  std::int32_t most = chords[0].bits;
  for (const Chord& chord : chords) most = std::max(most, chord.bits);
  std::array<std::uint32_t, kSize> weights;
  for (unsigned i = 0; i < chords.size(); ++i)
    weights[i] = power_of_half((most - chords[i].bits) >> 1);
  return Shares(std::span(weights).first(chords.size()));
}

inline void MixedChords::learn(W& weights, unsigned from, unsigned side) const {
  std::uint32_t sum = 0;
  for (const Chord& chord : chords_) sum += chord.weight;
  const std::uint32_t scale = (1u << 30) / sum;
  std::array<std::int32_t, kSize> slope{};
  for (unsigned s = 1; s <= most_side_; ++s)
    for (unsigned i = 0; i < places(s); ++i) {
      const Chord& seen = chord(i, s);
      const std::int32_t own = (s == side && i == from ? static_cast<std::int32_t>(kShares) : 0) -
                               static_cast<std::int32_t>(seen.weight * scale >> 15);
      if (W::teaches(own))
        for (const unsigned place : seen.seen) weights.learn(place, own);
      slope[i] += own;
      slope[round(i + s)] += own;
    }
  for (unsigned i = 0; i < ring_.size; ++i)
    for (const unsigned place : at_end_[i]) weights.learn(place, slope[i]);
}

}  // namespace pstrips::inline formats
