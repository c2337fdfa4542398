#pragma once

#include <span>
#include <vector>

#include "codecs/compact/batches.h"
#include "core/star_mesh.h"

namespace pstrips::inline codecs {

/// What a decoder of batches will do, in the numbers that it gives.
struct SplitPlan {
  struct Split {
    Index vertex;       ///< that is split; the new one takes the next free number
    Index inner;        ///< the collapse that it undoes, as the forest counts them
    Index triangles;    ///< how many it brings
    Index first_moved;  ///< into `moved`
  };
  /// A triangle of the source, and which of its corners comes first.
  struct Triangle {
    Index from;
    std::uint8_t turn;
  };

  Index base_vertices = 0, base_triangles = 0;
  std::vector<Split> splits;       ///< coarse to fine
  std::vector<Index> batches;      ///< how many splits each has, the coarsest first
  std::vector<Index> vertex_from;  ///< of the source, by number
  std::vector<Triangle> triangles;
  /// The corners that each split gives to its new vertex, one list after the other: around the fan
  /// if they are one.
  std::vector<Index> moved;
};

/// Goes down a forest from its roots, batch by batch.
///
/// A new vertex stands behind the one it comes from in a list that starts with the base, and splits
/// come in the order of that list. Triangles that a split brings start with the vertex that is
/// split, those in which its new one comes last before the others.
///
/// triangles  3 distinct vertices each
/// batches    how many there are
/// placement  with optimal placement the two vertices of a split are alike, and the new one is that
///            with fewer faces between the two that they share; of equal ones, the one whose faces
///            start at the neighbour with the lower number
/// cost       O(triangles + splits + vertices * batches)
SplitPlan plan_splits(std::span<const Index> triangles, std::span<const Collapse> collapses,
                      const CollapseForest& forest, Index batches, Placement placement);

}  // namespace pstrips::inline codecs
