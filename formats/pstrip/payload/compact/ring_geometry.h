#pragma once

#include <array>
#include <cstdint>

#include "formats/pstrip/payload/compact/split_state.h"

namespace pstrips::inline formats {

/// Of how many neighbours a sum is, for its mean.
struct CountTable {
  std::array<std::uint32_t, VertexRing::kMaxSize + 2> reciprocal{};  ///< 2^16 / n, rounded down
  std::array<std::uint8_t, VertexRing::kMaxSize + 2> length{};       ///< quarter octaves

  constexpr CountTable() {
    for (unsigned n = 1; n < reciprocal.size(); ++n) {
      reciprocal[n] = (1u << 16) / n;
      length[n] = static_cast<std::uint8_t>(half_octaves(std::uint64_t{n} * n));
    }
  }
};
inline constexpr CountTable kCounts;

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
  /// 0 for an absent neighbour.
  GridPoint arm(unsigned i) const { return {along_[0][i], along_[1][i], along_[2][i]}; }
  std::int64_t along(unsigned axis, unsigned i) const { return along_[axis][i]; }
  unsigned length(unsigned i) const { return length_[i]; }
  unsigned length() const { return mean_length_; }  ///< root of the mean square

  /// places  1 to the ring's size, at least one of them a neighbour
  Run run(unsigned from, unsigned places) const {
    Run out{{}, 0, 0};
    for (unsigned i = from; places > 0; --places, i = i + 1 == size_ ? 0 : i + 1) {
      out.sum = out.sum + arm(i);
      out.lengths += length_[i];
      out.count += is_absent(i) ? 0 : 1;
    }
    return out;
  }
  /// All neighbours; lengths aside.
  Run all() const { return {sum_, 0, size_ - (open_ ? 1 : 0)}; }
  /// Takes a run one place on: `first` leaves it and `next` joins.
  void move_on(Run& run, unsigned first, unsigned next) const {
    run.sum = run.sum - arm(first) + arm(next);
    run.lengths = run.lengths - length_[first] + length_[next];
    run.count = run.count + (is_absent(first) ? 1 : 0) - (is_absent(next) ? 1 : 0);
  }
  /// What a run leaves, its two ends included again.
  Run rest_of(const Run& run, unsigned from, unsigned to) const {
    const unsigned absent_ends = (is_absent(from) ? 1 : 0) + (is_absent(to) ? 1 : 0);
    return {sum_ - run.sum + arm(from) + arm(to), 0,
            size_ - (open_ ? 1 : 0) + 2 - absent_ends - run.count};
  }

  static std::uint64_t square_of(GridPoint p) {
    const auto square = [](std::int64_t x) { return static_cast<std::uint64_t>(x * x); };
    return square(p.x) + square(p.y) + square(p.z);
  }

 private:
  unsigned size_;
  bool open_;
  unsigned mean_length_ = 0;
  std::array<std::array<std::int32_t, VertexRing::kMaxSize>, 3> along_;  // of the arms
  std::array<std::uint8_t, VertexRing::kMaxSize> length_;
  GridPoint sum_;
};

inline RingGeometry::RingGeometry(const SplitState& state, Index vertex, const VertexRing& ring)
    : size_(ring.size), open_(ring.open) {
  const GridPoint centre = state.position[vertex];
  std::uint64_t squares = 0;
  for (unsigned i = 0; i < size_; ++i) {
    const GridPoint arm = is_absent(i) ? GridPoint{} : state.position[ring.vertex[i]] - centre;
    const std::uint64_t square = square_of(arm);
    squares += square;
    along_[0][i] = arm.x;
    along_[1][i] = arm.y;
    along_[2][i] = arm.z;
    length_[i] = static_cast<std::uint8_t>(half_octaves(square));
    sum_ = sum_ + arm;
  }
  const unsigned count = half_octaves(size_ - (open_ ? 1 : 0));
  const unsigned all = half_octaves(squares);
  mean_length_ = all > count ? all - count : 0;
}

}  // namespace pstrips::inline formats
