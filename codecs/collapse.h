#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// What becomes of one wedge that stands at a removed vertex.
struct WedgeMove {
  Index from;
  Index to;  ///< wedge of the other vertex that replaces it; kNone: reassigned, it keeps its
             ///< attributes and stands at the other vertex from now on
  friend bool operator==(const WedgeMove&, const WedgeMove&) = default;
};

/// Collapse of `removed` onto `kept`, which may move. [Kim04 §2.2]
struct Collapse {
  Index removed;
  Index kept;
  float error;  ///< estimated distance after it, model units, not falling along the sequence
  Index moves;  ///< how many of the sequence's wedge moves belong to it
  friend bool operator==(const Collapse&, const Collapse&) = default;
};

/// By what collapses are ordered where several come into question.
enum class CollapseOrder : std::uint8_t {
  error,  ///< the least first
  bits,   ///< nearly so; early on, where nobody sees which vertex goes first, by what takes fewer
          ///< bits to code as well
};

/// How large a batch is: collapses of which no two share a vertex.
struct BatchShares {
  double removed;   ///< of the vertices that are left, at most
  double cheapest;  ///< only vertices among this share by cost go

  Index most_of(Index left) const {
    return std::max(Index{1}, static_cast<Index>(removed * static_cast<double>(left)));
  }
};

/// Large batches save bits, small ones keep the order: what an early batch takes too soon would go
/// a little later anyway, what a late one takes spoils every level below. When few vertices are
/// left, a packet costs as much as eight of them, so the last batches are larger again.
struct BatchSchedule {
  BatchShares early = {0.35, 0.8}, late = {0.2, 0.5}, last = {0.3, 0.7};
  double early_until = 0.3;  ///< this share of the vertices is left
  Index late_until = 1000;   ///< so many are left

  const BatchShares& at(Index left, Index all) const {
    if (static_cast<double>(left) > early_until * static_cast<double>(all)) return early;
    return left > late_until ? late : last;
  }
  static BatchSchedule of(CollapseOrder order) {
    if (order == CollapseOrder::error) return {};
    return {.early = {0.4, 0.9}, .late = {0.25, 0.6}, .early_until = 0.45};
  }
};

/// Why a collapse is put off.
enum class CollapseConstraint : std::uint8_t {
  none,
  border,   ///< a vertex leaves the border, or a place where several borders meet
  link,     ///< the topology changes, or two faces become one
  flip,     ///< a face turns too far or becomes a sliver
  texture,  ///< the same in the texture, where faces may not turn over
};

/// How many collapses each constraint refused.
struct ConstraintCounts {
  std::uint64_t border = 0, link = 0, flip = 0, texture = 0;
  friend bool operator==(const ConstraintCounts&, const ConstraintCounts&) = default;
};

/// Why a sequence ends.
enum class SimplifyStop : std::uint8_t {
  target,       ///< few enough triangles
  max_error,    ///< every collapse left is dearer than the limit
  exhausted,    ///< no edge is left that may be collapsed (all others touch locked vertices)
  interrupted,  ///< the caller's progress function said so
};

/// How a mesh gets coarser, one vertex after the other.
struct CollapseSequence {
  std::vector<Collapse> collapses;  ///< fine to coarse
  /// Of all collapses, one after the other; every wedge that stands at the removed vertex once: of
  /// the source or reassigned to it earlier. A wedge that a removed triangle uses is mapped to the
  /// other wedge on that edge (first triangle wins), one that only other triangles use is
  /// reassigned, one that no triangle uses any more is mapped to any wedge of the kept vertex.
  std::vector<WedgeMove> moves;
  std::uint64_t triangles_left = 0;
  SimplifyStop stop = SimplifyStop::target;
  /// With optimal placement: where the kept vertex of each collapse stands afterwards, 3 a
  /// collapse. Finite; the very coordinates it had where it has not moved yet.
  std::vector<double> placements;
  ConstraintCounts refused;  ///< collapses that were put off, counted each time they come up
  ConstraintCounts forced;   ///< taken nevertheless, since everything cheaper was used up
};

}  // namespace pstrips::inline codecs
