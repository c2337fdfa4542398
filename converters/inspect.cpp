#include "converters/inspect.h"

#include <algorithm>
#include <deque>

#include "codecs/filter/display_level.h"
#include "converters/scene_level.h"
#include "formats/pstrip/payload/check.h"

namespace pstrips::inline converters {
namespace {

// Derives the strips of a mesh only when it has grown by this share or ends: a file may have a
// packet for each triangle.
constexpr std::size_t kGrowth = 64;

void add_length(std::size_t entries, std::vector<std::uint64_t>& lengths) {
  if (entries < 3) return;
  std::size_t bin = 0;
  while ((std::uint64_t{4} << bin) <= entries) ++bin;
  if (lengths.size() <= bin) lengths.resize(bin + 1);
  ++lengths[bin];
}

/// The display strips of all meshes while packets arrive.
class Display {
 public:
  explicit Display(const ProgressiveStrips& strips) {
    for (const ProgressiveMesh& mesh : strips.meshes) {
      levels_.emplace_back(mesh, Filter::dtfs);
      updated_at_.push_back(levels_.back().level().resolved().size());
      sent_ += levels_.back().cost().vertices_sent;
      derived_ += levels_.back().derived_strips();
    }
  }

  void add(const Packet& packet) {
    DisplayLevel& level = levels_[packet.mesh];
    level.refine(packet.vsplits);
    if (!is_due(packet.mesh)) return;
    sent_ -= level.cost().vertices_sent;
    derived_ -= level.derived_strips();
    level.update();
    sent_ += level.cost().vertices_sent;
    derived_ += level.derived_strips();
    updated_at_[packet.mesh] = level.level().resolved().size();
  }

  std::uint64_t vertices_sent() const { return sent_; }
  std::uint64_t derived_strips() const { return derived_; }
  const std::deque<DisplayLevel>& levels() const { return levels_; }

 private:
  bool is_due(Index mesh) const {
    const Level& level = levels_[mesh].level();
    return level.mesh().encoding != MapEncoding::triangles ||
           level.resolved().size() - updated_at_[mesh] >= updated_at_[mesh] / kGrowth ||
           level.vsplits_done() == level.mesh().vsplits.size();
  }

  std::deque<DisplayLevel> levels_;
  std::vector<std::size_t> updated_at_;  // entries of each map
  std::uint64_t sent_ = 0, derived_ = 0;
};

void count_lengths(const DisplayLevel& last, std::vector<std::uint64_t>& lengths) {
  const ProgressiveMesh& mesh = last.level().mesh();
  DisplayStrips strips = mesh.base_map;  // symbols count like wedges
  if (mesh.encoding == MapEncoding::triangles) {
    strips.clear();
    last.append_display(strips);
  }
  for (const StripRange& range : strip_ranges(strips)) add_length(range.end - range.first, lengths);
}

void add_counts(const ProgressiveMesh& mesh, Inspection& out) {
  out.vertices += mesh.vertices;
  out.wedges += mesh.wedges;
  out.triangles += mesh.triangles;
  out.faces += face_count(mesh);
  out.vsplits += mesh.vsplits.size();
  out.map_entries += mesh.base_map.size() + mesh.new_corners.size();
  out.map_offsets += mesh.map_offsets.size();
  if (mesh.encoding != MapEncoding::triangles) out.strips += mesh.strips;
}

}  // namespace

std::string strip_length_bin(std::size_t bin) {
  if (bin == 0) return "3";
  const std::uint64_t low = std::uint64_t{2} << bin;
  return std::to_string(low) + "-" + std::to_string(2 * low - 1);
}

Inspection inspect(const ProgressiveStrips& strips, const std::vector<std::uint64_t>& chunk_ends) {
  Inspection out;
  for (const ProgressiveMesh& mesh : strips.meshes) add_counts(mesh, out);
  if (out.vsplits > 0)
    out.places_per_vsplit = static_cast<double>(out.map_offsets) / static_cast<double>(out.vsplits);

  Display display(strips);
  SceneLevel scene(strips);
  InspectedLevel row;
  const auto add_row = [&] {
    row.vertices = scene.vertices();
    row.triangles = scene.triangles();
    row.strips = scene.strips() + display.derived_strips();
    row.vertices_sent = display.vertices_sent();
    row.error = scene.error();
    row.one_sided_error = scene.one_sided_error();
    row.bytes_so_far = row.packet < chunk_ends.size() ? chunk_ends[row.packet] : 0;
    out.levels.push_back(row);
  };
  add_row();
  for (const Packet& packet : strips.packets) {
    display.add(packet);
    scene.add(packet);
    ++row.packet;
    row.mesh = packet.mesh;
    add_row();
  }
  out.strips += display.derived_strips();
  for (const DisplayLevel& level : display.levels()) count_lengths(level, out.strip_lengths);
  return out;
}

}  // namespace pstrips::inline converters
