#pragma once

#include <array>
#include <vector>

#include "formats/pstrip/payload/compact/attribute_code.h"
#include "formats/pstrip/payload/compact/mesh_state.h"

namespace pstrips::inline formats {

/// The attributes of the wedges that a record brings.
template <class Coder>
class NewWedges {
 public:
  NewWedges(Coder& coder, MeshState& state)
      : state_(state), attributes_(coder, state.cells, state.attributes, state.wedge_cells) {}

  /// Starts on the wedges from `first` on.
  void start(Index first) {
    first_ = first;
    around_.assign(state_.wedges - first, {});
  }
  /// A corner of a vertex that is new, in a face that its wedge is shown in.
  void add_face(Index corner) {
    const Index wedge = state_.wedge_of(corner);
    if (wedge < first_) return;
    const Index next = StarMesh::next_in_face(corner);
    const Index previous = StarMesh::previous_in_face(corner);
    WedgeSurroundings& around = around_[wedge - first_];
    around.add_neighbour(state_.wedge_of(next));
    around.add_neighbour(state_.wedge_of(previous));
    const GridPoint at = position_of(corner);
    around.add_face(position_of(next) - at, position_of(previous) - at);
  }

  /// vertex   that has them all
  /// usual    a wedge where there is nothing else to go by, or kNone
  template <class CellsOf>
  void code(Index vertex, Index usual, CellsOf&& cells_of) {
    state_.wedge_cells.resize(std::size_t{state_.wedges} * state_.columns);
    if (!state_.single_wedges) state_.lists.list(vertex, kMostLooks, listed_);
    const GridPoint at = state_.splits.position[vertex];
    for (Index wedge = first_; wedge < state_.wedges; ++wedge) {
      WedgeSurroundings& around = around_[wedge - first_];
      if (around.neighbours().empty() && usual != kNone) around.add_neighbour(usual);
      std::array<GridPoint, PlaneFit::kMost> arms;
      std::size_t count = 0;
      for (const Index other : around.neighbours())
        arms[count++] = state_.splits.position[state_.vertex_of_wedge(other)] - at;
      siblings_.clear();
      for (const Index other : listed_)
        if (other < wedge) siblings_.push_back(other);
      attributes_.code(wedge, around, {arms.data(), count}, siblings_, cells_of(wedge));
    }
  }

 private:
  GridPoint position_of(Index corner) const {
    return state_.splits.position[state_.mesh().vertex_of(corner)];
  }

  static constexpr std::size_t kMostLooks = 64;  // at wedges of one vertex

  MeshState& state_;
  AttributeCode<Coder> attributes_;
  Index first_ = 0;
  std::vector<WedgeSurroundings> around_;
  std::vector<Index> listed_, siblings_;  // scratch: wedges of the vertex
};

}  // namespace pstrips::inline formats
