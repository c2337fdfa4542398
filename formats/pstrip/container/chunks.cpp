#include "formats/pstrip/container/chunks.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace pstrips::inline formats {
namespace {

constexpr ChunkType kKnown[] = {kHeaderChunk, kSceneChunk,  kMaterialsChunk, kMeshChunk,
                                kIndexChunk,  kBaseChunk,   kPacketChunk,    kFacesChunk,
                                kOrderChunk,  kDigestChunk, kImageChunk,     kForeignChunk,
                                kEndChunk};

}  // namespace

bool is_chunk_type(const ChunkType& type) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  return std::ranges::all_of(type, is_letter) && (type[2] & 0x20) == 0;
}

bool is_known(const ChunkType& type) { return std::ranges::find(kKnown, type) != std::end(kKnown); }

std::uint32_t chunk_crc(ByteView bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

ChunkList read_chunks(ByteView file) {
  ChunkList list;
  const auto stop = [&](ErrorCode code, const char* message) {
    list.error = Error{code, message, list.end};
    return list;
  };
  const std::size_t present = std::min(file.size(), kSignature.size());
  if (!std::equal(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(present),
                  kSignature.begin()))
    return stop(ErrorCode::corrupt, "signature is not that of a progressive-strips file");
  if (present < kSignature.size()) return stop(ErrorCode::truncated, "ends inside the signature");

  list.end = kSignature.size();
  while (list.end < file.size()) {
    const ByteView left = file.subspan(list.end);
    ByteReader head(left, list.end);
    Chunk chunk{.offset = list.end, .payload = {}};
    for (char& c : chunk.type) c = static_cast<char>(head.u8());
    const std::uint32_t length = head.u32();
    if (head.error()) return stop(ErrorCode::truncated, "ends inside a chunk header");
    if (!is_chunk_type(chunk.type))
      return stop(ErrorCode::corrupt, "chunk type is not four letters");
    if (length > kMaxPayloadBytes) return stop(ErrorCode::corrupt, "chunk length exceeds 2^31 - 1");
    const std::uint64_t bytes = chunk_bytes(length);
    if (bytes > left.size()) return stop(ErrorCode::truncated, "ends inside a chunk");
    chunk.payload = head.take(length);
    const ByteView covered = left.first(static_cast<std::size_t>(bytes) - 4);
    chunk.padding_is_zero = std::ranges::all_of(covered.subspan(kChunkHeaderBytes + length),
                                                [](std::byte b) { return b == std::byte{0}; });
    std::memcpy(&chunk.stored_crc, covered.data() + covered.size(), 4);
    chunk.computed_crc = chunk_crc(covered);
    list.chunks.push_back(chunk);
    list.end += bytes;
  }
  return list;
}

}  // namespace pstrips::inline formats
