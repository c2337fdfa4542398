#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codecs/measure/fan_map.h"
#include "core/mesh.h"

namespace pstrips::inline codecs {

/// A triangle of a surface that gets coarser. Corner 3 f + k is vertex k of face f.
struct RingFace {
  Index vertex[3];  ///< the first is kNone in a dead face
  Index next[3];    ///< corner at the same vertex, in a circle
  DisplacementBox box;
};

/// The live triangles around a vertex. Where they are a disc they stand in winding order, triangle
/// i between neighbours i and i + 1.
struct Ring {
  enum class Kind { closed, open, irregular };
  Index vertex = kNone;
  Kind kind = Kind::irregular;
  std::vector<Index> faces;
  std::vector<Index> neighbours;  ///< of a disc; one more than faces when it is open

  bool is_closed() const { return kind == Kind::closed; }
};

/// The triangles of a surface with the corners at each vertex in a circle.
class FaceRings {
 public:
  FaceRings(std::size_t faces, std::size_t vertices)
      : faces_(faces), corner_at_(vertices, kNone), slot_(vertices, 0) {}

  /// Fills a face; one that is not alive only names its vertices.
  void add(Index face, std::span<const Index> vertices, bool is_alive);
  RingFace& face(Index f) { return faces_[f]; }
  const RingFace& face(Index f) const { return faces_[f]; }
  bool is_dead(Index f) const { return faces_[f].vertex[0] == kNone; }
  bool has_vertex(Index f, Index vertex) const;
  /// Any corner of a vertex, which may be a dead face's; kNone: there is none.
  Index corner_at(Index vertex) const { return corner_at_[vertex]; }
  [[gnu::always_inline]] void prefetch_face(Index f) const { __builtin_prefetch(&faces_[f]); }
  [[gnu::always_inline]] void prefetch_vertex(Index v) const { __builtin_prefetch(&corner_at_[v]); }

  /// Fills a ring, and drops the vertex's dead corners. Cost O(ring), squared while it is small.
  void gather(Index vertex, Ring& ring);

  /// The third vertex of a triangle that has died.
  struct Lost {
    Index vertex, face;
  };
  /// Gives the triangles of the ring's vertex to another one. Those with both die and are `lost`.
  void merge(const Ring& ring, Index kept, std::vector<Lost>& lost);

 private:
  void order(Ring& ring);

  std::vector<RingFace> faces_;
  std::vector<Index> corner_at_;
  std::vector<Index> slot_;  // by vertex, while a ring is put in order
  std::vector<Index> corners_, firsts_, seconds_, in_order_;
  std::vector<std::uint8_t> follows_;
};

}  // namespace pstrips::inline codecs
