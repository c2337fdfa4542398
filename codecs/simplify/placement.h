#pragma once

#include "codecs/simplify/float4.h"
#include "codecs/simplify/quadric.h"

namespace pstrips::inline codecs {

/// A plane area·x = constant, or none: where a vertex may stand so that the volume under the faces
/// around it stays what it is. [Lindstrom98 §3.1]
struct Volume {
  Vec3f area;
  float constant = 0;
};

/// Where the vertex that an edge shrinks to costs least, on the plane of `volume` if there is one.
///
/// quadric  of both ends, relative to the first
/// offset   of the second end from the first
/// returns  an offset from the first; near the middle of the edge where the quadric does not care,
///          one of the ends or the middle where the best place is far off
/// source   [Garland97 §4; Lindstrom98 §3]. Differs: what is missing to a definite place is not a
///          separate problem of triangle shape, a weak pull to the middle decides it.
Vec3f best_place(const Quadric& quadric, const Volume& volume, Vec3f offset);

/// Four edges from one end, with what Quadric and Volume say of each.
struct EdgeSums {
  Vec3x4 offset;
  Float4 xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {};
  Vec3x4 b;
  Vec3x4 area;
  Float4 volume = {};
  Float4 constant = {};  ///< of the quadric

  void add_plane(const Vec3x4& unit_normal, Float4 amount);
  /// As Quadric::at().
  Float4 at(const Vec3x4& place) const;
  Quadric quadric(std::size_t lane) const;
};
/// The same for four edges at once.
Vec3x4 best_place(const EdgeSums& sums);

}  // namespace pstrips::inline codecs
