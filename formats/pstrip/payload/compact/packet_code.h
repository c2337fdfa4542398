#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "core/fault_list.h"
#include "formats/pstrip/payload/compact/mesh_state.h"
#include "formats/pstrip/payload/compact/new_wedges.h"
#include "formats/pstrip/payload/compact/split_batch.h"
#include "formats/pstrip/payload/compact/wedge_code.h"

// For formats/pstrip/payload/compact: the records of one packet, once for writing and for reading.
// [spec/compact.md §6, §7]

namespace pstrips::inline formats {

/// The records of one packet.
///
/// Records is what they are read from or appended to:
///   const GridSplit* split_of(Index vertex)    null: it does not split; a reader's always
///   GridPoint isolated(std::size_t i)          the position of a vertex on its own; a reader's any
///   SplitRecord& record()                      of the vertex that was asked for last
///   const std::int32_t* cells_of(Index wedge)  a reader's null
///   void take(Index parent, Index added)       the record is complete
template <class Coder, class Records>
class PacketCode {
 public:
  PacketCode(Coder& coder, MeshState& state, Records& records)
      : coder_(coder), state_(state), records_(records), attributes_(coder, state) {}

  /// A batch of splits.
  Result<void> run_batch() {
    return code_batch(
        coder_, state_.splits, BatchLimits{state_.max_vertices, state_.max_faces},
        [&](Index vertex) { return records_.split_of(vertex); },
        [&](Index parent, Index added) { return code_record(parent, added); });
  }

  /// Vertices that no triangle shows and that come from no other.
  Result<void> run_isolated(Index count) {
    for (Index i = 0; i < count; ++i)
      if (auto ok = code_isolated(records_.isolated(i)); !ok) return ok;
    return {};
  }

 private:
  static tl::unexpected<Error> too_many() { return broken(Fault::compact_counts); }

  Result<void> code_record(Index parent, Index added) {
    if constexpr (Coder::kReads)
      if (coder_.overrun()) return broken(Fault::compact_run);
    SplitRecord& record = records_.record();
    if constexpr (Coder::kReads) record.clear();
    const StarMesh& mesh = state_.mesh();
    list_corners(added, record.moved);
    if (!state_.single_wedges || state_.groups > 1) list_corners(parent, record.kept);
    coder_.part(Part::wedges);
    if (!state_.single_wedges) {
      if (auto ok = WedgeCode<Coder>(coder_, state_, parent, added, record).run(); !ok) return ok;
    } else if constexpr (Coder::kReads) {
      record.new_wedges = 1;
      record.corners.assign(mesh.corners().begin() + std::ptrdiff_t{3} * state_.faces,
                            mesh.corners().end());
    }
    if (state_.wedges + record.new_wedges > state_.max_wedges) return too_many();
    if (state_.groups > 1) code_groups(coder_, state_, parent, added, record);
    show(added, record);
    if (state_.columns > 0) code_attributes(added, record);
    records_.take(parent, added);
    return {};
  }

  /// The corners of a vertex in the order in which the split went over them, those of new faces
  /// aside.
  void list_corners(Index vertex, std::vector<Index>& out) const {
    state_.mesh().corners_of(vertex, out);
    std::erase_if(out, [&](Index corner) { return corner >= 3 * state_.faces; });
    std::ranges::reverse(out);
  }

  /// Brings the state up to the record.
  void show(Index added, const SplitRecord& record) {
    state_.wedges += record.new_wedges;
    state_.faces = state_.mesh().face_count();
    state_.face_group.insert(state_.face_group.end(), record.groups.begin(), record.groups.end());
    if (state_.single_wedges) return;
    while (state_.lists.size() < state_.wedges) state_.lists.add(added);
    for (std::size_t i = 0; i < record.moved.size(); ++i) {
      Index& wedge = state_.corner_wedge[record.moved[i]];
      --state_.lists.uses(wedge);
      wedge = record.shown[i];
      ++state_.lists.uses(wedge);
    }
    state_.corner_wedge.insert(state_.corner_wedge.end(), record.corners.begin(),
                               record.corners.end());
    for (const Index wedge : record.corners)
      if (wedge + record.new_wedges >= state_.wedges) ++state_.lists.uses(wedge);
  }

  void code_attributes(Index added, const SplitRecord& record) {
    coder_.part(Part::attributes);
    attributes_.start(state_.wedges - record.new_wedges);
    for (const Index corner : record.moved) attributes_.add_face(corner);
    for (Index at = 0; at < record.corners.size(); ++at) {
      const Index corner = 3 * state_.faces - static_cast<Index>(record.corners.size()) + at;
      if (state_.mesh().vertex_of(corner) == added) attributes_.add_face(corner);
    }
    attributes_.code(added, record.kept.empty() ? kNone : state_.wedge_of(record.kept.front()),
                     [&](Index wedge) { return records_.cells_of(wedge); });
  }

  Result<void> code_isolated(GridPoint wanted) {
    if constexpr (Coder::kReads)
      if (coder_.overrun()) return broken(Fault::compact_run);
    GridPoint& at = state_.last_isolated;
    coder_.part(Part::positions);
    const auto coded = [&](unsigned k, std::int32_t from, std::int32_t to) {
      return from + state_.models.isolated_position[k].code(coder_, Coder::kReads ? 0 : to - from);
    };
    at = {coded(0, at.x, wanted.x), coded(1, at.y, wanted.y), coded(2, at.z, wanted.z)};
    if (!is_on_grid(at)) return broken(Fault::compact_step);
    coder_.part(Part::wedges);
    SplitRecord& record = records_.record();
    if (state_.single_wedges)
      record.new_wedges = 1;
    else
      record.new_wedges = code_count(coder_, state_.models.isolated_wedges, record.new_wedges);
    if (state_.mesh().vertex_count() >= state_.max_vertices ||
        std::uint64_t{state_.wedges} + record.new_wedges > state_.max_wedges)
      return too_many();
    const Index added = state_.splits.add_vertex(at);
    show(added, record);
    if (state_.columns > 0) {
      const Index first = state_.wedges - record.new_wedges;
      coder_.part(Part::attributes);
      attributes_.start(first);
      attributes_.code(added, first > 0 ? first - 1 : kNone,
                       [&](Index wedge) { return records_.cells_of(wedge); });
    }
    records_.take(added, added);
    return {};
  }

  Coder& coder_;
  MeshState& state_;
  Records& records_;
  NewWedges<Coder> attributes_;
};

}  // namespace pstrips::inline formats
