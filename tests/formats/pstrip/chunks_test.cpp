#include "formats/pstrip/container/chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/parts.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

Bytes small_file() {
  return write_binary(
             test::random_progressive(9, {.single_wedges = false, .scene = true, .unknown = true}))
      .value();
}

TEST(Chunks, TypesSayWhatTheyAre) {
  EXPECT_TRUE(is_chunk_type(kPacketChunk));
  EXPECT_FALSE(is_chunk_type(chunk_type("PC1T")));
  EXPECT_FALSE(is_chunk_type(chunk_type("PCkT"))) << "the third letter is reserved";
  EXPECT_TRUE(is_critical(kPacketChunk));
  EXPECT_FALSE(is_critical(kOrderChunk));
  EXPECT_FALSE(is_private(kOrderChunk));
  EXPECT_TRUE(is_private(chunk_type("abCd")));
  EXPECT_TRUE(is_safe_to_copy(chunk_type("abCd")));
  EXPECT_FALSE(is_safe_to_copy(kOrderChunk));
  EXPECT_TRUE(is_known(kEndChunk));
  EXPECT_FALSE(is_known(chunk_type("abCd")));
}

TEST(Chunks, CrcIsThatOfPng) {
  EXPECT_EQ(chunk_crc(as_bytes("123456789")), 0xcbf4'3926u);
  EXPECT_EQ(chunk_crc(as_bytes("IEND")), 0xae42'6082u);
}

TEST(Chunks, ListCoversTheFile) {
  const Bytes file = small_file();
  const ChunkList list = read_chunks(file);
  EXPECT_FALSE(list.error);
  EXPECT_EQ(list.end, file.size());
  std::uint64_t at = kSignature.size();
  for (const Chunk& chunk : list.chunks) {
    EXPECT_EQ(chunk.offset, at);
    EXPECT_EQ(chunk.offset % 8, 0u);
    EXPECT_TRUE(chunk.crc_ok());
    EXPECT_TRUE(chunk.padding_is_zero);
    at += chunk.bytes();
  }
  EXPECT_EQ(at, file.size());
}

TEST(Chunks, ListStopsWhereTheFrameBreaks) {
  const Bytes file = small_file();
  const std::uint64_t third = read_chunks(file).chunks[2].offset;
  const struct {
    const char* name;
    std::size_t at;
    std::byte value;
    ErrorCode code;
    std::size_t chunks;
    std::uint64_t offset;
  } kRows[] = {
      {"signature", 3, std::byte{'G'}, ErrorCode::corrupt, 0, 0},
      {"type", third, std::byte{'1'}, ErrorCode::corrupt, 2, third},
      {"reserved_bit", third + 2, std::byte{'x'}, ErrorCode::corrupt, 2, third},
      {"length_over_2_31", third + 7, std::byte{0x80}, ErrorCode::corrupt, 2, third},
      {"length_past_the_end", third + 7, std::byte{0x7f}, ErrorCode::truncated, 2, third},
  };
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.name);
    Bytes bad = file;
    bad[row.at] = row.value;
    const ChunkList list = read_chunks(bad);
    ASSERT_TRUE(list.error);
    EXPECT_EQ(list.error->code, row.code);
    EXPECT_EQ(list.error->offset, row.offset);
    EXPECT_EQ(list.end, row.offset);
    EXPECT_EQ(list.chunks.size(), row.chunks);
  }
}

TEST(Chunks, WrongCrcAndPaddingAreReportedNotFollowed) {
  Bytes file = small_file();
  const ChunkList good = read_chunks(file);
  const auto padded = std::ranges::find_if(
      good.chunks, [](const Chunk& chunk) { return chunk.bytes() > chunk.payload.size() + 12; });
  ASSERT_NE(padded, good.chunks.end());
  file[padded->payload_offset() + padded->payload.size()] = std::byte{1};
  const ChunkList list = read_chunks(file);
  EXPECT_FALSE(list.error);
  ASSERT_EQ(list.chunks.size(), good.chunks.size());
  const Chunk& chunk = list.chunks[static_cast<std::size_t>(padded - good.chunks.begin())];
  EXPECT_FALSE(chunk.padding_is_zero);
  EXPECT_FALSE(chunk.crc_ok());
}

TEST(Parts, CoverEveryByteOnce) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Bytes file = write_binary(test::random_progressive_of_any_kind(seed)).value();
    std::uint64_t at = 0;
    for (const PartSpan& span : list_parts(read_chunks(file))) {
      EXPECT_EQ(span.offset, at);
      at += span.bytes;
    }
    EXPECT_EQ(at, file.size());
  }
}

TEST(Parts, CountWhatTheArraysTake) {
  const ProgressiveStrips strips = test::random_progressive(
      4, {.base_vertices = 6, .vsplits = 8, .packet_vsplits = 8, .single_wedges = false});
  const ProgressiveMesh& mesh = strips.meshes[0];
  std::map<Part, std::uint64_t> bytes;
  for (const PartSpan& span : list_parts(read_chunks(write_binary(strips).value())))
    bytes[span.part] += span.bytes;
  const auto padded = [](std::size_t n) { return (n + 7) / 8 * 8; };
  EXPECT_EQ(bytes[Part::base_positions], padded(6 * mesh.position.element_bytes()));
  EXPECT_EQ(bytes[Part::base_map], padded(4 * mesh.base_map.size()));
  EXPECT_EQ(bytes[Part::parents], padded(4 * 8));
  EXPECT_EQ(bytes[Part::positions], padded(8 * mesh.position.element_bytes()));
  EXPECT_EQ(bytes[Part::map_offsets], padded(4 * mesh.map_offsets.size()));
  EXPECT_EQ(bytes[Part::reassigned], padded(4 * mesh.reassigned.size()));
  // Of one mesh and a map of strips: size, vsplits, surplus, strips, error and what it is less.
  const std::uint64_t rows = bytes[Part::packet_index];
  EXPECT_GE(rows, 2u * 9 + 1);
  EXPECT_LE(rows, 2u * 16);
}

TEST(Parts, ListBrokenFilesToo) {
  const Bytes file = small_file();
  for (std::size_t at = 8; at < file.size(); ++at) {
    Bytes bad = file;
    bad[at] ^= std::byte{0x41};
    const ChunkList list = read_chunks(bad);
    std::uint64_t end = 0;
    for (const PartSpan& span : list_parts(list)) {
      EXPECT_EQ(span.offset, end);
      end += span.bytes;
    }
    EXPECT_EQ(end, list.end) << at;
  }
}

}  // namespace
}  // namespace pstrips
