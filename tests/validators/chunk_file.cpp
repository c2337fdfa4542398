#include "tests/validators/chunk_file.h"

#include <algorithm>
#include <cassert>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/layout.h"

namespace pstrips::test {

ChunkFile::ChunkFile(ByteView file) {
  const ChunkList list = read_chunks(file);
  assert(!list.error);
  for (const Chunk& chunk : list.chunks) {
    if (chunk.type == kBaseChunk || chunk.type == kPacketChunk)
      largest_ = std::max(largest_, chunk.bytes());
    items_.push_back({chunk.type, Bytes(chunk.payload.begin(), chunk.payload.end())});
  }
}

std::size_t ChunkFile::find(std::string_view type, std::size_t n) const {
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (name_of(items_[i].type) == type && n-- == 0) return i;
  assert(false && "no such chunk");
  return items_.size();
}

ChunkFile& ChunkFile::settle() {
  std::uint64_t offset = kSignature.size(), base_end = 0, largest = 0;
  std::size_t row = 0;
  const std::size_t rows = get<std::uint32_t>("PIDX", 0);
  for (const Item& item : items_) {
    const std::uint64_t bytes = chunk_bytes(item.payload.size());
    const bool geometry = item.type == kBaseChunk || item.type == kPacketChunk;
    if (geometry && row < rows) {
      const std::size_t at = 8 + layout::kIndexRowBytes * row++;
      put("PIDX", at, offset);
      put("PIDX", at + 8, static_cast<std::uint32_t>(bytes));
    }
    offset += bytes;
    if (geometry) largest = std::max(largest, bytes);
    if (item.type == kBaseChunk || item.type == kIndexChunk) base_end = offset;
  }
  // The formula counts the largest chunk once; the rest of it stays.
  put("PSHD", 64, get<std::uint64_t>("PSHD", 64) - largest_ + largest);
  largest_ = largest;
  put("PSHD", 80, base_end);
  put("PSHD", 88, offset);
  return *this;
}

Bytes ChunkFile::bytes() const {
  ByteWriter out;
  out.bytes(kSignature);
  for (const Item& item : items_) {
    const std::size_t start = out.size();
    for (const char c : item.type) out.u8(static_cast<std::uint8_t>(c));
    out.u32(static_cast<std::uint32_t>(item.payload.size()));
    out.bytes(item.payload);
    while ((out.size() - start + 4) % kChunkAlignment != 0) out.u8(0);
    out.u32(chunk_crc(out.view().subspan(start)));
  }
  return std::move(out).take();
}

}  // namespace pstrips::test
