#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <span>

#include "formats/pstrip/payload/compact/octahedron.h"
#include "formats/pstrip/payload/compact/plane_fit.h"

namespace pstrips::inline formats {

/// Where a wedge lies that is about to be coded. [spec/compact.md §7.3]
class WedgeSurroundings {
 public:
  /// A wedge that the new one shares a face with, or something near; the first PlaneFit::kMost
  /// different ones count.
  void add_neighbour(Index wedge) {
    const auto end = neighbours_.begin() + count_;
    if (count_ < neighbours_.size() && std::find(neighbours_.begin(), end, wedge) == end)
      neighbours_[count_++] = wedge;
  }
  /// A face in which the wedge is shown; the first kMostFaces count.
  ///
  /// next, previous  its other corners less the point where the wedge is
  void add_face(GridPoint next, GridPoint previous) {
    if (faces_ == kMostFaces) return;
    ++faces_;
    const auto part = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
      return a * d - b * c;
    };
    normal_[0] += part(next.y, next.z, previous.y, previous.z);
    normal_[1] += part(next.z, next.x, previous.z, previous.x);
    normal_[2] += part(next.x, next.y, previous.x, previous.y);
  }

  std::span<const Index> neighbours() const { return {neighbours_.data(), count_}; }

  /// Perpendicular to the faces; 24 bits.
  Octahedron::Vector normal() const {
    constexpr unsigned kBits = 24;
    std::uint64_t all = 0;
    for (const std::int64_t c : normal_) all |= static_cast<std::uint64_t>(std::abs(c));
    const auto bits = static_cast<unsigned>(std::bit_width(all));
    Octahedron::Vector out = normal_;
    for (std::int64_t& c : out) c >>= bits > kBits ? bits - kBits : 0;
    return out;
  }

 private:
  static constexpr unsigned kMostFaces = 64;  // sums of their normals take 56 bits

  std::array<Index, PlaneFit::kMost> neighbours_;
  unsigned count_ = 0, faces_ = 0;
  Octahedron::Vector normal_{};
};

}  // namespace pstrips::inline formats
