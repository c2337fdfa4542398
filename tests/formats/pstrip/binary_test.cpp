#include "formats/pstrip/container/binary.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/layout.h"
#include "tests/support/progressive.h"
#include "tests/validators/chunk_file.h"

namespace pstrips {
namespace {

using test::ProgressiveOptions;
using test::random_progressive;
using test::random_progressive_of_any_kind;

/// A small file with one of everything.
ProgressiveStrips rich_strips() {
  return random_progressive(7, {.meshes = 2,
                                .base_vertices = 4,
                                .vsplits = 5,
                                .encoding = MapEncoding::offset,
                                .placement = Placement::optimal,
                                .single_wedges = false,
                                .scene = true,
                                .faces = true,
                                .order = true,
                                .digest = true,
                                .unknown = true});
}

/// The payload of one chunk, to be changed by a test; `seal` then makes the CRC right again.
std::span<std::byte> payload_of(Bytes& file, const ChunkType& type, std::size_t nth = 0) {
  for (const Chunk& chunk : read_chunks(file).chunks)
    if (chunk.type == type && nth-- == 0)
      return std::span(file).subspan(chunk.payload_offset(), chunk.payload.size());
  ADD_FAILURE() << "no such chunk";
  return {};
}

void seal(Bytes& file) {
  for (const Chunk& chunk : read_chunks(file).chunks) {
    const std::uint32_t crc = chunk.computed_crc;
    std::memcpy(file.data() + chunk.offset + chunk.bytes() - 4, &crc, 4);
  }
}

void put_u32(std::span<std::byte> payload, std::size_t at, std::uint32_t v) {
  std::memcpy(payload.data() + at, &v, 4);
}

/// `file` with `chunk` in front of the nth chunk, offsets and sizes in PSHD and PIDX in line.
Bytes insert_chunk(const Bytes& file, test::ChunkFile::Item chunk, std::size_t nth) {
  test::ChunkFile out(file);
  out.items().insert(out.items().begin() + static_cast<std::ptrdiff_t>(nth), std::move(chunk));
  return out.settle().bytes();
}

TEST(Binary, ReadsWhatItWrote) {
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const ProgressiveStrips strips = random_progressive_of_any_kind(seed);
    const Result<void> holds = check(strips);
    ASSERT_TRUE(holds) << holds.error().message << holds.error().path;
    const Bytes file = write_binary(strips).value();
    const Result<ProgressiveStrips> again = read_binary(file);
    ASSERT_TRUE(again) << again.error().message << " at " << again.error().offset;
    EXPECT_EQ(*again, strips);
    EXPECT_EQ(write_binary(*again).value(), file);
  }
}

TEST(Binary, KeepsFloatsBitForBit) {
  ProgressiveStrips strips = random_progressive(3);
  const std::uint32_t odd[] = {0x7fc0'0001, 0xffa1'2345, 0x8000'0000, 1};
  std::memcpy(strips.meshes[0].position.data.data(), odd, sizeof odd);
  const ProgressiveStrips again = read_binary(write_binary(strips).value()).value();
  EXPECT_EQ(again.meshes[0].position.data, strips.meshes[0].position.data);
}

TEST(Binary, HeaderDeclaresTheFile) {
  const ProgressiveStrips strips = rich_strips();
  const Bytes file = write_binary(strips).value();
  BinaryParser parser;
  ASSERT_TRUE(parser.feed(file));
  const FileHeader& header = parser.header().value();
  EXPECT_EQ(header.meshes, 2u);
  EXPECT_EQ(header.packets, strips.packets.size());
  EXPECT_EQ(header.vertices, 18u);
  EXPECT_EQ(header.vsplits, 10u);
  EXPECT_EQ(header.file_bytes, file.size());
  EXPECT_EQ(header.base_end, parser.index()[1].offset + parser.index()[1].bytes);
  const auto largest = std::ranges::max_element(parser.index(), {}, &IndexRow::bytes);
  EXPECT_EQ(header.decoder_memory, decoder_memory(strips.meshes, largest->bytes));
  EXPECT_EQ(header.conformance, 0);
}

TEST(Binary, LevelIsTheSmallestThatAdmits) {
  const struct {
    FileHeader header;
    int level;
  } kRows[] = {
      {{}, 0},
      {{.vertices = 1u << 16}, 0},
      {{.vertices = (1u << 16) + 1}, 1},
      {{.wedges = (1u << 21) + 1}, 2},
      {{.map_entries = 1u << 27}, 2},
      {{.map_entries = (1u << 27) + 1}, 3},
      {{.decoder_memory = (1ull << 32) + 1}, 3},
  };
  for (const auto& row : kRows) EXPECT_EQ(conformance_level(row.header), row.level);
}

TEST(Binary, ParserTakesBytesInAnyPieces) {
  const Bytes file = write_binary(rich_strips()).value();
  const ProgressiveStrips whole = read_binary(file).value();
  for (const std::size_t piece : {1, 3, 8, 113, 1000}) {
    SCOPED_TRACE(piece);
    BinaryParser parser;
    for (std::size_t at = 0; at < file.size(); at += piece)
      ASSERT_TRUE(parser.feed(ByteView(file).subspan(at, std::min(piece, file.size() - at))));
    EXPECT_TRUE(parser.complete());
    EXPECT_FALSE(parser.end());
    EXPECT_EQ(parser.strips(), whole);
  }
}

TEST(Binary, EveryPrefixIsTruncatedOrItsLastWholePacket) {
  const ProgressiveStrips strips = rich_strips();
  const Bytes file = write_binary(strips).value();
  BinaryParser parser;
  ASSERT_TRUE(parser.feed(file));
  const FileHeader header = *parser.header();
  for (std::size_t size = 0; size < file.size(); ++size) {
    SCOPED_TRACE(size);
    // An exact copy, so that a sanitizer sees an overread.
    const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    const auto whole = read_binary(cut);
    ASSERT_FALSE(whole);
    EXPECT_EQ(whole.error().code, ErrorCode::truncated);
    EXPECT_EQ(whole.error().offset, size);
    const auto prefix = read_binary(cut, {}, ReadMode::prefix);
    ASSERT_EQ(prefix.has_value(), size >= header.base_end);
    if (!prefix) {
      EXPECT_EQ(prefix.error().code, ErrorCode::truncated);
      continue;
    }
    EXPECT_FALSE(prefix->complete);
    std::size_t packets = 0;
    for (std::size_t row = 2; row < parser.index().size(); ++row)
      packets += parser.index()[row].offset + parser.index()[row].bytes <= size;
    ASSERT_EQ(prefix->packets.size(), packets);
    const Result<void> holds = check(*prefix);
    EXPECT_TRUE(holds) << holds.error().message;
    for (std::size_t m = 0; m < 2; ++m) {
      ProgressiveMesh reached = prefix->meshes[m], original = strips.meshes[m];
      reached.faces = original.faces = {};
      const std::size_t n = reached.vsplits.size();
      EXPECT_EQ(test::decode_slowly(reached, n), test::decode_slowly(original, n));
    }
  }
}

TEST(Binary, EveryFlippedBitIsFound) {
  const Bytes file = write_binary(rich_strips()).value();
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    Bytes bad = file;
    bad[bit / 8] ^= std::byte{1} << bit % 8;
    const auto read = read_binary(bad);
    ASSERT_FALSE(read) << "bit " << bit;
    EXPECT_EQ(read.error().code, ErrorCode::corrupt) << "bit " << bit;
  }
}

// What the CRC cannot find, since it is right: whatever is accepted must satisfy check().
TEST(Binary, EveryFlippedPayloadBitIsRefusedOrSafe) {
  const Bytes file = write_binary(rich_strips()).value();
  std::size_t refused = 0;
  for (const Chunk& chunk : read_chunks(file).chunks)
    for (std::size_t bit = 0; bit < 8 * chunk.payload.size(); ++bit) {
      Bytes bad = file;
      bad[chunk.payload_offset() + bit / 8] ^= std::byte{1} << bit % 8;
      const std::uint32_t crc = chunk_crc(ByteView(bad).subspan(chunk.offset, chunk.bytes() - 4));
      std::memcpy(bad.data() + chunk.offset + chunk.bytes() - 4, &crc, 4);
      const auto read = read_binary(bad);
      if (!read) {
        ++refused;
        continue;
      }
      const Result<void> holds = check(*read);
      ASSERT_TRUE(holds) << holds.error().message << " bit " << bit << " of "
                         << name_of(chunk.type);
    }
  EXPECT_GT(refused, 1000u);
}

TEST(Binary, RandomDamageWithRightCrcsIsRefusedOrSafe) {
  std::mt19937 random(1);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    SCOPED_TRACE(i);
    Bytes bad = write_binary(random_progressive_of_any_kind(1000 + i)).value();
    const ChunkList chunks = read_chunks(bad);
    for (int n = 0; n < 3; ++n) {
      const Chunk& chunk = chunks.chunks[random() % chunks.chunks.size()];
      if (chunk.payload.size() < 4) continue;
      const std::size_t at = random() % (chunk.payload.size() / 4) * 4;
      constexpr std::uint32_t kEdges[] = {
          0, 1, 2, 5, 0x7fff'ffff, 0x8000'0000, 0xffff'ff00, 0xffff'fffb, 0xffff'ffff};
      put_u32(std::span(bad).subspan(chunk.payload_offset()), at, kEdges[random() % 9]);
    }
    seal(bad);
    const auto read = read_binary(bad);
    if (!read) continue;
    const Result<void> holds = check(*read);
    EXPECT_TRUE(holds) << holds.error().message;
  }
}

TEST(Binary, KeepsUnknownAncillaryChunks) {
  const ProgressiveStrips strips = random_progressive(5, {.meshes = 2, .scene = true});
  const Bytes file = write_binary(strips).value();
  ProgressiveStrips expected = strips;
  expected.unknown = {
      {chunk_type("noTe"), Bytes(as_bytes("remember me").begin(), as_bytes("remember me").end())}};
  const test::ChunkFile::Item extra{expected.unknown[0].type, expected.unknown[0].payload};
  const std::size_t chunks = read_chunks(file).chunks.size();
  for (std::size_t nth = 1; nth < chunks; ++nth) {
    SCOPED_TRACE(nth);
    const auto read = read_binary(insert_chunk(file, extra, nth));
    ASSERT_TRUE(read) << read.error().message << read.error().offset;
    EXPECT_EQ(*read, expected);
    const ChunkList again = read_chunks(write_binary(*read).value());
    EXPECT_EQ(again.chunks[again.chunks.size() - 2].type, chunk_type("noTe"));
  }
}

TEST(Binary, RefusesUnknownCriticalChunks) {
  const Bytes file = write_binary(random_progressive(5)).value();
  for (std::size_t nth = 1; nth < read_chunks(file).chunks.size(); ++nth) {
    const Bytes bad = insert_chunk(file, {chunk_type("NOTE"), {}}, nth);
    const auto read = read_binary(bad);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::unsupported);
    EXPECT_EQ(read.error().offset, read_chunks(bad).chunks[nth].offset);
  }
}

