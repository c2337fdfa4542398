// Files that arrive in pieces or end early.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/stream_decoder.h"
#include "core/bytes.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunk_table.h"
#include "tests/support/meshes.h"
#include "tests/support/progressive.h"
#include "tests/support/shown.h"

namespace pstrips {
namespace {

struct Sample {
  ProgressiveStrips strips;
  Bytes file;
  std::vector<std::uint64_t> ends;  // of the last base, then of each packet
  struct Tail {
    ChunkType type;
    Index mesh;
    std::uint64_t end;
  };
  std::vector<Tail> tail;  // what stands behind the packets and belongs to one mesh
};

Sample sample(Model model, const EncodeOptions& options) {
  Sample out;
  out.strips = encode(model, options).value();
  out.file = write_binary(out.strips).value();
  std::uint64_t base_end = 0;
  for (const Chunk& chunk : read_chunks(out.file).chunks) {
    if (chunk.type == kBaseChunk) base_end = chunk.offset + chunk.bytes();
    const std::uint64_t end = chunk.offset + chunk.bytes();
    if (chunk.type == kPacketChunk) out.ends.push_back(end);
    if (chunk.type == kFacesChunk || chunk.type == kOrderChunk)
      out.tail.push_back({chunk.type, ByteReader(chunk.payload).u32(), end});
  }
  out.ends.insert(out.ends.begin(), base_end);
  return out;
}

Sample small_sample() {
  Model model;
  model.meshes = {test::grid(8), test::cube(true)};
  return sample(std::move(model), {.keep_order = true, .packet_min = 8});
}

// How many packets a file of `size` bytes shows; -1 before the base.
int level_at(const Sample& s, std::size_t size) {
  int level = -1;
  for (const std::uint64_t end : s.ends)
    if (end <= size) ++level;
  return level;
}

// Without the faces and original orders that stand past the first `size` bytes.
ProgressiveStrips arrived(const Sample& s, std::size_t size) {
  ProgressiveStrips out = s.strips;
  for (const Sample::Tail& chunk : s.tail) {
    if (chunk.end <= size) continue;
    if (chunk.type == kFacesChunk) out.meshes[chunk.mesh].faces = {};
    if (chunk.type == kOrderChunk) out.meshes[chunk.mesh].order = {};
  }
  return out;
}

void expect_last_whole_packet(const Sample& s, std::size_t size) {
  SCOPED_TRACE(size);
  const Bytes cut(s.file.begin(), s.file.begin() + static_cast<std::ptrdiff_t>(size));
  const auto read = read_binary(cut, {}, ReadMode::prefix);
  const int level = level_at(s, size);
  if (level < 0) {
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::truncated);
    return;
  }
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->complete, size == s.file.size());
  ASSERT_EQ(read->packets.size(), static_cast<std::size_t>(level));
  EXPECT_EQ(decode(*read)->meshes,
            decode(arrived(s, size), static_cast<std::size_t>(level))->meshes);
}

TEST(Prefix, OfEveryLengthShowsTheLastWholePacket) {
  const Sample s = small_sample();
  for (std::size_t size = 0; size <= s.file.size(); ++size) expect_last_whole_packet(s, size);
}

TEST(Prefix, OfRandomLengthsOfALargeFileToo) {
  const Sample s = sample(test::model_of(test::torus(160, 80)), {});
  std::mt19937_64 random(7);
  std::size_t levels = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::size_t size = random() % s.file.size();
    const auto read = read_binary(ByteView(s.file).first(size), {}, ReadMode::prefix);
    const int level = level_at(s, size);
    ASSERT_EQ(read.has_value(), level >= 0) << size;
    if (!read) continue;
    ASSERT_EQ(read->packets.size(), static_cast<std::size_t>(level)) << size;
    if (i % 20 == 0) {
      ASSERT_EQ(decode(*read)->meshes, decode(s.strips, read->packets.size())->meshes);
    }
    ++levels;
  }
  EXPECT_GT(levels, 100u);
}

TEST(StreamDecoder, ShowsTheSameWhateverThePieces) {
  const Sample s = small_sample();
  for (const std::size_t piece :
       {std::size_t{1}, std::size_t{7}, std::size_t{1000}, s.file.size()}) {
    StreamDecoder decoder;
    std::size_t shown = 0;
    for (std::size_t at = 0; at < s.file.size(); at += piece) {
      ASSERT_TRUE(decoder.feed(ByteView(s.file).subspan(at, std::min(piece, s.file.size() - at))));
      const int level = level_at(s, std::min(at + piece, s.file.size()));
      ASSERT_EQ(decoder.has_base(), level >= 0);
      if (level < 0) continue;
      ASSERT_EQ(decoder.packets(), static_cast<std::size_t>(level));
      if (shown == decoder.packets() && shown > 0) continue;
      shown = decoder.packets();
      decoder.update();
      std::uint64_t total = 0;
      for (Index m = 0; m < 2; ++m) {
        const Level& now = decoder.mesh(m).level();
        DisplayStrips display;
        decoder.mesh(m).append_display(display);
        const auto in_display = test::triangles_of(display, now);
        ASSERT_EQ(in_display, test::triangles_of(now));
        ASSERT_EQ(decoder.mesh(m).cost().vertices_sent + decoder.mesh(m).cost().restarts,
                  display.size());
        total += in_display.size();
      }
      ASSERT_EQ(decoder.totals().triangles, total);
    }
    EXPECT_TRUE(decoder.complete());
    EXPECT_FALSE(decoder.end());
    EXPECT_EQ(decoder.model()->meshes, decode(s.strips)->meshes);
  }
}

