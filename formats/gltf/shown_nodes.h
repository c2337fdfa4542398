#pragma once

#include <vector>

#include "core/limits.h"
#include "core/matrix4.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats {

/// What a glTF says of the nodes of its scene beyond Scene::nodes.
struct ShownNode {
  bool is_shown = true;  ///< in the default scene
  /// Where EXT_mesh_gpu_instancing puts the node's meshes, within the node; else once, as they are.
  std::vector<Matrix4> instances{kIdentity4};
};

/// One for each node of the scene. All are shown once when the scene came from no glTF, or has
/// other nodes by now. The default scene is the one that the asset names, else the first; without
/// any, all nodes are shown. [glTF 2.0 §3.5.1]
///
/// errors  corrupt, over_limit for the accessors of instances
/// cost    O(size of what read_gltf kept + instances)
Result<std::vector<ShownNode>> find_shown_nodes(const Scene& scene, const Limits& limits = {});

}  // namespace pstrips::inline formats
