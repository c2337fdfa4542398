#pragma once

#include <span>
#include <vector>

#include "core/progressive_strips.h"

namespace pstrips::inline core {

/// Polygons as triangles that are joined over the edges between them. [spec/compact.md §11]
///
/// A polygon of k triangles has k - 1 joins and k + 2 corners, which start where the first of its
/// half-edges starts that is not joined.
class JoinedFaces {
 public:
  static constexpr Index kMostTurns = 256;

  /// opposite  of each half-edge [pair_half_edges()]; outlives this
  explicit JoinedFaces(std::span<const Index> opposite)
      : opposite_(opposite), joined_(opposite.size()) {}

  bool is_joined(Index h) const { return joined_[h]; }
  /// Precondition: h has an opposite.
  void set_joined(Index h, bool joined) { joined_[h] = joined_[opposite_[h]] = joined; }

  /// Joins the triangles of a face, all of them or none: false if they are not the polygon that
  /// their corners would give.
  ///
  /// triangles  ascending
  /// corners    of the face, as they would come back
  /// of         the corners of all triangles
  bool join_polygon(std::span<const Index> triangles, std::span<const Index> corners,
                    std::span<const Index> of);
  /// The same where the corners may start elsewhere: corner k comes back as corner k + turn modulo
  /// their number. kNone: no turn below kMostTurns will do.
  Index join_turned(std::span<const Index> triangles, std::span<const Index> corners,
                    std::span<const Index> of);

  /// All polygons of two triangles and more, by their first ones; their triangles ascend.
  /// Precondition: joins are trees, as what join_polygon() joins is.
  ///
  /// group  one a triangle; empty: all are 0
  FaceTable faces(std::span<const Index> of, std::span<const Index> group) const;

 private:
  bool join(std::span<const Index> triangles);
  void part(std::span<const Index> triangles);
  void walk(std::span<const Index> triangles, std::span<const Index> of,
            std::vector<Index>& corners) const;

  std::span<const Index> opposite_;
  std::vector<bool> joined_;
  std::vector<Index> boundary_;  // scratch
};

}  // namespace pstrips::inline core
