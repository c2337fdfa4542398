#pragma once

#include <vector>

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

// Half-edge h = 3 t + k runs from corner k of triangle t to the next corner.

constexpr Index triangle_of(Index half_edge) { return half_edge / 3; }
constexpr Index next_in_triangle(Index half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
constexpr Index previous_in_triangle(Index half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

/// Which triangles a strip may step between.
///
/// `opposite[h]` is the half-edge that runs the other way between the same two wedges in another
/// triangle of the same group, or kNone; opposite[opposite[h]] == h. Where more than two
/// triangles meet in an edge, the i-th half-edge of one direction is paired with the i-th of the
/// other, in order of appearance; the rest have none. Half-edges of the same direction are never
/// paired: a strip over such an edge would turn the winding around.
struct DualGraph {
  std::vector<Index> opposite;

  Index triangle_count() const { return static_cast<Index>(opposite.size() / 3); }
  Index half_edge_count() const { return static_cast<Index>(opposite.size()); }
  /// The triangle over half-edge h, or kNone.
  Index neighbor(Index h) const { return opposite[h] == kNone ? kNone : triangle_of(opposite[h]); }
};

/// cost  O(n) on meshes, O(n log n) at worst (many triangles around one edge or vertex)
DualGraph make_dual_graph(const StripInput& input);

/// The same for polygons, where half-edge h runs from corner h of `input.corners` to the next one
/// of its face.
std::vector<Index> opposite_half_edges(const PolygonInput& input);

}  // namespace pstrips::inline codecs
