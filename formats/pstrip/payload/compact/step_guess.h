#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "formats/pstrip/payload/compact/ring_geometry.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/compact/step_weights.h"

namespace pstrips::inline formats {

/// What is known of a step before it is coded.
class StepGuess {
 public:
  using Vector = std::array<std::int64_t, 3>;

  StepGuess(Placement placement, const VertexRing& ring, const RingGeometry& geometry,
            const GridSplit& split);

  /// The axis along which the normal is largest.
  unsigned up() const { return up_; }
  /// A component of the step, as far as it is tangential.
  std::int64_t across(unsigned axis) const { return (across_[axis] + (1 << 15)) >> 16; }
  /// The component `up` when the two others are known, u the one that follows it, v before it.
  std::int64_t height(std::int64_t u, std::int64_t v) const;

 private:
  void find_normal(const VertexRing& ring, const RingGeometry& geometry, unsigned from,
                   unsigned faces);

  Vector across_;    // in units of 2^-16, 44 bits
  Vector above_;     // a step of the right height over the faces, in sixteenths, 33 bits
  Vector normal_{};  // of these faces, components below 2^15; that of `up` is not negative
  unsigned up_ = 0;
};

/// The vector product over the face from a neighbour to the next, 50 bits.
inline StepGuess::Vector face_normal(const RingGeometry& geometry, unsigned place) {
  const GridPoint a = geometry.arm(place),
                  b = geometry.arm(place + 1 == geometry.size() ? 0 : place + 1);
  return {std::int64_t{a.y} * b.z - std::int64_t{a.z} * b.y,
          std::int64_t{a.z} * b.x - std::int64_t{a.x} * b.z,
          std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x};
}

/// In sixteenths, 29 bits.
inline StepGuess::Vector mean_of(const RingGeometry::Run& run) {
  const std::int64_t scale = kCounts.reciprocal[run.count];
  return {(run.sum.x * scale) >> 12, (run.sum.y * scale) >> 12, (run.sum.z * scale) >> 12};
}

/// Of the two ends of a chord, of its near side and of the far one.
inline std::array<StepGuess::Vector, 3> means_beside(const RingGeometry& geometry,
                                                     const RingGeometry::Run& near, unsigned from,
                                                     unsigned to) {
  const bool both = !geometry.is_absent(from) && !geometry.is_absent(to);
  return {mean_of({geometry.arm(from) + geometry.arm(to), 0, both ? 2u : 1u}), mean_of(near),
          mean_of(geometry.rest_of(near, from, to))};
}

inline StepGuess::StepGuess(Placement placement, const VertexRing& ring,
                            const RingGeometry& geometry, const GridSplit& split) {
  const unsigned side = ring.places(split.from, split.to);
  const StepWeights& weights = step_weights(placement, ring.open, side, ring.size - side);
  const std::array<Vector, 3> means =
      means_beside(geometry, geometry.run(split.from, side + 1), split.from, split.to);
  for (unsigned k = 0; k < 3; ++k) {
    across_[k] = above_[k] = 0;
    for (unsigned i = 0; i < means.size(); ++i) {
      across_[k] += means[i][k] * weights.across[i];
      above_[k] += means[i][k] * weights.above[i];
    }
    above_[k] >>= 12;
  }
  // Faces of its own tell the height best where the vertex moves off the centre; else all do.
  const bool own = placement == Placement::subset;
  find_normal(ring, geometry, split.from, own ? side : ring.size);
}

inline void StepGuess::find_normal(const VertexRing& ring, const RingGeometry& geometry,
                                   unsigned from, unsigned faces) {
  for (unsigned i = from; faces > 0; --faces, i = ring.next(i)) {
    if (ring.corner[i] == kNone) continue;
    const Vector own = face_normal(geometry, i);
    for (unsigned k = 0; k < 3; ++k) normal_[k] += own[k];
  }
  std::array<std::uint64_t, 3> length;
  for (unsigned k = 0; k < 3; ++k)
    length[k] = static_cast<std::uint64_t>(normal_[k] < 0 ? -normal_[k] : normal_[k]);
  for (unsigned k = 1; k < 3; ++k)
    if (length[k] > length[up_]) up_ = k;
  const auto bits = static_cast<unsigned>(std::bit_width(length[up_]));
  const unsigned shift = bits > 15 ? bits - 15 : 0;
  const bool negative = normal_[up_] < 0;
  for (std::int64_t& n : normal_) n = (negative ? -n : n) >> shift;
}

inline std::int64_t StepGuess::height(std::int64_t u, std::int64_t v) const {
  const unsigned after = up_ == 2 ? 0 : up_ + 1, before = up_ == 0 ? 2 : up_ - 1;
  const std::int64_t n = normal_[up_];
  if (n == 0) return across(up_);
  const std::int64_t high = normal_[0] * above_[0] + normal_[1] * above_[1] +
                            normal_[2] * above_[2] -
                            16 * (normal_[after] * u + normal_[before] * v);
  const std::int64_t height = (high + (high < 0 ? -8 * n : 8 * n)) / (16 * n);
  return height > kMaxGrid || height < -kMaxGrid ? 0 : height;
}

/// Of the neighbours, in quarter octaves.
inline unsigned mean_normal_error(const SplitState& state, const VertexRing& ring) {
  unsigned errors = 0, neighbours = 0;
  for (unsigned i = 0; i < ring.size; ++i) {
    if (ring.vertex[i] == kNone) continue;
    errors += state.normal_error[ring.vertex[i]];
    ++neighbours;
  }
  return neighbours > 0 ? errors / neighbours : 0;
}

}  // namespace pstrips::inline formats
