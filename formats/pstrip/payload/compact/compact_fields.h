#pragma once

#include <cstdint>

#include "formats/pstrip/payload/compact/base_code.h"
#include "formats/pstrip/payload/compact/mesh_state.h"
#include "formats/pstrip/payload/io.h"

// For formats/pstrip/payload/compact: what stands before the run of codes in a BASE and a PCKT.
// [spec/compact.md §4]

namespace pstrips::inline formats {

inline void put_varint(Bytes& out, std::uint64_t number) {
  layout::put_varint(number, [&](std::byte b) { out.push_back(b); });
}

/// A number of at most `bits` bits, in its shortest form.
inline std::uint64_t take_varint(layout::ReadIo& io, unsigned bits) {
  std::uint64_t number = 0;
  io.varint(number, bits, Fault::compact_number);
  return number;
}

inline Index take_index(layout::ReadIo& io) { return static_cast<Index>(take_varint(io, 32)); }

/// What a PCKT holds.
enum class PacketKind : std::uint8_t {
  batch,     ///< splits of a batch
  isolated,  ///< vertices without a parent
};

/// How the numbers of an attribute lie in cells: one number for both.
constexpr std::uint64_t packed_cells(int exponent, bool exact) {
  const auto zigzag = static_cast<std::uint64_t>(exponent < 0 ? -2 * exponent - 1 : 2 * exponent);
  return zigzag << 1 | (exact ? 1u : 0u);
}
constexpr int exponent_of_packed(std::uint64_t packed) {
  const auto zigzag = static_cast<int>(packed >> 1);
  return (zigzag & 1) != 0 ? -(zigzag + 1) / 2 : zigzag / 2;
}

inline constexpr unsigned kPackedCellsBits = 14;
/// What is added to the bits of an octahedron, so that it is told from an exponent.
inline constexpr std::uint64_t kPackedOctahedron = 1u << 13;

inline std::uint64_t packed(const AttributeCells& cells) {
  if (cells.octahedron()) return kPackedOctahedron + cells.octahedron()->bits();
  return packed_cells(cells.own().exponent(), cells.own().exact());
}
/// Nothing if the attribute has no such cells.
inline std::optional<AttributeCells> unpacked(std::uint64_t packed, const Attribute& format) {
  if (packed >= kPackedOctahedron) {
    const std::uint64_t bits = packed - kPackedOctahedron;
    if (!AttributeCells::can_be_directions(format) || bits < Octahedron::kMinBits ||
        bits > Octahedron::kMaxBits)
      return std::nullopt;
    return AttributeCells(Octahedron(static_cast<unsigned>(bits)), format.count);
  }
  const int exponent = exponent_of_packed(packed);
  if (!Cells::is_valid(format.type, exponent)) return std::nullopt;
  return AttributeCells(Cells(format.type, exponent, (packed & 1) != 0), format.count);
}

/// As many as a mesh may have, so that what is learned of each stays small.
inline constexpr unsigned kMaxComponents = 1024;

inline unsigned components_of(const ProgressiveMesh& mesh) {
  unsigned components = 0;
  for (const Attribute& a : mesh.wedge_attributes) components += a.count;
  return components;
}

/// What both sides know of a base before it.
inline BaseCounts base_counts_of(const ProgressiveMesh& mesh, const MeshCells& cells,
                                 Index map_entries) {
  return {mesh.base_vertices, mesh.base_wedges,
          map_entries / 3,    static_cast<Index>(mesh.groups.size()),
          columns_of(cells),  mesh.single_wedges};
}

/// Whether packets of this size are worth the pass over the mesh that each of them costs: a decoder
/// need not take more.
///
/// vertices  visited by the packets so far
constexpr bool is_too_much_work(std::uint64_t vertices, Index of_mesh) {
  constexpr std::uint64_t kPerVertex = 256, kFree = 1u << 20;
  return vertices > kPerVertex * of_mesh + kFree;
}

}  // namespace pstrips::inline formats
