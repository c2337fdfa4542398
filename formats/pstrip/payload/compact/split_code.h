#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "formats/pstrip/payload/compact/split_state.h"

// For formats/pstrip/payload/compact: what a batch of splits looks like, once, for writing and for
// reading. Each function takes a Coder of formats/pstrip/payload/compact/rans.h; a reader fills the
// split, a writer reads it.
//
// Widths: differences of points take 25 bits, sums over a ring 31, squares of differences 52.

namespace pstrips::inline formats {

/// The ring as numbers: each neighbour less the centre, and which chords are likely.
class RingGeometry {
 public:
  std::array<GridPoint, VertexRing::kMaxSize> arm;  ///< 0 for an absent neighbour

  RingGeometry(const SplitState& state, Index vertex, const VertexRing& ring) : size_(ring.size) {
    const GridPoint centre = state.position[vertex];
    std::array<std::int64_t, VertexRing::kMaxSize> square;
    for (unsigned i = 0; i < size_; ++i) {
      const bool absent = ring.vertex[i] == kNone;
      arm[i] = absent ? GridPoint{} : state.position[ring.vertex[i]] - centre;
      square[i] = square_of({arm[i].x, arm[i].y, arm[i].z});
      mean_square_ += square[i];
    }
    mean_square_ = mean_square_ / std::max(size_, 1u) + 1;
    for (unsigned i = 0; i < size_; ++i)
      end_cost_[i] =
          kNearWeight * square[i] / mean_square_ +
          kFacesWeight *
              (ring.vertex[i] == kNone ? kAbsentFaces : state.mesh.face_count_of(ring.vertex[i]));
    if (state.placement == Placement::subset) sum_up(ring);
  }

  /// The less the likelier: chords between near neighbours with few faces. With subset placement
  /// the centre is one of the two vertices, and lies on its own side.
  std::int64_t cost(Placement placement, unsigned from, unsigned side) const {
    const unsigned to = from + side < size_ ? from + side : from + side - size_;
    const std::int64_t ends = end_cost_[from] + end_cost_[to];
    if (placement != Placement::subset) return ends;
    const std::int64_t given = mean_offset(from, from + side);
    const std::int64_t kept = mean_offset(from + side, from + size_);
    return ends + (kept - given) * kLeanWeight / mean_square_;
  }

 private:
  // Found by trying.
  static constexpr std::int64_t kNearWeight = 768, kFacesWeight = 64, kAbsentFaces = 8,
                                kLeanWeight = 128;
  using Vector = std::array<std::int64_t, 3>;
  struct Sum {
    Vector arms{};
    std::int64_t count = 0;
  };

