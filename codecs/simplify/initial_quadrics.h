#pragma once

#include "codecs/simplify/complex.h"
#include "codecs/simplify/simplify.h"
#include "codecs/simplify/wedges.h"

namespace pstrips::inline codecs {

/// What counts in the error quadrics besides the planes of faces: planes that hold borders, seams
/// and folds in place, and attributes. [Garland97 §6; Hoppe99b §3]
class QuadricBuilder {
 public:
  /// All arguments must outlive the builder; `wedges` may be null.
  QuadricBuilder(Complex& complex, const SimplifyInput& input, WedgeTable* wedges)
      : complex_(complex), input_(input), wedges_(wedges) {}

  /// Adds what attributes bring to the table of wedges and to the vertices' quadrics, but for the
  /// weight; to `also`, too, one a vertex, unless it is null. Precondition: there are wedges. Cost
  /// O(triangles).
  void add_attributes(Quadric* also = nullptr);

  /// Adds what the edges of a star, which has been measured, bring to a quadric of its vertex.
  /// Cost O(star).
  void add_edges(const Star& star, Quadric& quadric) const;
  /// Whether edges of a star bring anything although each has two faces of one group and wedge: not
  /// where the faces of the star are nearly flat. Errs on the side of yes.
  static bool may_fold(const Star& star);

 private:
  void add_edge(const Star& star, const StarEdge& edge, Quadric& quadric) const;
  float seam_weight(const IncidentCorner& a, Index side_a, const IncidentCorner& b,
                    Index side_b) const;

  Complex& complex_;
  const SimplifyInput& input_;
  WedgeTable* wedges_;
};

}  // namespace pstrips::inline codecs
