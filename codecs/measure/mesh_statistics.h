#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// What a mesh has that simple programs stumble over. Topology is by vertex, not by position.
/// Polygons are the faces of three or more corners in groups of that kind.
struct MeshStatistics {
  std::uint64_t non_manifold_edges = 0;  ///< of more than two polygons
  /// Vertices whose polygons form several fans, each joined over edges.
  std::uint64_t non_manifold_vertices = 0;
  std::uint64_t duplicate_faces = 0;    ///< polygons whose vertices, in any order, are an earlier's
  std::uint64_t degenerate_faces = 0;   ///< polygons that name a vertex twice; no edges are theirs
  std::uint64_t isolated_vertices = 0;  ///< that no face names
  std::uint64_t non_finite_vertices = 0;  ///< with a NaN or an infinity among x, y, z
  std::uint64_t other_faces = 0;          ///< all but triangles
  std::uint64_t components = 0;  ///< of the vertices that faces name, joined by common faces

  MeshStatistics& operator+=(const MeshStatistics& other);
  friend bool operator==(const MeshStatistics&, const MeshStatistics&) = default;
};

/// Each count with its name and with what a converter to progressive strips does about it; in JSON
/// the name has underscores.
struct MeshStatisticKind {
  std::uint64_t MeshStatistics::*count;
  std::string_view name;
  std::string_view treatment;
};
std::span<const MeshStatisticKind> mesh_statistic_kinds();

/// Counts them.
///
/// threads  see thread_count(); the counts do not depend on it
/// cost     O(n log d) for n corners and d of them at a vertex, about 20 bytes a triangle at work
MeshStatistics mesh_statistics(const Mesh& mesh, unsigned threads = 1);

}  // namespace pstrips::inline codecs