  static std::int64_t square_of(const Vector& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

  void sum_up(const VertexRing& ring) {
    sums_[0] = {};
    for (unsigned i = 0; i < 2 * size_; ++i) {
      const unsigned at = i < size_ ? i : i - size_;
      sums_[i + 1] = sums_[i];
      if (ring.vertex[at] == kNone) continue;
      sums_[i + 1].arms[0] += arm[at].x;
      sums_[i + 1].arms[1] += arm[at].y;
      sums_[i + 1].arms[2] += arm[at].z;
      ++sums_[i + 1].count;
    }
  }

  /// Square of the mean of arms from .. to, both included, in quarters.
  std::int64_t mean_offset(unsigned from, unsigned to) const {
    const Sum &before = sums_[from], &after = sums_[to + 1];
    const std::int64_t count = std::max<std::int64_t>(after.count - before.count, 1);
    Vector mean;
    for (unsigned k = 0; k < 3; ++k) mean[k] = (after.arms[k] - before.arms[k]) * 4 / count;
    return square_of(mean);
  }

  unsigned size_;
  std::int64_t mean_square_ = 0;
  std::array<std::int64_t, VertexRing::kMaxSize> end_cost_;
  std::array<Sum, 2 * VertexRing::kMaxSize + 1> sums_;  // of the arms before each, twice round
};

/// Which chord of the ring parts the faces of the two vertices.
///
/// With optimal placement the new vertex gets the smaller side, of two equal ones the one that
/// starts at the neighbour with the lower number.
template <class Coder>
void code_chord(Coder& coder, SplitState& state, const VertexRing& ring,
                const RingGeometry& geometry, GridSplit& split) {
  constexpr unsigned kNoChord = SymbolModel::kSymbols - 1;
  SplitModels& models = state.models;
  const unsigned size = ring.size;
  const unsigned state_of_ring = size == 0 ? 2 : ring.open ? 1 : 0;
  SymbolModel& model = models.sector[state_of_ring][std::min(size, SplitModels::kRings - 1)];
  const unsigned faces = split.chord && size > 0 ? (split.to + size - split.from) % size : 0;
  const unsigned symbol = coder.symbol(model, split.chord ? faces - 1 : kNoChord);
  split.chord = symbol != kNoChord && symbol + 1 < size;
  if (!split.chord) return;
  const unsigned side = symbol + 1;
  const bool halves = state.placement == Placement::optimal && 2 * side == size;
  const unsigned chords = halves ? size / 2 : size;
  const auto end_of = [&](unsigned from) {
    return from + side < size ? from + side : from + side - size;
  };
  std::array<std::uint8_t, VertexRing::kMaxSize> by_cost;
  std::array<std::int64_t, VertexRing::kMaxSize> cost;
  for (unsigned i = 0; i < chords; ++i) {
    cost[i] = geometry.cost(state.placement, i, side);
    unsigned at = i;
    for (; at > 0 && cost[by_cost[at - 1]] > cost[i]; --at) by_cost[at] = by_cost[at - 1];
    by_cost[at] = static_cast<std::uint8_t>(i);
  }
  const std::uint64_t lead =
      chords > 1 ? static_cast<std::uint64_t>(cost[by_cost[1]] - cost[by_cost[0]]) : 0;
  SymbolModel& order = models.chord[std::min(chords, SplitModels::kChoices - 1)]
                                   [std::min(half_octaves(lead) / 4, SplitModels::kLeads - 1)];
  unsigned rank = 0;
  if constexpr (!Coder::kReads)
    while (by_cost[rank] != split.from % chords) ++rank;
  // 15 and more: the rest as it is, a ring has at most 64 chords.
  const unsigned coded = coder.symbol(order, std::min(rank, 15u));
  rank = coded < 15 ? coded : 15 + coder.raw(rank - 15, 6);
  split.from = rank < chords ? by_cost[rank] : 0;
  split.to = end_of(split.from);
  if (halves && ring.vertex[split.from] > ring.vertex[split.to]) std::swap(split.from, split.to);
}

/// What is known of a step before it is coded.
struct StepGuess {
  using Vector = std::array<std::int64_t, 3>;
  Vector between{};  ///< the means of the two sides, new vertex's less the other's, in sixteenths
  std::int64_t square = 0;  ///< of `between`
  Vector normal{};          ///< of the ring, its components below 2^20
  unsigned up = 0;          ///< the component of the largest length of `normal`
  unsigned error = 0;       ///< twice the mean of the neighbours' errors, half octaves
};

/// The arms from one neighbour of a ring to another, both included; absent ones do not count.
struct ArmSum {
  StepGuess::Vector sum{};
  std::int64_t count = 0;

