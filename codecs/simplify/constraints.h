#pragma once

#include <cstdint>

#include "codecs/simplify/complex.h"
#include "codecs/simplify/simplify.h"

namespace pstrips::inline codecs {

/// Rings larger than this are not looked through for each of their neighbours' collapses, so that
/// one vertex with a great many neighbours costs no more than they do.
constexpr Index kLargeRing = 64;

/// Asks whether collapses keep the shape and the topology of a complex.
class CollapseConstraints {
 public:
  /// `complex` must outlive it.
  explicit CollapseConstraints(Complex& complex) : complex_(complex) {}

  /// For the collapse of the star's vertex onto the other end of `edge`, which stays where it is.
  /// Cost O(both rings) until a ring is large. The star must have been measured.
  CollapseConstraint check(const Star& star, const StarEdge& edge);
  /// The same when both ends move, by `shift` and `kept_shift`.
  CollapseConstraint check(const Star& star, const StarEdge& edge, Vec3f shift, Vec3f kept_shift);

 private:
  bool breaks_link(const Star& star, Index p);
  bool breaks_regular_link(const Star& star, Index p);
  bool has_neighbour(Index vertex, Index other);
  bool has_triangle(Index a, Index b, Index c);
  bool flips(const Star& star, Index p, Vec3f shift) const;
  bool flips_kept(Index q, Index p, Vec3f shift);

  Complex& complex_;
};

/// Adds one to the count of `constraint`, if there is one.
inline void count(ConstraintCounts& counts, CollapseConstraint constraint) {
  if (constraint == CollapseConstraint::border) ++counts.border;
  if (constraint == CollapseConstraint::link) ++counts.link;
  if (constraint == CollapseConstraint::flip) ++counts.flip;
  if (constraint == CollapseConstraint::texture) ++counts.texture;
}

}  // namespace pstrips::inline codecs
