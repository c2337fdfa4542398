#pragma once

#include <concepts>

#include "formats/pstrip/payload/geometry.h"
#include "formats/pstrip/payload/predicates.h"

// For formats/pstrip/payload/plain: the records of BASE and PCKT as they stand in the file, once
// for reading, writing, sizing and locating. [spec/container.md §7]

namespace pstrips::inline formats::plain {

using namespace layout;

inline constexpr std::uint64_t kBaseHeadBytes = 16;
inline constexpr std::uint64_t kPacketHeadBytes = 24;

/// Head is BaseHead or PacketHead, const to write.
template <class Io, class Head>
void head_fields(Io& io, Head& head) {
  io.number(head.mesh);
  if constexpr (std::same_as<std::remove_const_t<Head>, BaseHead>) {
    io.number(head.vertices);
    io.number(head.wedges);
    io.number(head.map_entries);
  } else {
    io.number(head.first_vsplit);
    io.number(head.vsplits);
    io.number(head.wedges);
    io.number(head.reassigned);
    io.number(head.map_offsets);
  }
}

/// The head of a PCKT goes on when its mesh has a map of triangles.
template <class Io, class Head>
void growth_fields(Io& io, Head& head, const ProgressiveMesh& mesh) {
  if constexpr (std::same_as<std::remove_const_t<Head>, PacketHead>) {
    if (mesh.encoding != MapEncoding::triangles) return;
    io.number(head.triangles);
    io.zeros(4);
  }
}

template <class Io, class M>
void base_array_fields(Io& io, const BaseHead& h, M& mesh) {
  io.part(Part::base_positions);
  io.run(mesh.position, 0, h.vertices);
  io.align();
  io.part(Part::base_wedges);
  if (!mesh.single_wedges) io.run(mesh.base_wedge_vertex, 0, h.wedges);
  io.align();
  for (auto& a : mesh.wedge_attributes) {
    io.run(a, 0, h.wedges);
    io.align();
  }
  io.part(Part::base_map);
  io.run(mesh.base_map, 0, h.map_entries);
  io.align();
  if (has_triangle_groups(mesh)) io.run(mesh.triangle_group, 0, h.map_entries / 3);
  io.align();
}

/// start  where the packet's part of each of the mesh's lists begins
template <class Io, class M>
void packet_array_fields(Io& io, const PacketHead& h, M& mesh, const PacketStart& start) {
  io.part(Part::parents);
  io.column(mesh.vsplits, &Vsplit::parent, start.vsplit, h.vsplits);
  io.align();
  io.part(Part::counts);
  if (!mesh.single_wedges) {
    io.column(mesh.vsplits, &Vsplit::wedges, start.vsplit, h.vsplits);
    io.align();
    io.column(mesh.vsplits, &Vsplit::reassigned, start.vsplit, h.vsplits);
    io.align();
  }
  // With single wedges there is one new wedge a vsplit: the same list serves both forms.
  io.run(mesh.wedge_offset_counts, start.offset_count, h.wedges);
  io.align();
  const bool grows = mesh.encoding == MapEncoding::triangles;
  if (grows) io.column(mesh.vsplits, &Vsplit::triangles, start.vsplit, h.vsplits);
  io.align();
  io.part(Part::positions);
  io.run(mesh.position, start.vertices, h.vsplits);
  io.align();
  io.part(Part::parent_positions);
  if (mesh.placement == Placement::optimal)
    io.run(mesh.parent_position, mesh.position.element_bytes(), start.vsplit, h.vsplits);
  io.align();
  io.part(Part::attributes);
  for (auto& a : mesh.wedge_attributes) {
    io.run(a, start.wedges, h.wedges);
    io.align();
  }
  io.part(Part::reassigned);
  io.run(mesh.reassigned, start.reassigned, h.reassigned);
  io.align();
  io.part(Part::map_offsets);
  io.run(mesh.map_offsets, start.map_offset, h.map_offsets);
  io.align();
  io.part(Part::new_triangles);
  if (grows) io.run(mesh.new_corners, start.new_corner, std::uint64_t{3} * h.triangles);
  io.align();
  if (has_triangle_groups(mesh))
    io.run(mesh.triangle_group, (mesh.base_map.size() + start.new_corner) / 3, h.triangles);
  io.align();
}

// ---- Both payloads at a time: a head and the arrays that it counts -------------------------

template <class Io, class M>
void array_fields(Io& io, const BaseHead& head, M& mesh, const PacketStart&) {
  base_array_fields(io, head, mesh);
}
template <class Io, class M>
void array_fields(Io& io, const PacketHead& head, M& mesh, const PacketStart& start) {
  packet_array_fields(io, head, mesh, start);
}

template <class Io, class Head>
void payload_fields(Io& io, const Head& head, const ProgressiveMesh& mesh,
                    const PacketStart& start = {}) {
  head_fields(io, head);
  growth_fields(io, head, mesh);
  array_fields(io, head, mesh, start);
}

template <class Head>
std::uint64_t payload_bytes(const Head& head, const ProgressiveMesh& mesh) {
  return size_of_fields([&](SizeIo& io) { payload_fields(io, head, mesh); });
}

}  // namespace pstrips::inline formats::plain