  ArmSum(const VertexRing& ring, const RingGeometry& geometry, unsigned from, unsigned to) {
    for (unsigned i = from;; i = ring.next(i)) {
      if (ring.vertex[i] != kNone) {
        sum[0] += geometry.arm[i].x;
        sum[1] += geometry.arm[i].y;
        sum[2] += geometry.arm[i].z;
        ++count;
      }
      if (i == to) break;
    }
    count = std::max<std::int64_t>(count, 1);
  }
};

inline StepGuess::Vector normal_of(const VertexRing& ring, const RingGeometry& geometry) {
  StepGuess::Vector normal{};
  for (unsigned i = 0; i < ring.size; ++i) {
    if (ring.corner[i] == kNone) continue;
    const GridPoint a = geometry.arm[i], b = geometry.arm[ring.next(i)];
    normal[0] += std::int64_t{a.y} * b.z - std::int64_t{a.z} * b.y;
    normal[1] += std::int64_t{a.z} * b.x - std::int64_t{a.x} * b.z;
    normal[2] += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
  }
  std::uint64_t largest = 0;
  for (const std::int64_t n : normal)
    largest = std::max(largest, static_cast<std::uint64_t>(n < 0 ? -n : n));
  if (const auto bits = static_cast<unsigned>(std::bit_width(largest)); bits > 20)
    for (std::int64_t& n : normal) n >>= bits - 20;
  return normal;
}

inline StepGuess guess_of(const SplitState& state, const VertexRing& ring,
                          const RingGeometry& geometry, const GridSplit& split) {
  StepGuess out;
  const ArmSum near(ring, geometry, split.from, split.to);
  if (state.placement == Placement::optimal) {
    const ArmSum far(ring, geometry, split.to, split.from);
    const std::int64_t scale = (std::int64_t{1} << 20) / (near.count * far.count);
    for (unsigned k = 0; k < 3; ++k)
      out.between[k] = ((near.sum[k] * far.count - far.sum[k] * near.count) * scale) >> 16;
  } else {  // the centre itself stays
    for (unsigned k = 0; k < 3; ++k)
      out.between[k] = (near.sum[k] * ((std::int64_t{1} << 20) / near.count)) >> 16;
  }
  for (const std::int64_t x : out.between) out.square += x * x;
  out.normal = normal_of(ring, geometry);
  const auto length = [&](unsigned k) {
    return out.normal[k] < 0 ? -out.normal[k] : out.normal[k];
  };
  for (unsigned k = 1; k < 3; ++k)
    if (length(k) > length(out.up)) out.up = k;
  unsigned errors = 0, neighbours = 0;
  for (unsigned i = 0; i < ring.size; ++i) {
    if (ring.vertex[i] == kNone) continue;
    errors += state.normal_error[ring.vertex[i]];
    ++neighbours;
  }
  if (neighbours > 0) out.error = 2 * errors / neighbours;
  return out;
}

/// Where the new vertex lies: two components as they are predicted, the third, along which the
/// normal is largest, by the plane through the others.
template <class Coder>
void code_step(Coder& coder, SplitState& state, Index vertex, const VertexRing& ring,
               const RingGeometry& geometry, GridSplit& split) {
  SplitModels& models = state.models;
  const StepGuess guess = guess_of(state, ring, geometry, split);
  const unsigned side = (split.to + ring.size - split.from) % ring.size;
  StepModel& step = models.step[ring.open ? 1 : 0][std::min(side, SplitModels::kSectors) - 1];
  StepGuess::Vector predicted;
  for (unsigned k = 0; k < 3; ++k)
    predicted[k] = (guess.between[k] * step.fraction() + (1 << 19)) >> 20;

  const std::array<std::int64_t, 3> actual = {split.step.x, split.step.y, split.step.z};
  const auto code = [&](NumberModel& model, std::int64_t from, unsigned k) {
    return from +
           model.code(coder, Coder::kReads ? 0 : static_cast<std::int32_t>(actual[k] - from));
  };
  const unsigned spread =
      std::min(half_octaves(static_cast<std::uint64_t>(guess.square)), SplitModels::kSizes - 1) / 2;
  const unsigned up = guess.up, u = up == 2 ? 0 : up + 1, v = up == 0 ? 2 : up - 1;
  StepGuess::Vector coded;
  coded[u] = code(models.tangential[0][spread], predicted[u], u);
  coded[v] = code(models.tangential[1][spread], predicted[v], v);
  std::int64_t height = predicted[up];
  if (guess.normal[up] != 0)
    height -= ((coded[u] - predicted[u]) * guess.normal[u] +
               (coded[v] - predicted[v]) * guess.normal[v]) /
              guess.normal[up];
  if (height > kMaxGrid || height < -kMaxGrid) height = 0;
  coded[up] = code(models.normal[std::min((spread + guess.error) / 2, SplitModels::kSizes - 1)],
                   height, up);

  const std::int64_t off = coded[up] - height;
  const unsigned error = half_octaves(static_cast<std::uint64_t>(off * off) * 4);
  state.normal_error[vertex] =
      static_cast<std::uint8_t>((state.normal_error[vertex] + error + 1) / 2);
  std::int64_t dot = 0;
  for (unsigned k = 0; k < 3; ++k) dot += coded[k] * 16 * guess.between[k];
  step.learn(dot, guess.square);
  split.step = {static_cast<std::int32_t>(coded[0]), static_cast<std::int32_t>(coded[1]),
                static_cast<std::int32_t>(coded[2])};
}

}  // namespace pstrips::inline formats
