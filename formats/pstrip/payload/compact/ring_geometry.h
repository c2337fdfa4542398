#pragma once

#include <array>
#include <cstdint>

#include "formats/pstrip/payload/compact/split_state.h"

namespace pstrips::inline formats {

/// The ring of a vertex as numbers: each neighbour less the centre.
///
/// Widths: differences of points take 25 bits, sums over a ring 31, squares of sums 64 unsigned.
/// Lengths are given in quarter octaves: half_octaves() of the square.
class RingGeometry {
 public:
  /// Neighbours one after the other.
  struct Run {
    GridPoint sum;     ///< of their arms
    unsigned lengths;  ///< sum
    unsigned count;    ///< absent ones aside; at least 1
  };

  /// The points of `ring` need not be those of `vertex` in the state alone: any that are there.
  RingGeometry(const SplitState& state, Index vertex, const VertexRing& ring);

  unsigned size() const { return size_; }
  bool is_open() const { return open_; }
  bool is_absent(unsigned i) const { return open_ && i + 1 == size_; }
  GridPoint arm(unsigned i) const { return arm_[i]; }  ///< 0 for an absent neighbour
  unsigned length(unsigned i) const { return length_[i]; }
  unsigned length() const { return mean_length_; }                ///< root of the mean square
  unsigned extent(unsigned axis) const { return extent_[axis]; }  ///< the same along one axis

  /// places  1 to the ring's size, at least one of them a neighbour
  Run run(unsigned from, unsigned places) const {
    const unsigned end = from + places;
    const bool wraps = end > size_;
    const Sum& last = sums_[wraps ? end - size_ : end];
    Run out{last.arms - sums_[from].arms, last.lengths - sums_[from].lengths,
            places - (open_ && end >= size_ ? 1 : 0)};
    if (wraps) {
      out.sum = out.sum + sums_[size_].arms;
      out.lengths += sums_[size_].lengths;
    }
    return out;
  }
  /// What a run leaves, its two ends included again.
  Run rest_of(const Run& run, unsigned from, unsigned to) const {
    const unsigned absent_ends = (is_absent(from) ? 1 : 0) + (is_absent(to) ? 1 : 0);
    return {sums_[size_].arms - run.sum + arm_[from] + arm_[to], 0,
            size_ - (open_ ? 1 : 0) + 2 - absent_ends - run.count};
  }

  static std::uint64_t square_of(GridPoint p) {
    const auto square = [](std::int64_t x) { return static_cast<std::uint64_t>(x * x); };
    return square(p.x) + square(p.y) + square(p.z);
  }

 private:
  struct Sum {
    GridPoint arms;
    unsigned lengths = 0;
  };

  unsigned size_;
  bool open_;
  unsigned mean_length_ = 0;
  std::array<unsigned, 3> extent_{};
  std::array<GridPoint, VertexRing::kMaxSize> arm_;
  std::array<std::uint8_t, VertexRing::kMaxSize> length_;
  std::array<Sum, VertexRing::kMaxSize + 1> sums_;  // of the arms before each
};

inline RingGeometry::RingGeometry(const SplitState& state, Index vertex, const VertexRing& ring)
    : size_(ring.size), open_(ring.open) {
  const GridPoint centre = state.position[vertex];
  std::array<std::uint64_t, 3> squares{};
  Sum sum;
  sums_[0] = sum;
  for (unsigned i = 0; i < size_; ++i) {
    const bool absent = is_absent(i);
    const GridPoint arm = absent ? GridPoint{} : state.position[ring.vertex[i]] - centre;
    const auto square = [](std::int64_t x) { return static_cast<std::uint64_t>(x * x); };
    const std::array<std::uint64_t, 3> own = {square(arm.x), square(arm.y), square(arm.z)};
    for (unsigned k = 0; k < 3; ++k) squares[k] += own[k];
    arm_[i] = arm;
    length_[i] = static_cast<std::uint8_t>(half_octaves(own[0] + own[1] + own[2]));
    sum.arms = sum.arms + arm;
    sum.lengths += length_[i];
    sums_[i + 1] = sum;
  }
  const unsigned count = half_octaves(size_ - (open_ ? 1 : 0));
  const auto mean = [&](std::uint64_t squares_of_all) {
    const unsigned all = half_octaves(squares_of_all);
    return all > count ? all - count : 0;
  };
  for (unsigned k = 0; k < 3; ++k) extent_[k] = mean(squares[k]);
  mean_length_ = mean(squares[0] + squares[1] + squares[2]);
}

}  // namespace pstrips::inline formats
