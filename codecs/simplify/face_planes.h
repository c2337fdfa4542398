#pragma once

#include <vector>

#include "codecs/simplify/complex.h"
#include "codecs/simplify/initial_quadrics.h"
#include "codecs/simplify/placement.h"

namespace pstrips::inline codecs {

/// A triangle as it is now.
struct FacePlane {
  Vec3f normal;  ///< unit, or zero
  float area = 0;
};

/// The faces and open edges that are around a vertex now.
struct alignas(64) VertexPlanes {
  Quadric planes;  ///< they all pass through the vertex
  Vec3f area;      ///< sum of the faces' areas as vectors

  void add(const FacePlane& face) {
    planes.add_plane(face.normal, face.area);
    area = area + face.normal * face.area;
  }
};

/// The error of an edge's collapse as a function of where its end is placed.
struct EdgeSum {
  Quadric quadric;     ///< relative to the removed vertex
  float constant = 0;  ///< its constant term
  Volume volume;
};

/// The faces there are, for the memoryless metric: what each vertex has around it is kept up to
/// date, so that an edge is priced from its two ends and the faces between. [Lindstrom98 §3]
class FacePlanes {
 public:
  /// Both must outlive it. Nothing is known before update() and sum().
  FacePlanes(const Complex& complex, const QuadricBuilder& builder)
      : complex_(complex),
        builder_(builder),
        faces_(complex.triangle_count()),
        around_(complex.vertex_count()) {}

  Index face_count() const { return static_cast<Index>(faces_.size()); }
  const VertexPlanes& around(Index vertex) const { return around_[vertex]; }
  void prefetch(Index vertex) const { __builtin_prefetch(&around_[vertex]); }

  /// A triangle has changed. One with a locked vertex gets no area.
  void update(Index triangle);
  void remove(Index triangle) { faces_[triangle] = {}; }

  /// What is around the star's vertex, open edges and seams among it with `with_edges`.
  void sum(Star& star, bool with_edges);
  /// Faces alone, without a star.
  void sum_faces(Index vertex);

  /// For an edge of a star, each face around it counted once.
  EdgeSum edge_sum(const Star& star, const StarEdge& edge) const;
  /// The same for four edges at once, given by their places in the star. Needs a star as
  /// Complex::gather_regular() makes it: corner i is on edge i.
  EdgeSums edge_sums(const Star& star, const Index (&at)[4]) const;

 private:
  const Complex& complex_;
  const QuadricBuilder& builder_;
  std::vector<FacePlane> faces_;
  std::vector<VertexPlanes> around_;
};

}  // namespace pstrips::inline codecs
