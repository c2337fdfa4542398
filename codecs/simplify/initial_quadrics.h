#pragma once

#include <vector>

#include "codecs/simplify/complex.h"
#include "codecs/simplify/simplify.h"
#include "codecs/simplify/wedges.h"

namespace pstrip {

/// The error quadrics of a complex before its first collapse: planes of the faces by area, and
/// planes that hold borders, seams and folds in place. [Garland97 §3.4, §6]
class QuadricBuilder {
 public:
  /// Adds what the faces bring, and the attribute terms to `wedges`, which may be null. All
  /// arguments must outlive the builder. Cost O(size).
  QuadricBuilder(Complex& complex, const SimplifyInput& input, WedgeTable* wedges);

  /// Adds what the edges of one vertex bring to its quadric. Cost O(star).
  void add_edges(const Star& star);

 private:
  void add_face(Index triangle);
  void add_attributes(Index corner, const Index (&vertices)[3], Vec3f e1, Vec3f e2, Vec3f normal,
                      float area);
  void add_edge(const Star& star, const StarEdge& edge);
  float fold_weight(Index a, Index b, bool same_direction) const;
  float seam_weight(const Spoke& a, Index side_a, const Spoke& b, Index side_b) const;

  Complex& complex_;
  const SimplifyInput& input_;
  WedgeTable* wedges_;
  std::vector<Vec3f> normals_;  // unit, or zero
};

}  // namespace pstrip
