#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline core {

/// A vertex on the integer grid of a file. |coordinate| <= kMaxGrid.
struct GridPoint {
  std::int32_t x = 0, y = 0, z = 0;
  friend GridPoint operator+(GridPoint a, GridPoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend GridPoint operator-(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

/// Each coordinate divided by two, rounded down.
inline GridPoint halved(GridPoint p) { return {p.x >> 1, p.y >> 1, p.z >> 1}; }

/// Keeps the difference of two points within 25 bits, which the widths of the predictors rest on.
inline constexpr std::int32_t kMaxGrid = (1 << 23) - 1;

/// The neighbours of a vertex in the order of its faces, counter-clockwise.
///
/// A closed ring has one face between each neighbour and the next. An open one is closed by an
/// absent neighbour, kNone, with an absent face on both sides.
struct VertexRing {
  static constexpr unsigned kMaxSize = 64;
  unsigned size = 0;  ///< 0: the faces form no single fan, or too large a one
  bool open = false;
  std::array<Index, kMaxSize> vertex;
  std::array<Index, kMaxSize> corner;  ///< the centre's in the face from vertex[i] to the next

  unsigned next(unsigned i) const { return i + 1 == size ? 0 : i + 1; }
  /// From one neighbour on to another; 1 to size - 1 when they differ.
  unsigned places(unsigned from, unsigned to) const {
    return to >= from ? to - from : to + size - from;
  }
};

/// Triangles as the faces around each vertex, for splits on any complex: a vertex has a list of
/// its corners, and what is a fan among them is found when it is asked for. Corner 3 f + k is the
/// k-th of face f. Equal operations give equal lists, so that an encoder and a decoder that do the
/// same number the same.
class StarMesh {
 public:
  Index vertex_count() const { return static_cast<Index>(stars_.size()); }
  Index face_count() const { return static_cast<Index>(vertex_.size() / 3); }
  std::span<const Index> corners() const { return vertex_; }

  static Index next_in_face(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static Index previous_in_face(Index corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

  Index vertex_of(Index corner) const { return vertex_[corner]; }
  Index face_count_of(Index vertex) const { return stars_[vertex].faces; }

  void reserve(std::size_t vertices, std::size_t faces);
  Index add_vertex();
  /// Precondition: the vertices are there.
  Index add_face(Index a, Index b, Index c);

  /// The corners of a vertex, the last one added first.
  void corners_of(Index vertex, std::vector<Index>& out) const;

  /// cost  O(faces of the vertex)
  void ring_of(Index vertex, VertexRing& ring) const;

  /// Gives the faces from ring.vertex[from] round to ring.vertex[to] to a new vertex, and adds the
  /// two faces that the edge between the two has, the one at `from` first; one that would have an
  /// absent neighbour is left out. `ring` is that of `vertex`.
  ///
  /// returns  the new vertex
  Index split(Index vertex, const VertexRing& ring, unsigned from, unsigned to);

  /// Gives the corners that `moves` marks, in the order of corners_of(), to a new vertex.
  Index split_any(Index vertex, std::span<const Index> corners, const std::vector<bool>& moves);

 private:
  void link(Index corner, Index vertex);

  struct Star {
    Index first;  // corner
    Index faces;
    Index slot;  // scratch of ring_of(), checked before it is believed
  };
  std::vector<Index> vertex_;  // of each corner
  std::vector<Index> next_;    // corner of the same vertex
  mutable std::vector<Star> stars_;
};

}  // namespace pstrips::inline core
