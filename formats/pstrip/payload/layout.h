#pragma once

#include "core/progressive_strips.h"
#include "formats/pstrip/container/header.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/io.h"
#include "formats/pstrip/payload/predicates.h"

// For formats/pstrip and validators: the wire layout of the payloads that all profiles share, once,
// for reading, writing, sizing and listing. [spec/container.md §5, §8, §9]
//
// A `…_fields(io, v)` function names the fields of a payload in file order; what happens to them
// is the business of the Io, see io.h. v is const for all but ReadIo.

namespace pstrips::inline formats::layout {

inline constexpr std::size_t kMinStringBytes = 4;
inline constexpr std::size_t kMinFormatBytes = kMinStringBytes + 4;
inline constexpr std::size_t kMinGroupBytes = kMinStringBytes + 12;
inline constexpr std::size_t kMinNodeBytes = kMinStringBytes + 4 + 16 * 8 + 4;
inline constexpr std::size_t kMinMaterialBytes = kMinStringBytes + 10 * 8 + 8;
inline constexpr std::size_t kMapBytes = 3 * 4 + 6 * 8;
inline constexpr std::size_t kMinImageBytes = 3 * kMinStringBytes + 4;

// ---- PSHD --------------------------------------------------------------------------------

template <class Io, class H>
void header_fields(Io& io, H& h) {
  io.number(h.version_major);
  io.number(h.version_minor);
  io.number(h.profile);
  io.number(h.conformance);
  io.number(h.flags);
  io.number(h.meshes);
  io.number(h.packets);
  io.number(h.vertices);
  io.number(h.wedges);
  io.number(h.triangles);
  io.number(h.strips);
  io.number(h.map_entries);
  io.number(h.faces);
  io.number(h.decoder_memory);
  io.number(h.vsplits);
  io.number(h.base_end);
  io.number(h.file_bytes);
}
// ---- MESH ----------------------------------------------------------------------------------

struct MeshCounts {
  Index vertices = 0, wedges = 0, triangles = 0, strips = 0, map_entries = 0, vsplits = 0;
  Index faces = 0, base_vertices = 0, base_wedges = 0;
};

/// What MESH says of a mesh in memory.
inline MeshCounts counts_of(const ProgressiveMesh& mesh) {
  return {mesh.vertices,
          mesh.wedges,
          mesh.triangles,
          mesh.strips,
          static_cast<Index>(std::min<std::uint64_t>(full_map_entries(mesh), kNone)),
          static_cast<Index>(mesh.vsplits.size()),
          face_count(mesh),
          mesh.base_vertices,
          mesh.base_wedges};
}

/// The totals of PSHD that are sums over the meshes.
struct Total {
  const char* name;
  std::uint64_t FileHeader::*total;
  Index MeshCounts::*count;
  std::uint64_t byte;  ///< in the payload of PSHD
};
inline constexpr Total kTotals[] = {
    {"vertices", &FileHeader::vertices, &MeshCounts::vertices, 16},
    {"wedges", &FileHeader::wedges, &MeshCounts::wedges, 24},
    {"triangles", &FileHeader::triangles, &MeshCounts::triangles, 32},
    {"strips", &FileHeader::strips, &MeshCounts::strips, 40},
    {"map_entries", &FileHeader::map_entries, &MeshCounts::map_entries, 48},
    {"faces", &FileHeader::faces, &MeshCounts::faces, 56},
    {"vsplits", &FileHeader::vsplits, &MeshCounts::vsplits, 72},
};

inline std::uint64_t sum_of(const Total& total, std::span<const MeshCounts> meshes) {
  std::uint64_t sum = 0;
  for (const MeshCounts& mesh : meshes) sum += mesh.*total.count;
  return sum;
}

template <class Io, class A>
void format_fields(Io& io, A& a) {
  io.string(a.semantic);
  io.choice(a.type, 8, Fault::type_undefined);
  io.number(a.count);
  io.choice(a.normalized, 2);
  io.zeros(1);
}

/// What the plain profile has no use for.
template <class Io, class M>
void compact_fields(Io& io, M& mesh) {
  io.number(mesh.grid.step);
  io.choice(mesh.grid.exact, 2);
  io.choice(mesh.effort, 2);
  io.zeros(2);
  for (auto& x : mesh.grid.origin) io.number(x);
}

template <class Io, class M, class C>
void mesh_fields(Io& io, M& mesh, C& counts, Profile profile) {
  io.string(mesh.name);
  io.choice(mesh.encoding, 3);
  io.choice(mesh.placement, 2);
  io.choice(mesh.single_wedges, 2);
  io.zeros(1);
  format_fields(io, mesh.position);
  for (auto& a : io.list(mesh.wedge_attributes, kMinFormatBytes)) format_fields(io, a);
  for (auto& a : io.list(mesh.face_attribute_formats, kMinFormatBytes)) format_fields(io, a);
  auto& groups = io.list(mesh.groups, kMinGroupBytes);
  if constexpr (Io::kReads) mesh.group_entries.resize(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    io.string(groups[i].name);
    io.number(groups[i].material);
    io.choice(groups[i].kind, 3);
    io.zeros(3);
    io.number(mesh.group_entries[i]);
  }
  io.number(counts.vertices);
  io.number(counts.wedges);
  io.number(counts.triangles);
  io.number(counts.strips);
  io.number(counts.map_entries);
  io.number(counts.vsplits);
  io.number(counts.faces);
  io.number(counts.base_vertices);
  io.number(counts.base_wedges);
  if (profile != Profile::plain) compact_fields(io, mesh);
}

// ---- sCNE, mTRL, iMGE, fRGN ----------------------------------------------------------------

template <class Io, class S>
void scene_fields(Io& io, S& strips) {
  io.string(strips.generator);
  io.choice(strips.scene.texture_origin, 2);
  io.zeros(3);
  for (auto& node : io.list(strips.scene.nodes, kMinNodeBytes)) {
    io.string(node.name);
    io.number(node.parent);
    for (auto& x : node.matrix) io.number(x);
    for (auto& mesh : io.list(node.meshes, sizeof(Index))) io.number(mesh);
  }
}

template <class Io, class M>
void map_fields(Io& io, M& map) {
  io.choice(map.role, 8);
  io.zeros(3);
  io.number(map.image);
  io.number(map.texcoord);
  io.number(map.strength);
  for (auto& x : map.offset) io.number(x);
  for (auto& x : map.scale) io.number(x);
  io.number(map.rotation);
}

/// embedded  one flag an image: an iMGE chunk brings its data
template <class Io, class S, class E>
void material_fields(Io& io, S& scene, E& embedded) {
  for (auto& m : io.list(scene.materials, kMinMaterialBytes)) {
    io.string(m.name);
    for (auto& x : m.base_color) io.number(x);
    for (auto& x : m.emissive) io.number(x);
    io.number(m.metallic);
    io.number(m.roughness);
    io.number(m.alpha_cutoff);
    io.choice(m.alpha_mode, 3);
    io.choice(m.double_sided, 2);
    io.zeros(2);
    for (auto& map : io.list(m.maps, kMapBytes)) map_fields(io, map);
  }
  auto& images = io.list(scene.images, kMinImageBytes);
  if constexpr (Io::kReads) embedded.resize(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    io.string(images[i].name);
    io.string(images[i].uri);
    io.string(images[i].mime_type);
    io.choice(embedded[i], 2);
    io.zeros(3);
  }
}

template <class Io, class N, class D>
void image_fields(Io& io, N& image, D& data) {
  io.number(image);
  io.rest(data);
}

template <class Io, class F>
void foreign_fields(Io& io, F& foreign) {
  io.string(foreign.key);
  io.rest(foreign.data);
}

}  // namespace pstrips::inline formats::layout
