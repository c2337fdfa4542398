#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/pstrip/payload/compact/base_code.h"
#include "formats/pstrip/payload/compact/fine.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {

/// All that is learned while the wedges of a mesh go by.
struct WedgeModels {
  static constexpr unsigned kCounts = 4;  ///< of wedges that are split; more count as the last
  static constexpr unsigned kSizes = 32;  ///< of the residual before, in bits

  std::array<BitModel, kCounts> regular;
  std::array<BitModel, kCounts> reassigned;
  SymbolModel new_wedges, taken;            ///< of a record that is not regular
  std::array<BitModel, 3> as_new, as_kept;  ///< corners of a face as on either side of it
  BitModel same_group;
  SymbolModel isolated_wedges;
  std::array<NumberModel, 3> isolated_position;
  std::vector<std::array<NumberModel, kSizes>> column;
};

/// A mesh between two packets, as both sides of a file know it.
struct MeshState {
  MeshState(const ProgressiveMesh& mesh, MeshCells how)
      : splits(mesh.placement),
        cells(std::move(how)),
        single_wedges(mesh.single_wedges),
        groups(static_cast<Index>(mesh.groups.size())),
        max_vertices(mesh.vertices),
        max_wedges(mesh.wedges),
        max_faces(static_cast<Index>(full_map_entries(mesh) / 3)) {
    for (const Attribute& a : mesh.wedge_attributes) columns += a.count;
    models.column.resize(columns);
    last_residual.resize(columns);
  }

  SplitState splits;
  MeshCells cells;
  bool single_wedges;
  Index groups;
  Index max_vertices, max_wedges, max_faces;  ///< at full resolution
  unsigned columns = 0;                       ///< components of all attributes together
  Index wedges = 0;
  Index faces = 0;                          ///< whose wedges are known
  std::vector<Index> corner_wedge;          ///< of each corner; empty with single wedges
  std::vector<Index> wedge_vertex;          ///< likewise
  std::vector<std::int32_t> wedge_cells;    ///< `columns` a wedge
  std::vector<Index> face_group;            ///< empty with one group
  std::vector<std::uint8_t> last_residual;  ///< bits, a column each
  GridPoint last_isolated;
  WedgeModels models;

  const StarMesh& mesh() const { return splits.mesh; }
  Index wedge_of(Index corner) const {
    return single_wedges ? splits.mesh.vertex_of(corner) : corner_wedge[corner];
  }
  Index vertex_of_wedge(Index wedge) const { return single_wedges ? wedge : wedge_vertex[wedge]; }

  /// The base, which was coded. Precondition: nothing is there yet.
  void start(const BaseMesh& base) {
    for (const GridPoint at : base.positions) splits.add_vertex(at);
    const auto vertex = [&](std::size_t c) { return base.wedge_vertex[base.corners[c]]; };
    for (std::size_t c = 0; c < base.corners.size(); c += 3)
      splits.mesh.add_face(vertex(c), vertex(c + 1), vertex(c + 2));
    faces = splits.mesh.face_count();
    wedges = static_cast<Index>(base.wedge_vertex.size());
    wedge_cells = base.wedge_cells;
    if (groups > 1) face_group = base.group;
    if (single_wedges) return;
    corner_wedge = base.corners;
    wedge_vertex = base.wedge_vertex;
  }
};

}  // namespace pstrips::inline formats
