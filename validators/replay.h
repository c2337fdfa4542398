#pragma once

#include <span>
#include <vector>

#include "core/fault_list.h"
#include "core/progressive_strips.h"

namespace pstrips::inline validators {

/// What a mesh shows at a level.
struct Shown {
  Index vertices = 0, triangles = 0, strips = 0;  ///< strips with at least one triangle
};

/// A mesh after its last record, and what it showed on the way.
struct Replay {
  std::vector<Shown> levels;        ///< after the base and after each of its packets
  std::vector<Index> map;           ///< resolved
  std::vector<Index> wedge_vertex;  ///< empty with single wedges
  bool finished = false;            ///< all records were replayed
};

/// Replays the records of a mesh one by one and checks each against the state before it.
/// [spec/vsplit.md]
///
/// mesh     lists of matching lengths, base and index map valid
/// packets  record counts of the mesh's packets in order, together no more than mesh.vsplits
/// faults   gets the first record that breaks a rule (`Where` without its mesh); what follows it
///          is not judged, since it builds on it
/// cost     O(map + records + lists) where symbols and reassigned wedges are as rare as an encoder
///          makes them; a file made to cost more is stopped when the work of StripState is spent,
///          with Fault::too_much_work
Replay replay(const ProgressiveMesh& mesh, std::span<const Index> packets, Faults& faults);

}  // namespace pstrips::inline validators