TEST(Binary, RefusesChunksOutOfOrder) {
  const Bytes file = write_binary(rich_strips()).value();
  const ChunkList list = read_chunks(file);
  for (std::size_t nth = 0; nth + 1 < list.chunks.size(); ++nth) {
    const Chunk &a = list.chunks[nth], &b = list.chunks[nth + 1];
    const bool free = !is_known(a.type) || !is_known(b.type) ||
                      (a.type == b.type && (a.type == kMeshChunk || a.type == kForeignChunk));
    if (free) continue;  // a different file, or the same one for all a reader can know
    SCOPED_TRACE(std::string(name_of(a.type)) + " " + std::string(name_of(b.type)));
    const auto at = [&](std::uint64_t offset) {
      return file.begin() + static_cast<std::ptrdiff_t>(offset);
    };
    Bytes bad(file.begin(), at(a.offset));
    bad.insert(bad.end(), at(b.offset), at(b.offset + b.bytes()));
    bad.insert(bad.end(), at(a.offset), at(b.offset));
    bad.insert(bad.end(), at(b.offset + b.bytes()), file.end());
    const auto read = read_binary(bad);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::corrupt);
  }
}

TEST(Binary, RefusesWhatFollowsTheEnd) {
  Bytes file = write_binary(random_progressive(5)).value();
  const std::uint64_t size = file.size();
  file.push_back({});
  const auto read = read_binary(file);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::corrupt);
  EXPECT_EQ(read.error().offset, size);
}

