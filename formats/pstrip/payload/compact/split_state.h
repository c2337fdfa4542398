#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/progressive_strips.h"
#include "core/star_mesh.h"
#include "formats/pstrip/payload/compact/mixed_models.h"
#include "formats/pstrip/payload/compact/split_models.h"

namespace pstrips::inline formats {

/// What a split does: a vertex becomes two. Which of them keeps the number does not matter where
/// both move; the rules of the code fix it, see split_code.h.
struct GridSplit {
  bool chord = true;          ///< false: the faces form no ring, or no chord of it parts them
  unsigned from = 0, to = 0;  ///< chord: the new vertex gets the faces between these neighbours
  GridPoint step;             ///< from the vertex that keeps the number to the new one
  std::vector<bool> moves;    ///< no chord: by corner of the vertex, whether the new vertex gets it
  /// No chord: the third vertex of each new face, and whether it is (vertex, new, third) or
  /// (vertex, third, new).
  std::vector<Index> third;
  std::vector<bool> new_first;
};

/// Where a vertex stands in a batch.
enum class Turn : std::uint8_t {
  waits,         ///< not visited yet
  waits_recent,  ///< the same; it came into being or split in the batch before
  passed,        ///< does not split
  split,         ///< split, or came into being by it
};

/// A mesh between two batches, as both sides know it.
struct SplitState {
  explicit SplitState(Placement how, Effort effort = Effort::fast)
      : placement(how),
        models(how),
        mixed(effort == Effort::small ? std::make_unique<MixedModels>(how) : nullptr) {}

  Placement placement;
  StarMesh mesh;
  std::vector<GridPoint> position;
  /// All vertices, neighbours near each other: each new one stands behind the one it came from.
  std::vector<Index> order;
  std::vector<Turn> turn;
  std::vector<std::uint8_t> split_around;  ///< neighbours split in this batch; stops at 255
  std::vector<std::uint8_t> normal_error;  ///< quarter octaves, smoothed
  SplitModels models;
  std::unique_ptr<MixedModels> mixed;  ///< with the effort `small`

  Index add_vertex(GridPoint at) {
    const Index vertex = mesh.add_vertex();
    extend(at);
    order.push_back(vertex);
    return vertex;
  }
  /// Room for the data of a vertex that the mesh has already.
  void extend(GridPoint at) {
    position.push_back(at);
    turn.push_back(Turn::waits);
    split_around.push_back(0);
    normal_error.push_back(0);
    if (mixed) mixed->trace.emplace_back();
  }
};

}  // namespace pstrips::inline formats
