#include "converters/decode.h"

#include <algorithm>
#include <limits>

#include "codecs/weld/unweld.h"
#include "converters/scene_level.h"

namespace pstrips::inline converters {
namespace {

std::vector<Index> vsplits_after(const ProgressiveStrips& strips, std::size_t packets) {
  std::vector<Index> done(strips.meshes.size(), 0);
  for (std::size_t k = 0; k < packets; ++k)
    done[strips.packets[k].mesh] += strips.packets[k].vsplits;
  return done;
}

std::uint64_t triangles_after(const ProgressiveMesh& mesh, Index vsplits) {
  Level level(mesh);
  level.refine(vsplits);
  std::uint64_t out = 0;
  for_each_triangle(level.view(), [&](Index, Index, Index, Index) { ++out; });
  return out;
}

tl::unexpected<Error> failed_mesh(Error error, std::size_t mesh) {
  error.path = "/meshes/" + std::to_string(mesh);
  return tl::unexpected(std::move(error));
}

// How many entries of a map of triangles, as far as it goes, belong to each group.
std::vector<Index> count_group_entries(const ProgressiveMesh& mesh) {
  std::vector<Index> out(mesh.group_entries.size(), 0);
  if (mesh.triangle_group.empty())
    out[0] = static_cast<Index>(mesh.base_map.size() + mesh.new_corners.size());
  for (const Index group : mesh.triangle_group) out[group] += 3;
  return out;
}

// What the first packets of a mesh leave of its arrays.
void cut_mesh(ProgressiveMesh& mesh, Index vsplits, const Packet& last) {
  RecordStart end;
  while (end.vsplit < vsplits) end.skip(mesh.vsplits[end.vsplit]);
  mesh.vsplits.resize(vsplits);
  mesh.vertices = mesh.base_vertices + vsplits;
  mesh.wedges = mesh.base_wedges + static_cast<Index>(end.offset_count);
  mesh.triangles = last.triangles;
  mesh.strips = last.strips;
  mesh.position.data.resize(mesh.position.element_bytes() * mesh.vertices);
  for (Attribute& a : mesh.wedge_attributes) a.data.resize(a.element_bytes() * mesh.wedges);
  if (mesh.placement == Placement::optimal)
    mesh.parent_position.resize(mesh.position.element_bytes() * vsplits);
  mesh.wedge_offset_counts.resize(end.offset_count);
  mesh.reassigned.resize(end.reassigned);
  mesh.map_offsets.resize(end.map_offset);
  mesh.new_corners.resize(end.new_corner);
  if (mesh.encoding == MapEncoding::triangles) {
    if (!mesh.triangle_group.empty())
      mesh.triangle_group.resize((mesh.base_map.size() + end.new_corner) / 3);
    mesh.group_entries = count_group_entries(mesh);
  }
  mesh.faces = {};
  mesh.face_attribute_formats = {};
  mesh.welding = {};
  mesh.order = {};
  mesh.digest = {};
}

}  // namespace

std::size_t packets_for(const ProgressiveStrips& strips, const LevelChoice& choice) {
  const std::size_t all = strips.packets.size();
  if (choice.packets >= 0) return std::min(all, static_cast<std::size_t>(choice.packets));
  SceneLevel level(strips);
  std::size_t fitting = 0;
  for (std::size_t k = 0; k <= all; ++k) {
    if (k > 0) level.add(strips.packets[k - 1]);
    if (choice.triangles >= 0) {
      if (level.triangles() <= static_cast<std::uint64_t>(choice.triangles)) fitting = k;
    } else if (choice.error >= 0) {
      if (level.error() <= choice.error) return k;
    }
  }
  return choice.triangles >= 0 ? fitting : all;
}

Result<Mesh> decoded_mesh(const Level& level) {
  const ProgressiveMesh& mesh = level.mesh();
  Result<Mesh> decoded = mesh_of(level);
  if (!decoded || level.vertex_count() != mesh.vertices) return decoded;
  if (!mesh.welding.empty()) decoded = unweld(*decoded, mesh.welding);
  if (!decoded || mesh.order.vertex.size() != mesh.decoded_vertices()) return decoded;
  return restore_order(*decoded, mesh.order);
}

SplitLevel split_level(const ProgressiveStrips& strips, std::uint64_t triangles) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  SplitLevel out;
  out.packets =
      packets_for(strips, {.triangles = static_cast<std::int64_t>(std::min(triangles, kMost))});
  out.vsplits = vsplits_after(strips, out.packets);
  if (out.packets == strips.packets.size()) return out;
  SceneLevel level(strips);
  for (std::size_t k = 0; k < out.packets; ++k) level.add(strips.packets[k]);
  if (level.triangles() > triangles) return out;
  const Packet& next = strips.packets[out.packets];
  const ProgressiveMesh& mesh = strips.meshes[next.mesh];
  Index& vsplits = out.vsplits[next.mesh];
  const Index before = vsplits;
  const std::uint64_t shown = triangles_after(mesh, before), room = triangles - level.triangles();
  // Splits bring triangles, so that halving finds the last that fits.
  Index exceeds = before + next.vsplits;
  while (exceeds - vsplits > 1) {
    const Index middle = vsplits + (exceeds - vsplits) / 2;
    const std::uint64_t there = triangles_after(mesh, middle);
    if (there > shown + room) {
      exceeds = middle;
      continue;
    }
    vsplits = middle;
    out.more_triangles = there - std::min(there, shown);
  }
  out.more_vsplits = vsplits - before;
  return out;
}