struct BadField {
  const char* name;
  ChunkType chunk;
  std::size_t at;  ///< in the payload of its first chunk
  std::uint32_t value;
  Fault fault;
};

TEST(Binary, RefusesBadFieldsAndSaysWhichDemandIsBroken) {
  const ProgressiveStrips strips =
      random_progressive(11, {.scene = true, .faces = true, .order = true, .digest = true});
  const BadField kRows[] = {
      {"version", kHeaderChunk, 0, 2, Fault::version_unknown},
      {"profile", kHeaderChunk, 4, 2, Fault::profile_unknown},
      {"flags", kHeaderChunk, 4, 0x10000, Fault::flags_unknown},
      {"more_meshes_than_chunks", kHeaderChunk, 8, 2, Fault::mesh_chunks},
      {"meshes_over_limit", kHeaderChunk, 8, 0xffff'ffff, Fault::over_limit},
      {"vertices_over_limit", kHeaderChunk, 20, 1, Fault::over_limit},
      {"map_over_limit", kHeaderChunk, 52, 1, Fault::over_limit},
      {"memory_over_limit", kHeaderChunk, 68, 0x100, Fault::over_limit},
      {"vertex_total", kHeaderChunk, 16, 1, Fault::totals},
      {"name_longer_than_payload", kMeshChunk, 0, 0x7fff'ffff, Fault::payload_length},
      {"scene_nodes", kSceneChunk, 13, 0x7fff'ffff, Fault::payload_length},
      {"materials", kMaterialsChunk, 0, 0xffff'ffff, Fault::payload_length},
      {"row_too_long_a_number", kIndexChunk, 0, 0xffff'ffff, Fault::payload_length},
      {"row_not_the_shortest", kIndexChunk, 0, 0x80, Fault::payload_length},
      {"row_bytes", kIndexChunk, 0, 0x107f, Fault::row_chunk},
      {"base_mesh", kBaseChunk, 0, 1, Fault::base_mesh},
      {"base_vertices", kBaseChunk, 4, 0xffff'ff00, Fault::base_counts},
      {"base_map", kBaseChunk, 12, 0xffff'ff00, Fault::base_counts},
      {"packet_mesh", kPacketChunk, 0, 1, Fault::packet_mesh},
      {"packet_first", kPacketChunk, 4, 1, Fault::packet_not_next},
      {"packet_vsplits", kPacketChunk, 8, 0xffff'ffff, Fault::packet_single_wedges},
      {"packet_wedges", kPacketChunk, 12, 0xffff'ffff, Fault::packet_single_wedges},
      {"packet_reassigned", kPacketChunk, 16, 0xffff'ffff, Fault::packet_single_wedges},
      {"packet_offsets", kPacketChunk, 20, 0xffff'ffff, Fault::payload_length},
      {"packet_parent", kPacketChunk, 24, 0xffff'fff0, Fault::parent_not_there},
      {"faces_mesh", kFacesChunk, 0, 1, Fault::faces_mesh},
      {"faces_count", kFacesChunk, 4, 0xffff'ffff, Fault::face_count},
      {"faces_corners", kFacesChunk, 8, 0xffff'ffff, Fault::payload_length},
      {"faces_replaced", kFacesChunk, 12, 0xffff'ffff, Fault::face_count},
      {"faces_first", kFacesChunk, 16, 1, Fault::face_bounds},
      {"order_mesh", kOrderChunk, 0, 9, Fault::order_mesh},
      {"order_twice", kOrderChunk, 8, strips.meshes[0].order.vertex[1], Fault::order_vertex},
      {"digest_mesh", kDigestChunk, 0, 1, Fault::digest_mesh},
      {"digest_algorithm", kDigestChunk, 4, 2, Fault::digest_unknown},
      {"image", kImageChunk, 0, 0, Fault::image_data},
      {"foreign_key", kForeignChunk, 0, 0x7fff'ffff, Fault::payload_length},
  };
  const Bytes file = write_binary(strips).value();
  for (const BadField& row : kRows) {
    SCOPED_TRACE(row.name);
    Bytes bad = file;
    put_u32(payload_of(bad, row.chunk), row.at, row.value);
    seal(bad);
    const auto read = read_binary(bad);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().fault, row.fault) << read.error().message;
    EXPECT_EQ(read.error().code, code_of(row.fault));
    EXPECT_NE(read.error().offset, kNoOffset);
  }
}

TEST(Binary, AChunkThatRunsPastTheDeclaredSizeIsCorruptAtOnce) {
  const Bytes file = write_binary(random_progressive(5)).value();
  const Chunk base = read_chunks(file).chunks.at(3);
  ASSERT_EQ(base.type, kBaseChunk);
  Bytes bad(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(base.payload_offset()));
  put_u32(std::span(bad), base.offset + 4, 0x7fff'ffff);
  BinaryParser parser;
  const auto fed = parser.feed(bad);
  ASSERT_FALSE(fed);
  EXPECT_EQ(fed.error().code, ErrorCode::corrupt);
  EXPECT_EQ(fed.error().offset, base.offset);
}

// Every count of the headers at its largest and no limits at all: the base is refused for its
// length, without memory for what it promises.
TEST(Binary, ConsistentPromisesOfBillionsCostNothing) {
  const ProgressiveStrips strips = random_progressive(5, {.vsplits = 0});
  Bytes file = write_binary(strips).value();
  constexpr std::uint32_t kMany = kMaxCount;
  const std::span<std::byte> header = payload_of(file, kHeaderChunk);
  for (const std::size_t total : {16, 24, 48}) put_u32(header, total, kMany);
  const std::span<std::byte> mesh = payload_of(file, kMeshChunk);
  const std::size_t counts = mesh.size() - 9 * 4;
  for (const std::size_t count : {0, 1, 4, 7, 8}) put_u32(mesh, counts + 4 * count, kMany);
  const Index groups = static_cast<Index>(strips.meshes[0].groups.size());
  put_u32(mesh, counts - 4,
          kMany - static_cast<Index>(strips.meshes[0].base_map.size()) +
              strips.meshes[0].group_entries[groups - 1]);
  put_u32(payload_of(file, kIndexChunk), 8 + 20, kMany);
  const std::span<std::byte> base = payload_of(file, kBaseChunk);
  for (const std::size_t count : {1, 2, 3}) put_u32(base, 4 * count, kMany);
  seal(file);
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  const Limits none{kAll, kAll, kAll, kAll, kAll, kAll, 0};
  BinaryParser parser(none, file.size());
  const auto fed = parser.feed(file);
  ASSERT_FALSE(fed);
  EXPECT_EQ(fed.error().fault, Fault::payload_length);
  EXPECT_EQ(parser.strips().meshes[0].position.data.capacity(), 0u);
  EXPECT_EQ(parser.strips().meshes[0].base_map.capacity(), 0u);
}

// A sink that takes so many pieces and then fails.
class PieceSink final : public ByteSink {
 public:
  explicit PieceSink(std::size_t pieces) : left_(pieces) {}
  Result<void> write(ByteView bytes) override {
    if (left_-- == 0) return fail(ErrorCode::io, "disk is full");
    sizes.push_back(bytes.size());
    written.insert(written.end(), bytes.begin(), bytes.end());
    return {};
  }
  std::vector<std::size_t> sizes;
  Bytes written;

 private:
  std::size_t left_;
};

TEST(Binary, IsWrittenChunkByChunk) {
  const ProgressiveStrips strips = rich_strips();
  const Bytes file = write_binary(strips).value();
  const std::vector<Chunk> chunks = read_chunks(file).chunks;
  PieceSink all(1000);
  ASSERT_TRUE(write_binary(strips, all));
  EXPECT_EQ(all.written, file);
  ASSERT_EQ(all.sizes.size(), chunks.size() + 1);
  for (std::size_t i = 0; i < chunks.size(); ++i) EXPECT_EQ(all.sizes[i + 1], chunks[i].bytes());

  PieceSink few(3);
  const auto failed = write_binary(strips, few);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::io);
  EXPECT_EQ(few.sizes.size(), 3u) << "nothing is written after an error";
}

TEST(Binary, LimitsAreAnAnswerOfTheirOwn) {
  const Bytes file = write_binary(rich_strips()).value();
  for (std::uint64_t Limits::*field :
       {&Limits::vertices, &Limits::wedges, &Limits::corners, &Limits::meshes,
        &Limits::string_bytes, &Limits::memory_bytes}) {
    Limits tight;
    tight.*field = 1;
    const auto read = read_binary(file, tight);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::over_limit);
  }
}

TEST(Binary, ARefusedChunkLeavesTheStripsAsTheyWere) {
  const ProgressiveStrips strips = random_progressive(
      21,
      {.vsplits = 6, .packet_vsplits = 3, .placement = Placement::optimal, .single_wedges = false});
  Bytes file = write_binary(strips).value();
  // The last record of the second packet gets a parent that does not exist.
  put_u32(payload_of(file, kPacketChunk, 1), 24 + 8, 0x7fff'ffff);
  seal(file);
  const ChunkList list = read_chunks(file);
  std::size_t second = 0;
  for (std::size_t i = 0; i < list.chunks.size(); ++i)
    if (list.chunks[i].type == kPacketChunk) second = i;
  BinaryParser before, after;
  ASSERT_TRUE(before.feed(ByteView(file).first(list.chunks[second].offset)));
  const auto fed = after.feed(file);
  ASSERT_FALSE(fed);
  EXPECT_EQ(fed.error().path, "/meshes/0/vsplits/5");
  EXPECT_EQ(after.strips(), before.strips());
  const auto again = after.feed({});
  ASSERT_FALSE(again) << "the error stays";
  EXPECT_EQ(again.error(), fed.error());
  EXPECT_TRUE(after.has_base());
}

TEST(PackedArrays, StandLowestBitFirst) {
  const auto packed = [](const std::vector<Index>& numbers, unsigned bits) {
    Bytes out(layout::packed_bytes(bits, numbers.size()));
    layout::pack(numbers, bits, out);
    return out;
  };
  const auto bytes = [](std::initializer_list<int> values) {
    Bytes out;
    for (const int v : values) out.push_back(static_cast<std::byte>(v));
    return out;
  };
  EXPECT_EQ(packed({1, 2, 0}, 2), bytes({0x09}));
  EXPECT_EQ(packed({5, 0, 7, 1}, 3), bytes({0xc5, 0x03}));
  EXPECT_EQ(packed({0xfffffffe, 1}, 32), bytes({0xfe, 0xff, 0xff, 0xff, 1, 0, 0, 0}));
  EXPECT_EQ(packed({0, 0}, 0), Bytes());
  EXPECT_FALSE(layout::ends_in_zeros(bytes({0xc9}), 2, 3));
  EXPECT_TRUE(layout::ends_in_zeros(bytes({0xff}), 2, 4));
}

RC_GTEST_PROP(PackedArrays, ComeBack, ()) {
  const auto bits = *rc::gen::inRange<unsigned>(0, 33);
  auto numbers = *rc::gen::arbitrary<std::vector<Index>>();
  for (Index& n : numbers) n = bits == 0 ? 0 : n >> (32 - bits);
  Bytes out(layout::packed_bytes(bits, numbers.size()));
  layout::pack(numbers, bits, out);
  RC_ASSERT(layout::unpack<Index>(out, bits, numbers.size()) == numbers);
  RC_ASSERT(layout::ends_in_zeros(out, bits, numbers.size()));
}

}  // namespace
}  // namespace pstrips
