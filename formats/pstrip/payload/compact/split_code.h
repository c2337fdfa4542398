#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "formats/pstrip/payload/compact/chord_choice.h"
#include "formats/pstrip/payload/compact/mixed_split.h"
#include "formats/pstrip/payload/compact/near_spread.h"
#include "formats/pstrip/payload/compact/ring_geometry.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/compact/step_guess.h"

// For formats/pstrip/payload/compact: what a batch of splits looks like, once, for writing and for
// reading. Each function takes a Coder of formats/pstrip/payload/compact/rans.h; a reader fills the
// split, a writer reads it.

namespace pstrips::inline formats {

/// Whether a vertex splits.
template <class Coder>
bool code_flag(Coder& coder, SplitState& state, Index vertex, bool value) {
  if (state.mixed) return code_mixed_flag(coder, state, vertex, value);
  return coder.bit(
      state.models.splits[state.turn[vertex] == Turn::waits_recent ? 1 : 0]
                         [std::min(state.mesh.face_count_of(vertex), SplitModels::kFaces - 1)]
                         [std::min<unsigned>(state.split_around[vertex], SplitModels::kSplit - 1)],
      value);
}

/// Which chord of the ring parts the faces of the two vertices.
///
/// With optimal placement the new vertex gets the smaller side, of two equal ones the one that
/// starts at the neighbour with the lower number.
template <class Coder>
void code_chord(Coder& coder, SplitState& state, const VertexRing& ring,
                const RingGeometry& geometry, GridSplit& split) {
  constexpr unsigned kNoChord = SymbolModel::kSymbols - 1;
  SplitModels& models = state.models;
  coder.part(Part::connectivity);
  const unsigned size = ring.size;
  const unsigned state_of_ring = size == 0 ? 2 : ring.open ? 1 : 0;
  SymbolModel& model = models.sector[state_of_ring][std::min(size, SplitModels::kRings - 1)];
  const unsigned faces = split.chord && size > 0 ? ring.places(split.from, split.to) : 0;
  const unsigned symbol = coder.symbol(model, split.chord ? faces - 1 : kNoChord);
  split.chord = symbol != kNoChord && symbol + 1 < size;
  if (!split.chord) return;
  const unsigned side = symbol + 1;
  const bool halves = state.placement == Placement::optimal && 2 * side == size;
  const unsigned chords = halves ? size / 2 : size;
  const ChordChoice choice(state, ring, geometry, side, chords);
  split.from = coder.choice(choice.shares(), split.from % chords);
  split.to = split.from + side < size ? split.from + side : split.from + side - size;
  choice.learn(models.chord, split.from);
  if (halves && ring.vertex[split.from] > ring.vertex[split.to]) std::swap(split.from, split.to);
}

/// Where the new vertex lies: two components as they are predicted, the third, along which the
/// normal is largest, by the plane through the others.
template <class Coder>
void code_step(Coder& coder, SplitState& state, Index vertex, const VertexRing& ring,
               const RingGeometry& geometry, GridSplit& split) {
  SplitModels& models = state.models;
  const StepGuess guess(state.placement, ring, geometry, split);
  const unsigned up = guess.up(), u = up == 2 ? 0 : up + 1, v = up == 0 ? 2 : up - 1;
  const std::array<std::int64_t, 3> actual = {split.step.x, split.step.y, split.step.z};
  StepGuess::Vector coded;
  const NearSpread spread(geometry, split.from, ring.places(split.from, split.to), u, v);
  std::optional<MixedStep<Coder>> mixed;
  if (state.mixed) mixed.emplace(coder, state, vertex, ring, geometry, split);
  const auto code = [&](unsigned nth, unsigned k, std::int64_t guessed, unsigned size) {
    const auto off = static_cast<std::int32_t>(Coder::kReads ? 0 : actual[k] - guessed);
    coded[k] = guessed + (mixed ? mixed->across(nth, k, guessed, size, off)
                                : models.tangential[nth].code(coder, off, size));
  };
  coder.part(Part::tangential);
  code(0, u, guess.across(u), spread.first());
  code(1, v, guess.across(v) + spread.second_off(coded[u] - guess.across(u)), spread.second());
  const std::int64_t height = guess.height(coded[u], coded[v]);
  coder.part(Part::normal);
  const auto above = static_cast<std::int32_t>(Coder::kReads ? 0 : actual[up] - height);
  const unsigned size = (geometry.length() + mean_normal_error(state, ring)) / 2;
  coded[up] = height + (mixed ? mixed->above(above) : models.normal.code(coder, above, size));

  const std::int64_t off = coded[up] - height;
  const unsigned error = half_octaves(static_cast<std::uint64_t>(off * off) * 4);
  state.normal_error[vertex] =
      static_cast<std::uint8_t>((state.normal_error[vertex] + error + 1) / 2);
  // What is beyond any grid stays there, and is refused.
  constexpr std::int64_t kBeyond = 2 * kMaxGrid + 1;
  const auto within = [&](unsigned k) {
    return static_cast<std::int32_t>(std::clamp(coded[k], -kBeyond, kBeyond));
  };
  split.step = {within(0), within(1), within(2)};
}

}  // namespace pstrips::inline formats
