#pragma once

#include <span>

#include "formats/pstrip/payload/geometry.h"
#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline formats {

// What PSHD, PIDX, BASE and PCKT have to say alike, and the records of a packet. A function that
// returns a Fault returns none when all is well. [spec/container.md §5 to §7]

/// Totals of PSHD.
Fault fault_of_totals(const FileHeader& header, std::span<const layout::MeshCounts> meshes);

/// Rows of PIDX by themselves and against what came before them.
///
/// chunk  the PIDX
Fault fault_of_rows(std::span<const IndexRow> rows, const FileHeader& header, const Chunk& chunk,
                    const GeometryCodec& codec);

/// What a BASE says of itself against its MESH.
Fault fault_of_base_head(const BaseHead& head, const ProgressiveMesh& mesh,
                         const layout::MeshCounts& counts);

/// The row of a BASE, null when there is none.
Fault fault_of_base_row(const IndexRow* row, const Chunk& chunk, bool is_last,
                        std::uint64_t base_end);

/// The row of a PCKT and its head.
///
/// start  what the mesh has before it
Fault fault_of_packet_row(const IndexRow* row, const Chunk& chunk, const PacketHead& head,
                          const ProgressiveMesh& mesh, const PacketStart& start);

/// Completes the records from `start` on, whose columns are there, and compares their sums with the
/// head of their packet.
Fault complete_records(ProgressiveMesh& mesh, const PacketHead& head, const PacketStart& start);

/// Whether the packets have brought every vertex, wedge and triangle of every mesh.
Fault fault_of_ends(std::span<const PacketStart> reached, std::span<const ProgressiveMesh> meshes);

/// Whether each format of a mesh has components.
bool check_components(const ProgressiveMesh& mesh, Index index, FaultSink& faults);

/// What chunks behind the packets should have brought.
///
/// embedded  one flag an image
Fault fault_of_end(const ProgressiveStrips& strips, std::span<const layout::MeshCounts> counts,
                   std::span<const std::uint8_t> embedded);

/// Takes back what a BASE brought.
void clear_base(ProgressiveMesh& mesh);
/// Takes back what a packet brought that starts at `to`.
void cut_back(ProgressiveMesh& mesh, const PacketStart& to);

}  // namespace pstrips::inline formats
