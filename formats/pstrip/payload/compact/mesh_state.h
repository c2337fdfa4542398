#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/pstrip/payload/compact/base_code.h"
#include "formats/pstrip/payload/compact/fine.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/compact/wedge_lists.h"
#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {

/// All that is learned while the wedges of a mesh go by.
struct WedgeModels {
  static constexpr unsigned kCounts = 4;  ///< of wedges that are split; more count as the last

  std::array<BitModel, kCounts> regular;
  std::array<std::array<BitModel, 2>, kCounts> reassigned;  ///< one corner shows it, several
  SymbolModel new_wedges, taken;                            ///< of a record that is not regular
  SymbolModel unseen;                                       ///< new wedges that nothing shows
  /// Corners of a face as on either side of it: what those say of each other, and whether the
  /// parent and the third vertex have wedges that nothing shows.
  std::array<std::array<BitModel, 4>, 3> as_new, as_kept;
  // Places in a list of likely wedges.
  std::array<SymbolModel, 2> of_parent, of_third;
  SymbolModel of_added;
  BitModel same_group;
  SymbolModel isolated_wedges;
  std::array<NumberModel, 3> isolated_position;
};

/// A mesh between two packets, as both sides of a file know it.
struct MeshState {
  MeshState(const ProgressiveMesh& mesh, const MeshCells& how)
      : MeshState(mesh, how, AttributeModels(how)) {}
  /// learned  from the base
  MeshState(const ProgressiveMesh& mesh, MeshCells how, AttributeModels learned)
      : splits(mesh.placement, mesh.effort),
        cells(std::move(how)),
        single_wedges(mesh.single_wedges),
        groups(static_cast<Index>(mesh.groups.size())),
        max_vertices(mesh.vertices),
        max_wedges(mesh.wedges),
        max_faces(static_cast<Index>(full_map_entries(mesh) / 3)),
        columns(columns_of(cells)),
        attributes(std::move(learned)) {}

  SplitState splits;
  MeshCells cells;
  bool single_wedges;
  Index groups;
  Index max_vertices, max_wedges, max_faces;  ///< at full resolution
  unsigned columns;                           ///< cells of a wedge
  Index wedges = 0;
  Index faces = 0;                        ///< whose wedges are known
  std::vector<Index> corner_wedge;        ///< of each corner; empty with single wedges
  WedgeLists lists;                       ///< likewise
  std::vector<std::int32_t> wedge_cells;  ///< `columns` a wedge
  std::vector<Index> face_group;          ///< empty with one group
  GridPoint last_isolated;
  WedgeModels models;
  AttributeModels attributes;
  std::vector<Index> slot;  ///< scratch, a wedge each, to be checked before it is believed

  const StarMesh& mesh() const { return splits.mesh; }
  Index wedge_of(Index corner) const {
    return single_wedges ? splits.mesh.vertex_of(corner) : corner_wedge[corner];
  }
  Index vertex_of_wedge(Index wedge) const {
    return single_wedges ? wedge : lists.vertex_of(wedge);
  }

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
    for (const Index v : base.wedge_vertex) lists.add(v);
    for (const Index wedge : corner_wedge) ++lists.uses(wedge);
  }
};

}  // namespace pstrips::inline formats
