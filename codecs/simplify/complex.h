#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "codecs/simplify/quadric.h"
#include "codecs/simplify/star.h"
#include "core/mesh.h"

namespace pstrips::inline codecs {

/// What is needed of a neighbour, four on a cache line.
struct alignas(16) VertexPoint {
  Vec3f position;   ///< scaled to the unit box
  float error = 0;  ///< of the faces that it stands for; infinite: locked
};

/// What concerns the vertex itself, on one cache line.
struct alignas(64) VertexRecord {
  Quadric quadric;
  float key = 0;          ///< in the queue
  float extra_error = 0;  ///< memoryless metric: constant term of what attributes demand;
                          ///< qem: what a large ring's point does not show yet
  Index ring = 0;         ///< first of its corners in the pool
  Index ring_size = 0;    ///< dead triangles included
  Index ring_capacity = 0;
  bool regular = false;  ///< each edge has two triangles of opposite direction
};
static_assert(sizeof(VertexRecord) == 64);

/// Triangles over flat arrays with the corners of each vertex listed in one pool.
/// A corner is 4 · triangle + its place 0, 1, 2; place 3 says whether the triangle is dead.
class Complex {
 public:
  /// Locks vertices that are not finite. Cost O(size).
  Complex(std::span<const double> positions, std::span<const Index> wedge_vertex,
          std::span<const Index> triangles);

  std::vector<VertexPoint> points;
  std::vector<VertexRecord> vertices;
  std::vector<Index> marks;  ///< scratch of whoever drew the last epoch
  std::vector<Index> corner_vertex;
  /// A model unit is 1 / (scale[0] · scale[1]) of ours; each a power of two.
  double scale[2] = {1, 1};
  double low[3] = {};   ///< half of the model's least coordinates
  double diagonal = 0;  ///< of the bounding box, in our units

  Index vertex_count() const { return static_cast<Index>(vertices.size()); }
  Index triangle_count() const { return static_cast<Index>(corner_vertex.size() / 4); }
  static Index next(Index corner) { return (corner & ~3u) | (0x09u >> (corner & 3u) * 2 & 3u); }
  static Index previous(Index corner) { return (corner & ~3u) | (0x12u >> (corner & 3u) * 2 & 3u); }
  bool is_dead(Index corner) const { return corner_vertex[corner | 3u] != 0; }
  void kill(Index corner) { corner_vertex[corner | 3u] = 1; }

  /// The vector from `from` to `to`.
  Vec3f offset(Index from, Index to) const { return points[to].position - points[from].position; }
  /// Where a vertex stands, in model units; finite.
  std::array<double, 3> model_position(Index vertex) const;
  bool is_locked(Index vertex) const { return std::isinf(points[vertex].error); }

  /// Prefetch what is going to be needed soon: the record, then its ring, then the
  /// triangles, then their vertices. Collapses jump all over the mesh; on 270,000 triangles this
  /// saves a third of the time.
  [[gnu::always_inline]] void prefetch_record(Index v) const { __builtin_prefetch(&vertices[v]); }
  [[gnu::always_inline]] void prefetch_ring(Index v) const {
    __builtin_prefetch(&pool_[vertices[v].ring]);
    __builtin_prefetch(&points[v]);
  }
  [[gnu::always_inline]] void prefetch_triangles(Index v) const {
    for (const Index corner : few_of_ring(v)) __builtin_prefetch(&corner_vertex[corner]);
  }
  [[gnu::always_inline]] void prefetch_neighbours(Index v) const {
    for (const Index corner : few_of_ring(v)) {
      const Index neighbour = corner_vertex[next(corner)];
      __builtin_prefetch(&points[neighbour]);
      __builtin_prefetch(&vertices[neighbour]);
    }
  }
  /// The live corners of a vertex; drops its dead ones.
  std::span<const Index> ring(Index vertex);
  /// The same with dead ones among them, without looking at the triangles.
  std::span<const Index> ring_with_dead(Index vertex) const {
    return {pool_.data() + vertices[vertex].ring, vertices[vertex].ring_size};
  }
  /// Fills corners and edges; `edges` in order of appearance. Cost O(ring).
  void gather(Index vertex, Star& star);
  /// The same for a regular vertex, faster: no lists of the corners on an edge. Several threads may
  /// do so at once with different vertices.
  void gather_regular(Index vertex, Star& star);
  /// Adds corners to the ring of a vertex. Amortized O(corners).
  void append(Index vertex, std::span<const Index> corners);

  /// Marks for one purpose: v is marked with it when marks[v] == epoch.
  Index new_epoch(Index how_many = 1);

 private:
  std::span<const Index> few_of_ring(Index v) const {
    return {pool_.data() + vertices[v].ring, std::min(vertices[v].ring_size, Index{8})};
  }
  static void make_room(Star& star, std::size_t corners);
  void place(Star& star, Index corners, Index edges) const;

  std::vector<Index> pool_;
  std::vector<Index> slot_;  // by vertex: its edge while a star is gathered
  Index epoch_ = 0;
};

inline std::span<const Index> Complex::ring(Index vertex) {
  VertexRecord& record = vertices[vertex];
  Index* const first = pool_.data() + record.ring;
  Index live = 0;
  for (Index i = 0; i < record.ring_size; ++i) {
    const Index corner = first[i];
    first[live] = corner;
    live += is_dead(corner) ? 0 : 1;
  }
  record.ring_size = live;
  return {first, live};
}

}  // namespace pstrips::inline codecs
