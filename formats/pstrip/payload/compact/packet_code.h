#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "core/result.h"
#include "formats/pstrip/payload/compact/mesh_state.h"
#include "formats/pstrip/payload/compact/split_batch.h"
#include "formats/pstrip/payload/compact/wedge_code.h"

// For formats/pstrip/payload/compact: the records of one packet, once for writing and for reading.
// [spec/compact.md §6, §7]

namespace pstrips::inline formats {

/// The attributes of one new wedge.
template <class Coder>
class AttributeCode {
 public:
  AttributeCode(Coder& coder, MeshState& state) : coder_(coder), state_(state) {
    predicted_.resize(state.columns);
  }

  /// Starts a wedge: what is coded now is expected to lie in the middle of the wedges added.
  void start() {
    std::ranges::fill(predicted_, 0);
    count_ = 0;
  }
  void add(Index wedge) {
    const std::int32_t* const cells = row(wedge);
    for (unsigned c = 0; c < state_.columns; ++c) predicted_[c] += cells[c];
    ++count_;
  }
  /// A face that shows the wedge at `corner`: its other corners.
  void add_face(Index corner) {
    add(state_.wedge_of(StarMesh::next_in_face(corner)));
    add(state_.wedge_of(StarMesh::previous_in_face(corner)));
  }

  bool is_empty() const { return count_ == 0; }

  /// wanted  `columns` cells to write; null for a reader
  void code(Index wedge, const std::int32_t* wanted) {
    state_.wedge_cells.resize(std::size_t{wedge + 1} * state_.columns);
    std::int32_t* const cells = state_.wedge_cells.data() + std::size_t{wedge} * state_.columns;
    for (unsigned c = 0; c < state_.columns; ++c) {
      const auto predicted =
          static_cast<std::int32_t>(predicted_[c] / std::max<std::int64_t>(count_, 1));
      std::uint8_t& before = state_.last_residual[c];
      NumberModel& model = state_.models.column[c][before];
      const std::int32_t residual =
          model.code(coder_, wanted != nullptr ? wanted[c] - predicted : 0);
      cells[c] = std::clamp(predicted + residual, -kMaxCell, kMaxCell);
      const auto size = static_cast<std::uint32_t>(residual < 0 ? -residual : residual);
      before = static_cast<std::uint8_t>(std::bit_width(size));
    }
  }

 private:
  const std::int32_t* row(Index wedge) const {
    return state_.wedge_cells.data() + std::size_t{wedge} * state_.columns;
  }
  Coder& coder_;
  MeshState& state_;
  std::vector<std::int64_t> predicted_;
  std::int64_t count_ = 0;
};

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
  static tl::unexpected<Error> too_many() {
    return fail(ErrorCode::corrupt, "more vertices or wedges than the mesh has");
  }

  Result<void> code_record(Index parent, Index added) {
    if constexpr (Coder::kReads)
      if (coder_.overrun()) return fail(ErrorCode::corrupt, "records end early");
    SplitRecord& record = records_.record();
    if constexpr (Coder::kReads) record.clear();
    const StarMesh& mesh = state_.mesh();
    list_corners(added, record.moved);
    if (!state_.single_wedges || state_.groups > 1) list_corners(parent, record.kept);
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
    if (state_.columns > 0) code_attributes(record);
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
    state_.wedge_vertex.resize(state_.wedges, added);
    for (std::size_t i = 0; i < record.moved.size(); ++i)
      state_.corner_wedge[record.moved[i]] = record.shown[i];
    state_.corner_wedge.insert(state_.corner_wedge.end(), record.corners.begin(),
                               record.corners.end());
  }

  void code_attributes(const SplitRecord& record) {
    const auto first_corner =
        static_cast<Index>(std::size_t{3} * state_.faces - record.corners.size());
    for (Index wedge = state_.wedges - record.new_wedges; wedge < state_.wedges; ++wedge) {
      attributes_.start();
      for (const Index corner : record.moved)
        if (state_.wedge_of(corner) == wedge) attributes_.add_face(corner);
      for (Index corner = first_corner; corner < 3 * state_.faces; ++corner)
        if (state_.wedge_of(corner) == wedge) attributes_.add_face(corner);
      if (attributes_.is_empty() && !record.kept.empty())
        attributes_.add(state_.wedge_of(record.kept.front()));
      attributes_.code(wedge, records_.cells_of(wedge));
    }
  }

  Result<void> code_isolated(GridPoint wanted) {
    if constexpr (Coder::kReads)
      if (coder_.overrun()) return fail(ErrorCode::corrupt, "records end early");
    GridPoint& at = state_.last_isolated;
    const auto coded = [&](unsigned k, std::int32_t from, std::int32_t to) {
      return from + state_.models.isolated_position[k].code(coder_, Coder::kReads ? 0 : to - from);
    };
    at = {coded(0, at.x, wanted.x), coded(1, at.y, wanted.y), coded(2, at.z, wanted.z)};
    if (!is_on_grid(at)) return fail(ErrorCode::corrupt, "vertex leaves the grid");
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
    for (Index wedge = state_.wedges - record.new_wedges;
         state_.columns > 0 && wedge < state_.wedges; ++wedge) {
      attributes_.start();
      if (wedge > 0) attributes_.add(wedge - 1);
      attributes_.code(wedge, records_.cells_of(wedge));
    }
    records_.take(added, added);
    return {};
  }

  Coder& coder_;
  MeshState& state_;
  Records& records_;
  AttributeCode<Coder> attributes_;
};

}  // namespace pstrips::inline formats
