#include "formats/pstrip/payload/reservation.h"

#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {

Reservation::Reservation(std::span<const IndexRow> rows, std::size_t meshes, std::uint64_t budget)
    : packets_(meshes), budget_(budget) {
  for (const IndexRow& row : rows.subspan(meshes)) {
    ++packets_[row.mesh].count;
    packets_[row.mesh].payload_bytes += row.bytes - chunk_bytes(0);
  }
}

void Reservation::reserve(ProgressiveMesh& mesh, Index index, std::uint64_t vsplits,
                          const GeometryCodec& codec) {
  const auto within_budget = [&](auto& list, std::uint64_t n) {
    const std::uint64_t bytes = n * sizeof(list[0]);
    if (bytes > budget_) return;
    budget_ -= bytes;
    list.reserve(n);
  };
  const std::uint64_t position_bytes = mesh.position.element_bytes();
  within_budget(mesh.position.data, mesh.vertices * position_bytes);
  for (Attribute& a : mesh.wedge_attributes) within_budget(a.data, mesh.wedges * a.element_bytes());
  within_budget(mesh.vsplits, vsplits);
  within_budget(mesh.wedge_offset_counts, mesh.wedges - mesh.base_wedges);
  if (mesh.placement == Placement::optimal)
    within_budget(mesh.parent_position, vsplits * position_bytes);
  if (mesh.encoding == MapEncoding::triangles)
    within_budget(mesh.new_corners, full_map_entries(mesh));
  if (has_triangle_groups(mesh)) within_budget(mesh.triangle_group, mesh.triangles);
  const Packets& packets = packets_[index];
  within_budget(mesh.map_offsets,
                codec.estimate_map_offsets(mesh, vsplits, packets.count, packets.payload_bytes));
}

}  // namespace pstrips::inline formats
