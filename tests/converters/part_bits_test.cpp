// What the bits of a file are spent on: the sums are the bytes, whatever the file.

#include "formats/pstrip/payload/part_bits.h"

#include <gtest/gtest.h>

#include <numeric>

#include "converters/encode.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunk_table.h"
#include "tests/support/meshes.h"
#include "tests/support/seamed_meshes.h"

namespace pstrips {
namespace {

Bytes file_of(const Mesh& mesh, Profile profile) {
  const auto strips =
      encode(test::model_of(mesh),
             {.profile = profile, .position_bits = profile == Profile::compact ? 12u : 0u});
  EXPECT_TRUE(strips) << strips.error().message;
  return write_binary(*strips).value();
}

double of(const PartBits& bits, Part part) { return bits[static_cast<std::size_t>(part)]; }
double sum_of(const PartBits& bits) { return std::accumulate(bits.begin(), bits.end(), 0.0); }

TEST(PartBits, OfAChunkAreItsBytes) {
  for (const Profile profile : {Profile::plain, Profile::compact}) {
    const Bytes file = file_of(test::seamed_torus(40, 30), profile);
    const ChunkList list = read_chunks(file);
    const std::vector<PartBits> bits = count_part_bits(list);
    ASSERT_EQ(bits.size(), list.chunks.size());
    for (std::size_t i = 0; i < bits.size(); ++i) {
      const std::uint64_t signature = i == 0 ? kSignature.size() : 0;
      EXPECT_NEAR(sum_of(bits[i]), 8 * static_cast<double>(list.chunks[i].bytes() + signature),
                  1e-6);
    }
  }
}

TEST(PartBits, CodesAreTheirPayloadWithinAHundredth) {
  const Bytes file = file_of(test::seamed_torus(160, 120), Profile::compact);
  const ChunkList list = read_chunks(file);
  const std::vector<PartBits> bits = count_part_bits(list);
  int large = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    const Chunk& chunk = list.chunks[i];
    if (chunk.type != kPacketChunk || chunk.payload.size() < 1000) continue;
    ++large;
    const double frame = 8 * static_cast<double>(chunk.bytes() - chunk.payload.size());
    EXPECT_LT(of(bits[i], Part::container) - frame,
              0.08 * static_cast<double>(chunk.payload.size()));
    for (const Part part : {Part::parents, Part::connectivity, Part::tangential, Part::normal,
                            Part::wedges, Part::attributes})
      EXPECT_GT(of(bits[i], part), 0) << name_of(part);
  }
  EXPECT_GE(large, 3);
}

TEST(PartBits, OfWhatIsThereOfAFile) {
  const Bytes file = file_of(test::torus(12, 9), Profile::compact);
  const std::size_t last = read_chunks(file).chunks.back().offset;
  for (std::size_t size = 0; size <= last; size += 7) {
    const ChunkList list = read_chunks(ByteView(file).first(size));
    double all = 0;
    for (const PartBits& bits : count_part_bits(list)) all += sum_of(bits);
    EXPECT_NEAR(all, list.chunks.empty() ? 0 : 8 * static_cast<double>(list.end), 1e-6) << size;
  }
  Bytes bad = file;
  for (const Chunk& chunk : read_chunks(file).chunks)
    if (chunk.type == kBaseChunk) bad[chunk.payload_offset() + 9] ^= std::byte{0x10};
  const ChunkList list = read_chunks(bad);
  for (std::size_t i = 1; i < list.chunks.size(); ++i)
    EXPECT_NEAR(sum_of(count_part_bits(list)[i]), 8 * static_cast<double>(list.chunks[i].bytes()),
                1e-6);
}

}  // namespace
}  // namespace pstrips
