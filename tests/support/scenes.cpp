#include "tests/support/scenes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "converters/scene_level.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunk_table.h"
#include "tests/support/meshes.h"

namespace pstrips::test {

Model scene_of_tori(Index count) {
  Model model;
  for (Index m = 0; m < count; ++m) {
    const Index size = 2 + 7 * m % 5;
    model.meshes.push_back(torus(6 * size, 5 * size));
    Node& node = model.scene.nodes.emplace_back();
    node.meshes = {m};
    const double scale = std::pow(10, -2 + 3.0 * (37 * m % count) / count);
    for (const std::size_t diagonal : {0u, 5u, 10u}) node.matrix[diagonal] = scale;
    node.matrix[12] = 40.0 * m;
  }
  return model;
}

ProgressiveStrips mesh_after_mesh(const ProgressiveStrips& strips) {
  ProgressiveStrips out = strips;
  std::ranges::stable_sort(out.packets, {}, &Packet::mesh);
  return out;
}

std::vector<ScenePoint> error_over_bytes(const ProgressiveStrips& strips, int steps) {
  const Bytes file = write_binary(strips).value();
  std::vector<double> ends;
  std::uint64_t first = 0;
  for (const Chunk& chunk : read_chunks(file).chunks) {
    if (chunk.type != kPacketChunk) continue;
    if (ends.empty()) first = chunk.offset;
    ends.push_back(static_cast<double>(chunk.offset + chunk.bytes() - first));
  }
  const std::vector<double> scale = instance_scales(strips.scene, strips.meshes.size());
  std::vector<double> now;
  for (const Packet& base : strips.bases)
    now.push_back(SceneLevel::scaled_error(base, scale[base.mesh]));
  std::vector<ScenePoint> out;
  std::size_t arrived = 0;
  for (int step = 1; step <= steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    for (; arrived < ends.size() && ends[arrived] <= share * ends.back(); ++arrived) {
      const Packet& packet = strips.packets[arrived];
      now[packet.mesh] = SceneLevel::scaled_error(packet, scale[packet.mesh]);
    }
    out.push_back({share, *std::ranges::max_element(now), std::reduce(now.begin(), now.end())});
  }
  return out;
}

}  // namespace pstrips::test
