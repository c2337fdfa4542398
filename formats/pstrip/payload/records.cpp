#include "formats/pstrip/payload/records.h"

#include <algorithm>

#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {

using namespace layout;

namespace {

bool is_row_of(const IndexRow* row, const Chunk& chunk) {
  return row != nullptr && row->offset == chunk.offset && row->bytes == chunk.bytes();
}

/// One row of PIDX that is `least` bytes long or more.
Fault fault_of_row(const IndexRow& row, const FileHeader& header, std::uint64_t least) {
  if (row.mesh >= header.meshes) return Fault::row_contents;
  const bool is_inside = row.bytes >= chunk_bytes(least) && row.bytes <= header.file_bytes &&
                         row.offset <= header.file_bytes - row.bytes;
  return is_inside ? Fault::none : Fault::row_chunk;
}

}  // namespace

Fault fault_of_totals(const FileHeader& header, std::span<const MeshCounts> meshes) {
  const bool hold = std::ranges::all_of(
      kTotals, [&](const Total& total) { return header.*total.total == sum_of(total, meshes); });
  return hold ? Fault::none : Fault::totals;
}

Fault fault_of_rows(std::span<const IndexRow> rows, const FileHeader& header, const Chunk& chunk,
                    const GeometryCodec& codec) {
  if (rows.size() != std::uint64_t{header.meshes} + header.packets) return Fault::row_count;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_base = i < header.meshes;
    const std::uint64_t least = is_base ? codec.min_base_bytes() : codec.min_packet_bytes();
    if (const Fault fault = fault_of_row(rows[i], header, least); fault != Fault::none)
      return fault;
  }
  if (header.meshes == 0 && chunk.offset + chunk.bytes() != header.base_end) return Fault::base_end;
  return Fault::none;
}

Fault fault_of_base_head(const BaseHead& head, const ProgressiveMesh& mesh,
                         const MeshCounts& counts) {
  const bool fits = mesh.encoding == MapEncoding::triangles
                        ? head.map_entries <= counts.map_entries
                        : head.map_entries == counts.map_entries;
  const bool agrees = head.vertices == mesh.base_vertices && head.wedges == mesh.base_wedges;
  return fits && agrees ? Fault::none : Fault::base_counts;
}

Fault fault_of_base_row(const IndexRow* row, const Chunk& chunk, bool is_last,
                        std::uint64_t base_end) {
  if (!is_row_of(row, chunk)) return Fault::row_chunk;
  if (is_last && chunk.offset + chunk.bytes() != base_end) return Fault::base_end;
  return Fault::none;
}

Fault fault_of_packet_row(const IndexRow* row, const Chunk& chunk, const PacketHead& head,
                          const ProgressiveMesh& mesh, const PacketStart& start) {
  if (!is_row_of(row, chunk)) return Fault::row_chunk;
  if (row->mesh != head.mesh || row->vsplits != head.vsplits) return Fault::row_contents;
  if (head.vsplits > mesh.vertices - start.vertices) return Fault::vsplit_count;
  if (head.wedges > mesh.wedges - start.wedges) return Fault::wedge_count;
  if (head.triangles > 0) {
    const std::uint64_t there = mesh.base_map.size() + start.new_corner;
    if (std::uint64_t{3} * head.triangles > full_map_entries(mesh) - there)
      return Fault::triangle_growth;
  }
  return Fault::none;
}

Fault complete_records(ProgressiveMesh& mesh, const PacketHead& head, const PacketStart& start) {
  std::uint64_t wedges = 0, reassigned = 0, map_offsets = 0, triangles = 0;
  std::size_t wedge = start.offset_count;
  for (std::size_t i = start.vsplit; i < mesh.vsplits.size(); ++i) {
    Vsplit& split = mesh.vsplits[i];
    if (mesh.single_wedges) split.wedges = 1;
    wedges += split.wedges;
    reassigned += split.reassigned;
    triangles += split.triangles;
    if (wedges > head.wedges) break;
    std::uint64_t of_record = 0;
    for (const std::size_t end = wedge + split.wedges; wedge < end; ++wedge)
      of_record += mesh.wedge_offset_counts[wedge];
    map_offsets += of_record;
    split.map_offsets = static_cast<Index>(std::min<std::uint64_t>(of_record, kNone));
  }
  if (wedges != head.wedges || reassigned != head.reassigned) return Fault::packet_wedges;
  if (triangles != head.triangles) return Fault::packet_triangles;
  return map_offsets == head.map_offsets ? Fault::none : Fault::packet_offsets;
}

Fault fault_of_ends(std::span<const PacketStart> reached, std::span<const ProgressiveMesh> meshes) {
  for (std::size_t m = 0; m < reached.size(); ++m) {
    if (reached[m].vertices != meshes[m].vertices || reached[m].wedges != meshes[m].wedges)
      return Fault::vsplits_missing;
    if (meshes[m].base_map.size() + reached[m].new_corner != full_map_entries(meshes[m]))
      return Fault::triangle_growth;
  }
  return Fault::none;
}

bool check_components(const ProgressiveMesh& mesh, Index index, FaultSink& faults) {
  const auto have = [&](std::span<const Attribute> formats, Field field) {
    const auto none = std::ranges::find(formats, 0, &Attribute::count);
    if (none == formats.end()) return true;
    const auto element = static_cast<std::uint64_t>(none - formats.begin());
    faults.report(Fault::no_components, {.field = field, .mesh = index, .element = element}, {});
    return false;
  };
  return have({&mesh.position, 1}, Field::position_format) &&
         have(mesh.wedge_attributes, Field::wedge_format) &&
         have(mesh.face_attribute_formats, Field::face_format);
}

Fault fault_of_end(const ProgressiveStrips& strips, std::span<const MeshCounts> counts,
                   std::span<const std::uint8_t> embedded) {
  for (std::size_t m = 0; m < strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = strips.meshes[m];
    if (face_count(mesh) != counts[m].faces) return Fault::face_count;
    if (mesh.faces.attributes.size() != mesh.face_attribute_formats.size())
      return Fault::faces_missing;
  }
  for (std::size_t i = 0; i < embedded.size(); ++i)
    if (embedded[i] != 0 && strips.scene.images[i].data.empty()) return Fault::image_missing;
  return Fault::none;
}

void clear_base(ProgressiveMesh& mesh) {
  mesh.position.data = {};
  mesh.base_wedge_vertex = {};
  for (Attribute& a : mesh.wedge_attributes) a.data = {};
  mesh.base_map = {};
  mesh.triangle_group = {};
}

void cut_back(ProgressiveMesh& mesh, const PacketStart& to) {
  mesh.vsplits.resize(to.vsplit);
  mesh.wedge_offset_counts.resize(to.offset_count);
  mesh.reassigned.resize(to.reassigned);
  mesh.map_offsets.resize(to.map_offset);
  mesh.new_corners.resize(to.new_corner);
  if (has_triangle_groups(mesh))
    mesh.triangle_group.resize((mesh.base_map.size() + to.new_corner) / 3);
  mesh.position.data.resize(to.vertices * mesh.position.element_bytes());
  if (mesh.placement == Placement::optimal)
    mesh.parent_position.resize(to.vsplit * mesh.position.element_bytes());
  for (Attribute& a : mesh.wedge_attributes) a.data.resize(to.wedges * a.element_bytes());
}

}  // namespace pstrips::inline formats
