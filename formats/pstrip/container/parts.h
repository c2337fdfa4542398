#pragma once

#include <cstdint>
#include <vector>

#include "core/bytes.h"
#include "core/limits.h"
#include "formats/pstrip/container/chunk_table.h"

namespace pstrips::inline formats {

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
