#include "formats/pstrip/container/chunks.h"

#include <algorithm>
#include <cstring>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/container/crc.h"

namespace pstrips::inline formats {

bool is_chunk_type(const ChunkType& type) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  return std::ranges::all_of(type, is_letter) && (type[2] & 0x20) == 0;
}

bool is_known(const ChunkType& type) { return find_kind(type) != nullptr; }

std::uint32_t chunk_crc(ByteView bytes) { return crc32_of(bytes); }

Fault ChunkHead::fault() const {
  if (is_chunk_type(type))
    return payload_bytes > kMaxPayloadBytes ? Fault::chunk_length : Fault::none;
  ChunkType upper = type;
  upper[2] = static_cast<char>(upper[2] & ~0x20);
  return is_chunk_type(upper) ? Fault::type_third_letter : Fault::type_not_letters;
}

ChunkHead read_chunk_head(ByteView bytes) {
  ByteReader in(bytes);
  ChunkHead head;
  for (char& c : head.type) c = static_cast<char>(in.u8());
  head.payload_bytes = in.u32();
  return head;
}

Chunk read_chunk(ByteView bytes, std::uint64_t number, std::uint64_t offset) {
  const ChunkHead head = read_chunk_head(bytes);
  Chunk chunk{.type = head.type, .number = number, .offset = offset, .payload = {}};
  chunk.payload = bytes.subspan(kChunkHeaderBytes, head.payload_bytes);
  const ByteView covered = bytes.first(static_cast<std::size_t>(head.chunk_bytes()) - 4);
  chunk.padding_is_zero =
      std::ranges::all_of(covered.subspan(kChunkHeaderBytes + head.payload_bytes),
                          [](std::byte b) { return b == std::byte{0}; });
  std::memcpy(&chunk.stored_crc, covered.data() + covered.size(), 4);
  chunk.computed_crc = chunk_crc(covered);
  return chunk;
}

bool starts_with_signature(ByteView file) {
  return std::equal(
      file.begin(),
      file.begin() + static_cast<std::ptrdiff_t>(std::min(file.size(), kSignature.size())),
      kSignature.begin());
}

ChunkList read_chunks(ByteView file) {
  ChunkList list;
  const auto stop = [&](Fault fault) {
    list.error = error_of({fault, {}, {}}, list.end);
    list.error->offset = list.end;
    return list;
  };
  if (!starts_with_signature(file)) return stop(Fault::signature);
  if (file.size() < kSignature.size()) return stop(Fault::truncated);
  list.end = kSignature.size();
  while (list.end < file.size()) {
    const ByteView left = file.subspan(static_cast<std::size_t>(list.end));
    if (left.size() < kChunkHeaderBytes) return stop(Fault::truncated);
    const ChunkHead head = read_chunk_head(left);
    if (head.fault() != Fault::none) return stop(head.fault());
    if (head.chunk_bytes() > left.size()) return stop(Fault::truncated);
    list.chunks.push_back(read_chunk(left, list.chunks.size(), list.end));
    list.end += head.chunk_bytes();
  }
  return list;
}

}  // namespace pstrips::inline formats
