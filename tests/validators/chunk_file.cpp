#include "tests/validators/chunk_file.h"

#include <algorithm>
#include <cassert>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/decoder.h"
#include "formats/pstrip/payload/index_rows.h"

namespace pstrips::test {

ChunkFile::ChunkFile(ByteView file) {
  const ChunkList list = read_chunks(file);
  assert(!list.error);
  for (const Chunk& chunk : list.chunks) {
    if (chunk.type == kBaseChunk || chunk.type == kPacketChunk)
      largest_ = std::max(largest_, chunk.bytes());
    items_.push_back({chunk.type, Bytes(chunk.payload.begin(), chunk.payload.end())});
  }
  Faults ignored;
  PayloadDecoder decoder(Limits{}, PayloadChecks::fields, ignored);
  for (const Chunk& chunk : list.chunks)
    if (chunk.type == kBaseChunk || !decoder.decode(chunk)) break;
  meshes_ = std::move(decoder.strips().meshes);
  rows_ = decoder.index();
}

std::size_t ChunkFile::find(std::string_view type, std::size_t n) const {
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (name_of(items_[i].type) == type && n-- == 0) return i;
  assert(false && "no such chunk");
  return items_.size();
}

std::uint64_t ChunkFile::end_of_index() const {
  std::uint64_t offset = kSignature.size();
  for (const Item& item : items_) {
    offset += chunk_bytes(item.payload.size());
    if (item.type == kIndexChunk) break;
  }
  return offset;
}

ChunkFile& ChunkFile::write_rows() {
  const std::uint64_t start = end_of_index();
  const auto fields = [&](auto& io) { layout::index_fields(io, rows_, meshes_, start); };
  Bytes& payload = this->payload("PIDX");
  payload.assign(layout::size_of_fields(fields), std::byte{0});
  layout::WriteIo io(payload);
  fields(io);
  return *this;
}

// The first row keeps its distance from PIDX, which may get another size itself.
void ChunkFile::settle_rows() {
  std::uint64_t offset = kSignature.size(), end = 0;
  std::size_t row = 0;
  for (const Item& item : items_) {
    const std::uint64_t bytes = chunk_bytes(item.payload.size());
    if ((item.type == kBaseChunk || item.type == kPacketChunk) && row < rows_.size()) {
      rows_[row].offset = offset;
      rows_[row++].bytes = static_cast<std::uint32_t>(bytes);
      end = offset + bytes;
    }
    offset += bytes;
  }
  for (; row < rows_.size(); end += rows_[row++].bytes) rows_[row].offset = end;
}

ChunkFile& ChunkFile::settle() {
  settle_rows();
  write_rows().settle_rows();
  std::uint64_t offset = kSignature.size(), base_end = 0, largest = 0;
  for (const Item& item : items_) {
    const std::uint64_t bytes = chunk_bytes(item.payload.size());
    offset += bytes;
    if (item.type == kBaseChunk || item.type == kPacketChunk) largest = std::max(largest, bytes);
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
