#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "formats/pstrip/payload/compact/chord_choice.h"
#include "formats/pstrip/payload/compact/mixed_chords.h"
#include "formats/pstrip/payload/compact/near_spread.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/compact/step_guess.h"

// For formats/pstrip/payload/compact: a split with the effort `small`. The coder is as in
// formats/pstrip/payload/compact/split_code.h. [spec/compact.md §6.6]

namespace pstrips::inline formats {

/// A difference with an offset, within 0 to most.
inline unsigned shifted(int difference, int offset, int most) {
  return static_cast<unsigned>(std::clamp(difference + offset, 0, most));
}

/// Whether a vertex splits.
template <class Coder>
bool code_mixed_flag(Coder& coder, SplitState& state, Index vertex, bool value) {
  MixedModels& models = *state.mixed;
  VertexRing ring;
  state.mesh.ring_of(vertex, ring);
  const RingGeometry geometry(state, vertex, ring);
  const unsigned recent = state.turn[vertex] == Turn::waits_recent ? 1 : 0;
  const unsigned faces = std::min(state.mesh.face_count_of(vertex), 15u);
  const unsigned split = std::min<unsigned>(state.split_around[vertex], 7);
  unsigned passed = 0;
  for (unsigned i = 0; i < ring.size; ++i)
    if (ring.vertex[i] != kNone && state.turn[ring.vertex[i]] == Turn::passed) ++passed;
  passed = std::min(passed, 7u);
  const unsigned age = std::min(models.batch - models.trace[vertex].batch, 15u);
  const auto length = static_cast<int>(geometry.length());
  const unsigned size = shifted(length, 12 - static_cast<int>(models.usual_length), 23);
  const unsigned off_centre =
      ring.size == 0 ? 0 : shifted(mean_length(geometry.all()), 20 - length, 31);
  const unsigned bent = shifted(state.normal_error[vertex], 20 - length, 39);

  auto& counters = models.splits;
  const bool out = models.splits_mixer.code(
      coder,
      {&counters[0][(recent * 16 + faces) * 8 + split], &counters[1][faces * 24 + size],
       &counters[2][(age * 8 + split) * 8 + passed], &counters[3][off_centre * 16 + faces],
       &counters[4][bent * 24 + size]},
      recent * 16 + faces, split * 8 + passed, value);
  models.lengths += geometry.length();
  ++models.visits;
  return out;
}

/// Which chord, as code_chord().
template <class Coder>
void code_mixed_chord(Coder& coder, SplitState& state, const VertexRing& ring,
                      const RingGeometry& geometry, GridSplit& split) {
  MixedModels& models = *state.mixed;
  coder.part(Part::connectivity);
  if (ring.size < 2) {
    split.chord = false;
    return;
  }
  split.chord = !coder.bit(models.long_form[ring.open ? 1 : 0], !split.chord);
  if (!split.chord) return;
  MixedChords chords(state, ring, geometry);
  const Shares sides = chords.shares_of_sides();
  const unsigned side =
      coder.choice(sides, split.from == split.to ? 0 : chords.side_of(split) - 1) + 1;
  const Shares places = chords.shares_of_places(side);
  const bool halves = state.placement == Placement::optimal && 2 * side == ring.size;
  split.from = coder.choice(places, split.from % chords.places(side));
  split.to = split.from + side < ring.size ? split.from + side : split.from + side - ring.size;
  chords.learn(models.chord, split.from, side);
  if (halves && ring.vertex[split.from] > ring.vertex[split.to]) std::swap(split.from, split.to);
}

/// How one guess differs from another beside a size, with the sign as the highest bit: 0 to 15.
inline unsigned difference_class(std::int64_t difference, unsigned size) {
  constexpr std::int64_t kMost = std::int64_t{1} << 30;
  const std::int64_t x = std::clamp(difference, -kMost, kMost);
  const unsigned length = half_octaves(static_cast<std::uint64_t>(x * x)) + 14;
  return (x < 0 ? 8u : 0u) + (length > size ? std::min((length - size) / 3, 7u) : 0);
}

/// Codes the components of a step, each by itself.
template <class Coder>
class MixedStep {
 public:
  MixedStep(Coder& coder, SplitState& state, Index vertex, const VertexRing& ring,
            const RingGeometry& geometry, const GridSplit& split)
      : coder_(coder), models_(*state.mixed), vertex_(vertex) {
    const unsigned side = ring.places(split.from, split.to), rest = ring.size - side;
    shape_ = std::min(side, 5u) * 6 + std::min(rest, 5u);
    length_ = geometry.length();
    bent_ = mean_normal_error(state, ring);
    const RingGeometry::Run near = geometry.run(split.from, side + 1);
    const std::int64_t scale = kCounts.reciprocal[near.count + 1];
    centre_ = {(near.sum.x * scale) >> 16, (near.sum.y * scale) >> 16, (near.sum.z * scale) >> 16};
    unsigned off = 0, neighbours = 0;
    for (unsigned i = 0; i < ring.size; ++i) {
      if (ring.vertex[i] == kNone) continue;
      off += models_.trace[ring.vertex[i]].off;
      ++neighbours;
    }
    off_ = off / neighbours;
  }

  /// Of the two components along the surface the k-th. Returns how far it is off `guess`.
  std::int32_t across(unsigned k, unsigned axis, std::int64_t guess, unsigned size,
                      std::int32_t off) {
    const unsigned other = difference_class(centre_[axis] - guess, size);
    const std::int32_t out = models_.tangential[k].code(
        coder_, off, {{{size, 0}, {off_ + 4, 0}, {size, shape_}, {size, other % 8}}}, shape_,
        {other, k == 0 ? 0 : first_class_});
    const std::int64_t first = out;
    if (k == 0)
      first_class_ =
          2 * shifted(
                  static_cast<int>(half_octaves(static_cast<std::uint64_t>(first * first) * 4)) -
                      static_cast<int>(size),
                  8, 31) +
          (out < 0 ? 1 : 0);
    squares_ += static_cast<std::uint64_t>(first * first);
    return out;
  }

  /// The component along the normal. Returns how far it is off its guess.
  std::int32_t above(std::int32_t off) {
    const unsigned size = (length_ + bent_) / 2;
    const auto bent = static_cast<int>(bent_), length = static_cast<int>(length_);
    const auto tangential = static_cast<int>(half_octaves(2 * squares_));
    const std::int32_t out =
        models_.normal.code(coder_, off,
                            {{{size, 0},
                              {bent_, 0},
                              {size, shifted(bent - length, 36, 47) / 3},
                              {bent_, shifted(tangential - length, 16, 31) / 2}}},
                            shape_, {MixedNumberModel::kUnknown, 0});
    std::uint8_t& trace = models_.trace[vertex_].off;
    trace = static_cast<std::uint8_t>((trace + static_cast<unsigned>(tangential) + 1) / 2);
    return out;
  }

 private:
  Coder& coder_;
  MixedModels& models_;
  Index vertex_;
  unsigned shape_, length_, bent_, off_, first_class_ = 0;
  StepGuess::Vector centre_;
  std::uint64_t squares_ = 0;
};

}  // namespace pstrips::inline formats
