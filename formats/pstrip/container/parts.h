#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/bytes.h"
#include "core/limits.h"
#include "formats/pstrip/container/chunks.h"

namespace pstrips::inline formats {

/// What the bytes of a file are spent on.
enum class Part : std::uint8_t {
  container,       ///< signature, chunk headers, padding, CRC, heads of payloads, PSHD, PEND
  mesh_header,     ///< MESH
  packet_index,    ///< PIDX
  base_positions,  ///< positions of the base vertices
  base_wedges,     ///< wedge lists and attributes of the base wedges
  base_map,        ///< the index map
  parents,         ///< which vertex each vsplit splits
  counts,          ///< wedges, reassigned wedges and map offsets of each record
  positions,       ///< of the new vertices
  parent_positions,
  wedges,       ///< attributes of the new wedges
  reassigned,   ///< wedges taken over
  map_offsets,  ///< index-map offsets
  faces,        ///< fACE
  order,        ///< oRDP
  digest,       ///< dGST
  scene,        ///< sCNE, mTRL
  images,       ///< iMGE
  foreign,      ///< fRGN
  unknown,      ///< chunks that this build does not know
};
std::string_view name_of(Part part);

/// A run of bytes of one part.
struct PartSpan {
  Part part = Part::container;
  std::uint32_t chunk = 0;   ///< index into the chunk list; the signature belongs to chunk 0
  std::uint64_t offset = 0;  ///< from the start of the file
  std::uint64_t bytes = 0;
  friend bool operator==(const PartSpan&, const PartSpan&) = default;
};

/// Splits the whole chunks of a file into parts: spans in file order without gaps or overlaps. A
/// chunk whose payload does not fit its own counts is `container` as a whole, so that broken
/// files can be listed too.
///
/// chunks  from read_chunks of the same file
std::vector<PartSpan> list_parts(const ChunkList& chunks, const Limits& limits = {});

}  // namespace pstrips::inline formats
