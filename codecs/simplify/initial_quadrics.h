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
  ///
  /// attribute_quadrics  one a vertex, or null: what attributes bring counts here besides
  QuadricBuilder(Complex& complex, const SimplifyInput& input, WedgeTable* wedges,
                 Quadric* attribute_quadrics = nullptr);

  /// Adds what the edges of one vertex bring to a quadric of it. Cost O(star).
  void add_edges(const Star& star, Quadric& quadric);
  void add_edges(const Star& star) { add_edges(star, complex_.vertices[star.vertex].quadric); }

  /// The plane of a triangle as add_edges() sees it: at the start, or after the last update().
  struct Face {
    Vec3f normal;  ///< unit, or zero
    float area = 0;
  };
  const Face& face(Index triangle) const { return faces_[triangle]; }
  void update(Index triangle);
  /// A triangle that is gone has no area.
  void remove(Index triangle) { faces_[triangle] = {}; }

 private:
  void add_face(Index triangle);
  void add_attributes(Index corner, const Index (&vertices)[3], Vec3f e1, Vec3f e2, Vec3f normal,
                      float area);
  void add_edge(const Star& star, const StarEdge& edge, Quadric& quadric);
  float fold_weight(Index a, Index b, bool same_direction) const;
  float seam_weight(const Spoke& a, Index side_a, const Spoke& b, Index side_b) const;

  Complex& complex_;
  const SimplifyInput& input_;
  WedgeTable* wedges_;
  Quadric* attribute_quadrics_;
  std::vector<Face> faces_;
};

}  // namespace pstrip
