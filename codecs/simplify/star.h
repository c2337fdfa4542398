#pragma once

#include <span>
#include <vector>

#include "codecs/collapse.h"
#include "codecs/simplify/float4.h"
#include "codecs/simplify/quadric.h"
#include "core/mesh.h"

namespace pstrips::inline codecs {

/// A triangle at a vertex: its other two vertices in winding order, and the vertex's own corner.
struct IncidentCorner {
  Index next, previous;
  Index corner;
  Index more[2];  ///< the next corner on the same edge as a multiple of 2 plus its side, or kNone:
                  ///< for the edge to `next` and to `previous`
};

/// An edge at a vertex.
struct StarEdge {
  Index vertex;         ///< the other end
  Index triangles;      ///< on this edge
  Index outgoing;       ///< of them, those that run along it away from the vertex
  Index first = kNone;  ///< as IncidentCorner::more
  float cost = 0, error = 0;
  Vec3f place = {};  ///< offset from the star's vertex of where the collapse would leave it
  CollapseConstraint refused = CollapseConstraint::none;
  bool counts_new_faces = false;  ///< its cost counts squared_new_face_distance()
};

/// Where four edges of a star lead.
struct EdgeGroup {
  Int4 vertex;    ///< the other ends; where there is none, the star's own vertex
  Vec3x4 offset;  ///< from the star's vertex
  Float4 error;   ///< VertexPoint::error of the other ends
};
/// The shape of four triangles of a star; nothing where there are fewer.
struct CornerGroup {
  Vec3x4 next, previous;  ///< offsets from the star's vertex
  Vec3x4 normal;          ///< once measured: unit, or zero
  Float4 area;            ///< once measured
};

/// Rings up to this size are compared pair by pair.
constexpr Index kMaxForPairs = 16;

/// The live triangles and edges around one vertex; scratch memory.
struct Star {
  Index vertex = kNone;
  std::span<IncidentCorner> corners;
  std::span<StarEdge> edges;
  std::span<EdgeGroup> edge_groups;      ///< edges 0 to 3, 4 to 7 …
  std::span<CornerGroup> corner_groups;  ///< corners likewise
  Index open_edges = 0;                  ///< with one triangle or more than two
  std::vector<IncidentCorner> corner_buffer;
  std::vector<StarEdge> edge_buffer;
  std::vector<EdgeGroup> edge_group_buffer;
  std::vector<CornerGroup> corner_group_buffer;

  /// Whether the vertex is regular, after gather_regular(). False beyond kMaxForPairs
  /// corners.
  bool is_regular() const;
  /// Fills normals and areas; returns the quadric of the triangles. [Garland97 §3.4]
  Quadric measure();
  /// The edge that costs least, of equals the one to the lowest vertex; null if there is none.
  StarEdge* cheapest() const {
    StarEdge* best = nullptr;
    for (StarEdge& edge : edges)
      if (!best || edge.cost < best->cost ||
          (edge.cost == best->cost && edge.vertex < best->vertex))
        best = &edge;
    return best;
  }
  Vec3f normal(Index corner) const { return lane(corner_groups[corner / 4].normal, corner % 4); }
};

}  // namespace pstrips::inline codecs
