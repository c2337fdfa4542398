#pragma once

#include <vector>

#include "core/progressive_strips.h"
#include "core/scene.h"

namespace pstrips::test {

/// Tori of 12 × 10 to 36 × 30 vertices, one node each, enlarged by 0.01 to 10 in an order that has
/// nothing to do with their sizes. Same count, same scene.
Model scene_of_tori(Index count);

/// The same packets, all of a mesh before those of the next.
ProgressiveStrips mesh_after_mesh(const ProgressiveStrips& strips);

/// How far a scene is from the original after a share of the bytes between bases and tail.
struct ScenePoint {
  double share = 0;         ///< of the bytes of all packets
  double max = 0, sum = 0;  ///< of the meshes' scaled errors, see SceneLevel
};

/// After 1/steps, 2/steps … of the packets' bytes, whole packets only.
std::vector<ScenePoint> error_over_bytes(const ProgressiveStrips& strips, int steps);

}  // namespace pstrips::test