// Made by hand of random records, so that the file has every liberty of the format.
TEST(StreamDecoder, DerivesTheStripsOfMapsThatGrow) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const ProgressiveStrips strips =
        test::random_progressive(seed, {.meshes = 2,
                                        .vsplits = 20,
                                        .encoding = MapEncoding::triangles,
                                        .placement = static_cast<Placement>(seed % 2),
                                        .single_wedges = seed % 3 == 0,
                                        .scene = seed % 2 == 0});
    const Bytes file = write_binary(strips).value();
    StreamDecoder decoder;
    for (std::size_t at = 0; at < file.size(); at += 100) {
      ASSERT_TRUE(
          decoder.feed(ByteView(file).subspan(at, std::min<std::size_t>(100, file.size() - at))));
      if (!decoder.update()) continue;
      std::uint64_t derived = 0;
      for (Index m = 0; m < 2; ++m) {
        DisplayStrips display;
        decoder.mesh(m).append_display(display);
        const Level& now = decoder.mesh(m).level();
        ASSERT_EQ(test::triangles_of(display, now), test::triangles_of(now));
        derived += decoder.mesh(m).derived_strips();
      }
      ASSERT_EQ(decoder.totals().strips, derived);
    }
    ASSERT_TRUE(decoder.complete());
    EXPECT_EQ(decoder.model()->meshes, decode(strips)->meshes);
  }
}

// What a viewer does: draw whenever there is something new.
TEST(StreamDecoder, UpdatesOnceForTheBaseAndOnceForEachPacket) {
  const Sample s = small_sample();
  StreamDecoder decoder;
  std::size_t drawn = 0;
  for (const std::byte& byte : s.file) {
    ASSERT_TRUE(decoder.feed({&byte, 1}));
    if (!decoder.update()) continue;
    ASSERT_EQ(decoder.packets(), drawn++);
    EXPECT_FALSE(decoder.update());
  }
  EXPECT_EQ(drawn, s.ends.size());
}

// The bits below the cells stand behind the packets.
TEST(StreamDecoder, UpdatesOnceMoreWhenNumbersAreCompleted) {
  for (const Placement placement : {Placement::subset, Placement::optimal}) {
    const Sample s = sample(test::model_of(test::torus(40, 20)),
                            {.profile = Profile::compact, .placement = placement});
    StreamDecoder decoder;
    std::size_t updates = 0;
    for (const std::byte byte : s.file) {
      ASSERT_TRUE(decoder.feed({&byte, 1}));
      if (decoder.update()) ++updates;
    }
    EXPECT_EQ(updates, 1 + s.strips.packets.size() + 1);
    const Level whole = [&] {
      Level level(s.strips.meshes[0]);
      level.refine_fully();
      return level;
    }();
    EXPECT_TRUE(std::ranges::equal(decoder.mesh(0).level().positions(), whole.positions()));
  }
}

TEST(StreamDecoder, UpdatesForAFileWithoutPackets) {
  ProgressiveStrips base = cut(small_sample().strips, 0);
  ASSERT_TRUE(base.packets.empty());
  const Bytes file = write_binary(base).value();
  StreamDecoder decoder;
  EXPECT_FALSE(decoder.update());
  ASSERT_TRUE(decoder.feed(file));
  EXPECT_TRUE(decoder.complete());
  EXPECT_TRUE(decoder.update());
  EXPECT_GT(decoder.mesh(0).cost().vertices_sent, 0u);
  EXPECT_FALSE(decoder.update());
}

TEST(StreamDecoder, FiltersOnlyWhatAPacketRewrote) {
  Model model;
  model.meshes = {test::grid(60)};
  const Sample s = sample(std::move(model), {.packet_min = 4});
  DisplayLevel level(s.strips.meshes[0], Filter::dtfs);
  level.refine(4);
  const std::size_t filtered = level.update();
  EXPECT_GT(filtered, 0u);
  EXPECT_LT(filtered, strip_ranges(level.level().resolved()).size());
  EXPECT_EQ(level.update(), 0u);
}

TEST(StreamDecoder, KeepsWhatItHasWhenTheRestIsBroken) {
  Model model;
  model.meshes = {test::grid(9)};
  const Sample s = sample(std::move(model), {.packet_min = 8});
  Bytes broken = s.file;
  broken[s.ends[2] - 9] ^= std::byte{1};  // inside the second packet
  StreamDecoder decoder;
  const auto fed = decoder.feed(broken);
  ASSERT_FALSE(fed);
  EXPECT_EQ(fed.error().code, ErrorCode::corrupt);
  EXPECT_EQ(decoder.packets(), 1u);
  EXPECT_EQ(decoder.model()->meshes, decode(s.strips, 1)->meshes);
}

}  // namespace
}  // namespace pstrips
