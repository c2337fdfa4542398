#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/bytes.h"
#include "core/fault_list.h"
#include "core/result.h"

namespace pstrips::inline formats {

// The frame of the binary variant: a signature, then chunks. [spec/container.md §1, §2]

inline constexpr std::array<std::byte, 8> kSignature = {
    std::byte{0x8a}, std::byte{'P'},  std::byte{'S'},  std::byte{'T'},
    std::byte{0x0d}, std::byte{0x0a}, std::byte{0x1a}, std::byte{0x0a}};

/// Whether the bytes, as far as they are there, are those of the signature.
bool starts_with_signature(ByteView file);

using ChunkType = std::array<char, 4>;

constexpr ChunkType chunk_type(const char (&name)[5]) {
  return {name[0], name[1], name[2], name[3]};
}
inline std::string_view name_of(const ChunkType& type) { return {type.data(), type.size()}; }

/// Four ASCII letters, the third one upper case.
bool is_chunk_type(const ChunkType& type);
/// A reader that does not know the type must refuse the file. Bit 5 of the first letter, as PNG.
constexpr bool is_critical(const ChunkType& type) { return (type[0] & 0x20) == 0; }
constexpr bool is_private(const ChunkType& type) { return (type[1] & 0x20) != 0; }
/// The chunk stays true when other chunks of the file change.
constexpr bool is_safe_to_copy(const ChunkType& type) { return (type[3] & 0x20) != 0; }
/// It is one of chunk_table.h.
bool is_known(const ChunkType& type);

inline constexpr std::uint64_t kChunkAlignment = 8;
inline constexpr std::uint64_t kChunkHeaderBytes = 8;  ///< type and length
inline constexpr std::uint64_t kMaxPayloadBytes = 0x7fff'ffff;

/// Bytes of a whole chunk, type to CRC, with `payload` bytes of payload.
constexpr std::uint64_t chunk_bytes(std::uint64_t payload) {
  return (kChunkHeaderBytes + payload + 4 + kChunkAlignment - 1) / kChunkAlignment *
         kChunkAlignment;
}

/// What stands in front of a payload.
struct ChunkHead {
  ChunkType type{};
  std::uint32_t payload_bytes = 0;

  std::uint64_t chunk_bytes() const { return formats::chunk_bytes(payload_bytes); }
  /// What is wrong with it, whatever stands around it; none: nothing.
  Fault fault() const;
};

/// Precondition: there are kChunkHeaderBytes of them.
ChunkHead read_chunk_head(ByteView bytes);

/// One whole chunk of a file in memory.
struct Chunk {
  ChunkType type{};
  std::uint64_t number = 0;  ///< of the chunk in the file
  std::uint64_t offset = 0;  ///< of the type, from the start of the file
  ByteView payload;          ///< into the file
  std::uint32_t stored_crc = 0;
  std::uint32_t computed_crc = 0;
  bool padding_is_zero = true;

  bool crc_ok() const { return stored_crc == computed_crc; }
  std::uint64_t bytes() const { return chunk_bytes(payload.size()); }
  std::uint64_t payload_offset() const { return offset + kChunkHeaderBytes; }
};

/// The chunk at the front of `bytes`, which is whole there. Whether its CRC and padding are right
/// is left to the caller.
Chunk read_chunk(ByteView bytes, std::uint64_t number, std::uint64_t offset);

/// Chunks up to where the frame breaks. A wrong CRC or padding does not break it.
struct ChunkList {
  std::vector<Chunk> chunks;
  std::uint64_t end = 0;       ///< where the listing stopped, from the start of the file
  std::optional<Error> error;  ///< truncated or corrupt; none: the file ends with a whole chunk
};

/// Splits a file into chunks, as far as that goes; looks at the frame alone, not at payloads.
///
/// cost  O(file), one CRC over each chunk
ChunkList read_chunks(ByteView file);

/// The CRC-32 of PNG and zlib over the type, length, payload and padding of a chunk.
std::uint32_t chunk_crc(ByteView bytes);

}  // namespace pstrips::inline formats
