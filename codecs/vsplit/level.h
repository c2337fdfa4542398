#pragma once

#include <span>
#include <vector>

#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrips::inline codecs {

/// One level of a progressive mesh while it is refined: the decoding state machine.
/// [spec/vsplit.md §3; Kim04 §3.2]
///
/// Refers to the mesh, which must outlive it and may grow (a StreamDecoder appends packets). Its
/// records must be safe, as both readers guarantee: parents, reassigned wedges and map offsets in
/// range, no place on a restart, every chain of the base map ending at a wedge.
class Level {
 public:
  /// The base. Cost O(base and map size).
  explicit Level(const ProgressiveMesh& mesh);

  /// The last level of a complete mesh, whose parts are known otherwise: no record is looked at.
  ///
  /// resolved      the whole map
  /// wedge_vertex  of all wedges; empty with single wedges
  /// positions     with free placement, of all vertices; else empty
  static Level full(const ProgressiveMesh& mesh, std::vector<Index> resolved,
                    std::vector<Index> wedge_vertex, Bytes positions);

  /// Applies the next `vsplits` records, those the mesh has not got left out.
  ///
  /// cost  O(what they rewrite): the map offsets and the entries whose chains end there. Hostile
  /// records
  ///       that rewrite long chains again and again cost O(map) a call instead
  void refine(Index vsplits);
  /// Frees what only refine() needs; it must not be called again.
  void forget_symbols() { map_ = {}; }
  /// Up to the last record the mesh has.
  void refine_fully() { refine(kNone); }

  const ProgressiveMesh& mesh() const { return *mesh_; }
  Index vsplits_done() const { return next_; }
  Index vertex_count() const { return mesh_->base_vertices + next_; }
  Index wedge_count() const { return wedge_count_; }
  Index vertex_of(Index wedge) const {
    return wedge_vertex_.empty() ? wedge : wedge_vertex_[wedge];
  }

  /// A vertex for each wedge; empty with single wedges.
  std::span<const Index> wedge_vertices() const { return wedge_vertex_; }

  /// The index map with every symbol replaced by its wedge; restarts stay.
  std::span<const Index> resolved() const { return resolved_; }
  /// Position bytes of all vertices of the level, one element each.
  ByteView positions() const;
  /// The map offsets that records from..vsplits_done() rewrote, as offsets into the map.
  /// Precondition: `from` was vsplits_done() once.
  struct Mark {
    Index vsplit = 0;
    std::size_t map_offset = 0;
  };
  Mark mark() const { return {next_, map_offset_}; }
  std::span<const Index> offsets_since(const Mark& mark) const {
    return std::span(mesh_->map_offsets).subspan(mark.map_offset, map_offset_ - mark.map_offset);
  }

 private:
  Level() = default;
  void write(Index offset, Index wedge);
  bool follows_chains() const;
  void follow_chains(Index offset, Index wedge);

  const ProgressiveMesh* mesh_ = nullptr;
  Index next_ = 0;  // first record not yet applied
  Index wedge_count_ = 0;
  std::size_t new_wedge_ = 0, map_offset_ = 0, reassigned_ = 0;  // next element of the mesh's lists
  std::vector<Index> resolved_;
  std::vector<Index> map_;           // with symbols; empty when there are none
  std::vector<Index> wedge_vertex_;  // empty with single wedges
  Bytes moved_positions_;            // free placement only
  std::vector<Index> pending_;       // scratch of follow_chains()
  std::uint64_t followed_ = 0;       // entries that follow_chains() has rewritten so far
};

/// The mesh that a level shows, in decoded numbering. At the full level the faces of the face table
/// take the place of the triangles they replace.
///
/// errors  corrupt, for what the readers do not look into: a vertex without a wedge, or a full
/// level
///         that does not show as many triangles as the mesh says, so that its face table could not
///         be applied
Result<Mesh> mesh_of(const Level& level);

/// The original order, from a fully refined mesh in decoded numbering. [spec/model.md §7]
/// Precondition: the lists of `order` are permutations of the right sizes.
Mesh restore_order(const Mesh& decoded, const OriginalOrder& order);

/// Strip bounds of an index map: first entry and one past the last of every strip (restarts
/// excluded), empty strips left out.
struct StripRange {
  Index first, end;
};
std::vector<StripRange> strip_ranges(std::span<const Index> map);

}  // namespace pstrips::inline codecs
