#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/progressive_strips.h"
#include "core/result.h"
#include "core/strip_state.h"

namespace pstrips::inline codecs {

/// What a level shows, as views of arrays that live elsewhere.
struct LevelView {
  const ProgressiveMesh* mesh;
  Index vertices, wedges;
  std::span<const Index> resolved;        ///< as Level::resolved()
  std::span<const Index> wedge_vertices;  ///< empty with single wedges
  ByteView positions;                     ///< of all vertices of the level, one element each

  Index vertex_of(Index wedge) const {
    return wedge_vertices.empty() ? wedge : wedge_vertices[wedge];
  }
};

/// Calls `visit(a, b, c, group)` with the three wedges of every triangle that a level shows, in map
/// order, wound as the mesh. Three entries are a triangle when their vertices differ.
template <class Visit>
void for_each_triangle(const LevelView& level, Visit&& visit);

/// One level of a progressive mesh while it is refined: the decoding state machine.
/// [spec/vsplit.md §3; Kim04 §3.2]
///
/// Refers to the mesh, which must outlive it and may grow (a StreamDecoder appends packets). Its
/// records must be safe, as both readers guarantee: parents, reassigned wedges and map offsets in
/// range, no map offset that of a restart, every chain of the base map ending at a wedge; of a map
/// of triangles, new corners in range and a group of the mesh for each triangle, or none at all.
class Level {
 public:
  /// The base. Cost O(base and map size).
  explicit Level(const ProgressiveMesh& mesh);

  /// Applies the next `vsplits` records, those the mesh has not got left out.
  ///
  /// cost  O(what they rewrite): the map offsets and the entries whose chains end there. Hostile
  ///       records that rewrite long chains again and again cost O(map) a call instead
  void refine(Index vsplits);
  /// Up to the last record the mesh has.
  void refine_fully() { refine(kNone); }
  /// Takes the positions from the mesh anew, after a FINE chunk has completed them. O(level).
  void reload_positions();
  /// From now on keeps the entries that come to show another vertex though no record writes them:
  /// those of reassigned wedges. A change then costs up to three times as much, in meshes that
  /// reassign wedges.
  void track_reassigned() { tracks_reassigned_ = true; }
  /// Those entries since the last call, in any order; some may not have changed in the end.
  std::vector<Index> take_reassigned() { return std::exchange(reassigned_entries_, {}); }

  /// Frees what only refine() needs; it must not be called again.
  void release_symbols() { state_.release_symbols(); }

  const ProgressiveMesh& mesh() const { return *mesh_; }
  Index vsplits_done() const { return static_cast<Index>(next_.vsplit); }
  Index vertex_count() const { return mesh_->base_vertices + vsplits_done(); }
  Index wedge_count() const { return state_.wedge_count(); }
  Index vertex_of(Index wedge) const { return state_.vertex_of(wedge); }

  /// A vertex for each wedge; empty with single wedges.
  std::span<const Index> wedge_vertices() const { return state_.wedge_vertices(); }
  /// The index map with every symbol replaced by its wedge; restarts stay. Of a map of triangles
  /// as much as the level has, three wedges each.
  std::span<const Index> resolved() const { return state_.resolved(); }
  /// Position bytes of all vertices of the level, one element each.
  ByteView positions() const;
  LevelView view() const;

  /// The first record that has not been applied.
  const RecordStart& next() const { return next_; }
  /// The map offsets of the records from `start` on that have been applied.
  /// Precondition: `start` was next() once.
  std::span<const Index> offsets_since(const RecordStart& start) const {
    return std::span(mesh_->map_offsets)
        .subspan(start.map_offset, next_.map_offset - start.map_offset);
  }

 private:
  void place_base();
  void place(std::size_t vsplit);
  void reassign(VsplitRecord& record);

  const ProgressiveMesh* mesh_;
  StripState state_;
  RecordStart next_;
  Bytes moved_positions_;  // with optimal placement
  bool tracks_reassigned_ = false, lists_uses_ = false;
  std::vector<Index> reassigned_entries_;
};

/// The mesh that a level shows, in decoded numbering. At the full level the faces of the face table
/// take the place of the triangles they replace.
///
/// errors  corrupt, for what the readers do not look into: a vertex without a wedge, or a full
///         level that does not show as many triangles as the mesh says, so that its face table
///         could not be applied
Result<Mesh> mesh_of(const LevelView& level);
inline Result<Mesh> mesh_of(const Level& level) { return mesh_of(level.view()); }

/// The original order, from a fully refined mesh in decoded numbering. [spec/model.md §7]
/// Precondition: the lists of `order` are permutations of the right sizes.
Mesh restore_order(const Mesh& decoded, const OriginalOrder& order);

/// Strip bounds of an index map, not of triangles: first entry and one past the last of every strip
/// (restarts excluded), empty strips left out.
struct StripRange {
  Index first, end;
};
std::vector<StripRange> strip_ranges(std::span<const Index> map);

template <class Visit>
void for_each_triangle(const LevelView& level, Visit&& visit) {
  const ProgressiveMesh& mesh = *level.mesh;
  const auto vertex_of = [&](Index wedge) { return level.vertex_of(wedge); };
  if (mesh.encoding == MapEncoding::triangles) {
    for (std::size_t i = 0; i + 2 < level.resolved.size(); i += 3) {
      const Index a = level.resolved[i], b = level.resolved[i + 1], c = level.resolved[i + 2];
      const Index va = vertex_of(a), vb = vertex_of(b), vc = vertex_of(c);
      if (va != vb && vb != vc && va != vc)
        visit(a, b, c, mesh.triangle_group.empty() ? 0 : mesh.triangle_group[i / 3]);
    }
    return;
  }
  std::size_t first = 0;
  for (Index group = 0; group < mesh.group_entries.size(); ++group) {
    for_each_triangle(level.resolved.subspan(first, mesh.group_entries[group]), vertex_of,
                      [&](Index a, Index b, Index c) { visit(a, b, c, group); });
    first += mesh.group_entries[group];
  }
}

}  // namespace pstrips::inline codecs
