// The frame of the binary variant: table and order of the chunks, CRC, parser.

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <set>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/container_parser.h"
#include "formats/pstrip/container/crc.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

TEST(ChunkTable, HasEachTypeOnce) {
  std::set<ChunkType> types;
  for (const ChunkKind& kind : kChunkKinds) {
    EXPECT_TRUE(is_chunk_type(kind.type));
    EXPECT_FALSE(is_private(kind.type));
    EXPECT_TRUE(types.insert(kind.type).second) << name_of(kind.type);
    EXPECT_EQ(find_kind(kind.type), &kind);
  }
  EXPECT_EQ(find_kind(chunk_type("abCd")), nullptr);
  EXPECT_EQ(part_of(chunk_type("abCd")), Part::unknown);
}

TEST(Parts, AreInTheOrderOfTheEnumeration) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < std::size(kParts); ++i) {
    EXPECT_EQ(kParts[i].part, static_cast<Part>(i));
    EXPECT_TRUE(names.insert(kParts[i].name).second);
  }
  EXPECT_EQ(kParts[std::size(kParts) - 1].part, Part::unknown);
}

struct Sequence {
  const char* name;
  std::vector<const char*> types;  ///< the last one is judged
  Fault fault;
};

TEST(ChunkOrder, SaysWhichChunkMayNotStandWhereItStands) {
  const Sequence kRows[] = {
      {"header_first", {"MESH"}, Fault::first_chunk},
      {"unknown_first", {"noTe"}, Fault::first_chunk},
      {"header_twice", {"PSHD", "PSHD"}, Fault::chunk_twice},
      {"scene_twice", {"PSHD", "sCNE", "mTRL", "sCNE"}, Fault::chunk_twice},
      {"nodes_after_materials", {"PSHD", "mTRL", "sCNE"}, Fault::chunk_order},
      {"unknown_anywhere", {"PSHD", "noTe"}, Fault::none},
      {"base_without_index", {"PSHD", "MESH", "MESH", "BASE"}, Fault::index_missing},
      {"a_mesh_missing", {"PSHD", "MESH", "PIDX"}, Fault::mesh_chunks},
      {"a_mesh_too_many", {"PSHD", "MESH", "MESH", "MESH"}, Fault::mesh_chunks},
      {"a_base_missing", {"PSHD", "MESH", "MESH", "PIDX", "BASE", "PCKT"}, Fault::base_chunks},
      {"a_base_too_many",
       {"PSHD", "MESH", "MESH", "PIDX", "BASE", "BASE", "BASE"},
       Fault::base_chunks},
      {"no_packet", {"PSHD", "MESH", "MESH", "PIDX", "BASE", "BASE", "PEND"}, Fault::packet_chunks},
      {"a_packet_too_many",
       {"PSHD", "MESH", "MESH", "PIDX", "BASE", "BASE", "PCKT", "PCKT"},
       Fault::packet_chunks},
      {"whole",
       {"PSHD", "MESH", "MESH", "PIDX", "BASE", "BASE", "PCKT", "dGST", "fACE", "iMGE", "PEND"},
       Fault::none},
      {"faces_after_images",
       {"PSHD", "MESH", "MESH", "PIDX", "BASE", "BASE", "PCKT", "iMGE", "fACE"},
       Fault::chunk_order},
  };
  for (const Sequence& row : kRows) {
    SCOPED_TRACE(row.name);
    ChunkOrder order;
    for (std::size_t i = 0; i < row.types.size(); ++i) {
      ChunkType type{};
      std::copy_n(row.types[i], type.size(), type.begin());
      const Fault fault = order.add(type).fault;
      EXPECT_EQ(fault, i + 1 < row.types.size() ? Fault::none : row.fault) << i;
      if (i == 0) order.declare(2, 1);
    }
  }
}

TEST(Crc, OfTablesIsThatOfZlib) {
  std::mt19937 random(3);
  Bytes bytes(300);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  for (std::size_t first = 0; first < 9; ++first)
    for (std::size_t size = 0; size + first <= bytes.size(); ++size) {
      const ByteView part = ByteView(bytes).subspan(first, size);
      const auto expected = static_cast<std::uint32_t>(
          ::crc32(0, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(size)));
      ASSERT_EQ(crc32_by_tables(part), expected) << size;
      ASSERT_EQ(crc32_of(part), expected) << size;
    }
}

/// Goes on whatever happens, and keeps what it was brought.
class Recorder final : public ChunkSink {
 public:
  bool report(Fault fault, const Where&, std::string) override {
    faults.push_back(fault);
    return true;
  }
  bool take(const Chunk& chunk) override {
    types.emplace_back(name_of(chunk.type));
    offsets.push_back(chunk.offset);
    return true;
  }
  std::vector<Fault> faults;
  std::vector<std::string> types;
  std::vector<std::uint64_t> offsets;
};

TEST(ContainerParser, BringsTheSameChunksHoweverBytesArrive) {
  const Bytes file = write_binary(test::random_progressive(9, {.scene = true})).value();
  const ChunkList list = read_chunks(file);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{64}, file.size()}) {
    ContainerParser parser;
    Recorder sink;
    for (std::size_t at = 0; at < file.size(); at += piece)
      ASSERT_TRUE(parser.feed(ByteView(file).subspan(at, std::min(piece, file.size() - at)), sink));
    EXPECT_TRUE(parser.complete());
    EXPECT_EQ(parser.offset(), file.size());
    EXPECT_EQ(sink.faults, std::vector<Fault>{});
    ASSERT_EQ(sink.types.size(), list.chunks.size());
    for (std::size_t i = 0; i < list.chunks.size(); ++i) {
      EXPECT_EQ(sink.types[i], name_of(list.chunks[i].type));
      EXPECT_EQ(sink.offsets[i], list.chunks[i].offset);
    }
  }
}

TEST(ContainerParser, GoesOnAfterDamageThatLeavesTheFrameSound) {
  const Bytes file = write_binary(test::random_progressive(9, {.scene = true})).value();
  const ChunkList list = read_chunks(file);
  Bytes bad = file;
  bad[list.chunks[1].payload_offset()] ^= std::byte{1};
  bad[list.chunks[3].payload_offset()] ^= std::byte{1};
  ContainerParser parser;
  Recorder sink;
  EXPECT_TRUE(parser.feed(bad, sink));
  EXPECT_EQ(sink.faults, (std::vector<Fault>{Fault::chunk_crc, Fault::chunk_crc}));
  EXPECT_EQ(sink.types.size(), list.chunks.size());
}

}  // namespace
}  // namespace pstrips