Result<Model> decode(const ProgressiveStrips& strips, const SplitLevel& at) {
  Model model;
  model.scene = strips.scene;
  for (std::size_t m = 0; m < strips.meshes.size(); ++m) {
    Level level(strips.meshes[m]);
    level.refine(at.vsplits[m]);
    Result<Mesh> mesh = decoded_mesh(level);
    if (!mesh) return failed_mesh(mesh.error(), m);
    model.meshes.push_back(std::move(mesh).value());
  }
  return model;
}

Result<Model> decode(const ProgressiveStrips& strips, std::size_t packets) {
  const std::size_t whole = std::min(packets, strips.packets.size());
  return decode(strips, SplitLevel{.packets = whole, .vsplits = vsplits_after(strips, whole)});
}

Result<Model> decode(const ProgressiveStrips& strips) {
  return decode(strips, strips.packets.size());
}

Result<Model> decode(ProgressiveStrips&& strips, std::size_t packets) {
  Model model;
  const std::vector<Index> vsplits =
      vsplits_after(strips, std::min(packets, strips.packets.size()));
  model.scene = std::move(strips.scene);
  for (std::size_t m = 0; m < strips.meshes.size(); ++m) {
    ProgressiveMesh progressive = std::move(strips.meshes[m]);
    Level level(progressive);
    level.refine(vsplits[m]);
    // A level that goes no further needs no records.
    level.release_symbols();
    progressive.base_map = {};
    progressive.vsplits = {};
    progressive.wedge_offset_counts = {};
    progressive.map_offsets = {};
    progressive.reassigned = {};
    progressive.new_corners = {};
    Result<Mesh> mesh = decoded_mesh(level);
    if (!mesh) return failed_mesh(mesh.error(), m);
    model.meshes.push_back(std::move(mesh).value());
  }
  return model;
}

ProgressiveStrips cut(const ProgressiveStrips& strips, std::size_t packets) {
  ProgressiveStrips out = strips;
  if (packets >= strips.packets.size() && strips.complete) return out;
  out.complete = true;
  out.packets.resize(std::min(packets, out.packets.size()));
  const std::vector<Index> vsplits = vsplits_after(out, out.packets.size());
  std::vector<Packet> last = out.bases;
  for (const Packet& p : out.packets) last[p.mesh] = p;
  for (std::size_t m = 0; m < out.meshes.size(); ++m) {
    ProgressiveMesh& mesh = out.meshes[m];
    // A file that ends early announces vertices that it does not bring.
    if (vsplits[m] < mesh.vertices - mesh.base_vertices) cut_mesh(mesh, vsplits[m], last[m]);
    // Or it ends after its last packet, before the faces.
    if (mesh.faces.empty()) mesh.face_attribute_formats = {};
  }
  // The last level of a cut file is its own full resolution, but not the original's: its error
  // stays what it is.
  return out;
}

}  // namespace pstrips::inline converters
