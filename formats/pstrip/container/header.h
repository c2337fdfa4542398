#pragma once

#include <cstdint>
#include <span>

#include "core/progressive_strips.h"

namespace pstrips::inline formats {

/// Of files that this version writes. [spec/container.md §14]
inline constexpr std::uint16_t kVersionMinor = 3;

/// What PSHD says. [spec/container.md §5.1]
struct FileHeader {
  std::uint16_t version_major = 1;
  std::uint16_t version_minor = kVersionMinor;
  std::uint8_t profile = 0;      ///< see Profile
  std::uint8_t conformance = 0;  ///< conformance level, see conformance_level()
  std::uint16_t flags = 0;
  std::uint32_t meshes = 0;
  std::uint32_t packets = 0;
  // At full resolution, all meshes together.
  std::uint64_t vertices = 0, wedges = 0, triangles = 0, strips = 0, map_entries = 0, faces = 0;
  std::uint64_t decoder_memory = 0;  ///< bytes, see decoder_memory()
  std::uint64_t vsplits = 0;
  std::uint64_t base_end = 0;    ///< bytes from the start of the file to the end of the last BASE
  std::uint64_t file_bytes = 0;  ///< of the whole file
  friend bool operator==(const FileHeader&, const FileHeader&) = default;
};

inline constexpr std::uint64_t kHeaderBytes = 96;  ///< of PSHD's payload

/// One row of PIDX: where a BASE or PCKT chunk stands and what its mesh has after it.
/// [spec/container.md §6]
struct IndexRow {
  std::uint64_t offset = 0;  ///< of the chunk, from the start of the file
  std::uint32_t bytes = 0;   ///< of the whole chunk, type to CRC
  std::uint32_t mesh = 0;
  std::uint32_t vsplits = 0;  ///< in the chunk
  std::uint32_t vertices = 0, triangles = 0, strips = 0;
  float error = 0, one_sided_error = 0;
  friend bool operator==(const IndexRow&, const IndexRow&) = default;
};

/// The smallest conformance level that admits these totals. [spec/container.md §12]
std::uint8_t conformance_level(const FileHeader& header);

/// The memory that a streaming decoder needs for these meshes, bytes. [spec/container.md §12]
///
/// meshes              vertices, wedges, map length and attribute formats are used, data is not
/// largest_chunk       bytes of the largest BASE or PCKT chunk
std::uint64_t decoder_memory(std::span<const ProgressiveMesh> meshes, std::uint64_t largest_chunk);

}  // namespace pstrips::inline formats
