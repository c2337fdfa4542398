#include "converters/inspect.h"

#include <deque>

#include "codecs/filter/display_level.h"
#include "converters/scene_level.h"
#include "formats/pstrip/payload/check.h"

namespace pstrips::inline converters {
std::string strip_length_bin(std::size_t bin) {
  if (bin == 0) return "3";
  const std::uint64_t low = std::uint64_t{2} << bin;
  return std::to_string(low) + "-" + std::to_string(2 * low - 1);
}

Inspection inspect(const ProgressiveStrips& strips, const std::vector<std::uint64_t>& chunk_ends) {
  Inspection out;
  std::deque<DisplayLevel> levels;
  for (const ProgressiveMesh& mesh : strips.meshes) {
    out.vertices += mesh.vertices;
    out.wedges += mesh.wedges;
    out.triangles += mesh.triangles;
    out.faces += face_count(mesh);
    out.strips += mesh.strips;
    out.vsplits += mesh.vsplits.size();
    out.map_entries += mesh.base_map.size();
    out.map_offsets += mesh.map_offsets.size();
    levels.emplace_back(mesh, Filter::dtfs);
    for (const StripRange& range : strip_ranges(mesh.base_map)) {
      const Index entries = range.end - range.first;
      if (entries < 3) continue;
      std::size_t bin = 0;
      while ((std::uint64_t{4} << bin) <= entries) ++bin;
      if (out.strip_lengths.size() <= bin) out.strip_lengths.resize(bin + 1);
      ++out.strip_lengths[bin];
    }
  }
  if (out.vsplits > 0)
    out.places_per_vsplit = static_cast<double>(out.map_offsets) / static_cast<double>(out.vsplits);

  SceneLevel scene(strips);
  InspectedLevel row;
  for (const DisplayLevel& level : levels) row.vertices_sent += level.cost().vertices_sent;
  const auto add_row = [&] {
    row.vertices = scene.vertices();
    row.triangles = scene.triangles();
    row.strips = scene.strips();
    row.error = scene.error();
    row.one_sided_error = scene.one_sided_error();
    row.bytes_so_far = row.packet < chunk_ends.size() ? chunk_ends[row.packet] : 0;
    out.levels.push_back(row);
  };
  add_row();
  for (const Packet& packet : strips.packets) {
    DisplayLevel& level = levels[packet.mesh];
    const std::uint64_t sent_before = level.cost().vertices_sent;
    level.refine(packet.vsplits);
    level.update();
    row.vertices_sent = row.vertices_sent + level.cost().vertices_sent - sent_before;
    scene.add(packet);
    ++row.packet;
    row.mesh = packet.mesh;
    add_row();
  }
  return out;
}

}  // namespace pstrips::inline converters
