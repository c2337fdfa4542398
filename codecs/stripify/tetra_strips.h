#pragma once

#include <span>
#include <string>
#include <vector>

#include "codecs/stripify/stripify.h"
#include "core/tetra.h"

namespace pstrips::inline codecs {

/// Which tetrahedra a strip may step between.
///
/// `opposite[4 t + k]` is the face, of a tetrahedron, that lies on the one of t across from corner
/// k, or kNone; opposite[opposite[f]] == f. Only faces that are wound against each other meet: a
/// strip over others would turn the tetrahedra over. Where more than two meet, the i-th of one
/// winding is paired with the i-th of the other. A tetrahedron with a vertex twice has no
/// neighbours.
struct TetraGraph {
  std::vector<Index> opposite;

  Index tetra_count() const { return static_cast<Index>(opposite.size() / 4); }
};

/// tetrahedra  4 n vertices < vertex_count, 4 n <= kMaxCount
/// cost        O(n) on meshes, O(n log n) at worst
TetraGraph make_tetra_graph(std::span<const Index> tetrahedra, Index vertex_count);

/// Links as for triangles, one byte a face: 1 where a strip steps over it, the same for opposite
/// faces, at most two a tetrahedron, no cycles. Strips are in ascending order of the lower of their
/// ends and start there.
TetraStrips emit_tetra_strips(std::span<const Index> tetrahedra, const TetraGraph& graph,
                              std::span<const std::uint8_t> links);

/// What is wrong with `strips` as strips of the tetrahedra, as a phrase; empty when each is there
/// exactly once, oriented as it is. Looks at the strips alone. Takes any strips. O(n log n).
std::string find_tetra_strip_fault(std::span<const Index> tetrahedra, const TetraStrips& strips);

struct TetraStripStats {
  std::uint64_t tetrahedra = 0;
  std::uint64_t strips = 0;
  std::uint64_t singletons = 0;  ///< strips of one tetrahedron
  std::uint64_t longest = 0;     ///< in tetrahedra
  std::uint64_t entries = 0;     ///< tetrahedra + 3 strips
  std::uint64_t in_sequence =
      0;  ///< entries that replace the first vertex, as in sequential strips
};

/// Precondition: the strips are whole.
TetraStripStats tetra_strip_stats(const TetraStrips& strips);

}  // namespace pstrips::inline codecs
