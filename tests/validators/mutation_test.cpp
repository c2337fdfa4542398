// Damaged files produce findings or are still valid; they never do harm.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/xml/xml.h"
#include "tests/support/progressive.h"
#include "tests/validators/chunk_file.h"
#include "tests/validators/corpus.h"
#include "tests/validators/samples.h"
#include "validators/validate.h"

namespace pstrips {
namespace {

class Damage {
 public:
  explicit Damage(std::uint32_t seed) : random_(seed) {}

  Bytes operator()(Bytes bytes) {
    for (std::uint32_t n = 1 + below(3); n > 0 && !bytes.empty(); --n) {
      const std::size_t at = below(bytes.size());
      const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
      switch (below(6)) {
        case 0:
          *place ^= static_cast<std::byte>(1u << below(8));
          break;
        case 1:
          *place = static_cast<std::byte>(below(256));
          break;
        case 2:
          *place = std::byte{0xff};
          break;
        case 3:
          bytes.resize(at);
          break;
        case 4:
          bytes.insert(place, 1 + below(9), static_cast<std::byte>(below(256)));
          break;
        case 5:
          bytes.erase(place, place + static_cast<std::ptrdiff_t>(
                                         std::min<std::size_t>(below(9), bytes.size() - at)));
          break;
      }
    }
    return bytes;
  }

  /// Damages payloads and makes the CRC right again, so that what reads payloads is reached.
  Bytes inside(ByteView file) {
    test::ChunkFile chunks(file);
    for (std::uint32_t n = 1 + below(3); n > 0; --n) {
      test::ChunkFile::Item& item = chunks.items()[below(chunks.items().size())];
      if (item.payload.empty()) continue;
      const std::size_t at = below(item.payload.size());
      constexpr std::uint8_t kValues[] = {0, 1, 2, 3, 4, 5, 7, 8, 16, 0x7f, 0x80, 0xfb, 0xfd, 0xff};
      item.payload[at] = std::byte{kValues[below(std::size(kValues))]};
      if (below(8) == 0)
        std::fill_n(item.payload.begin() + static_cast<std::ptrdiff_t>(at & ~std::size_t{3}),
                    std::min<std::size_t>(4, item.payload.size() - (at & ~std::size_t{3})),
                    std::byte{0xff});
    }
    if (below(8) == 0)
      std::swap(chunks.items()[below(chunks.items().size())],
                chunks.items()[below(chunks.items().size())]);
    return chunks.bytes();
  }

 private:
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(random_() % n); }
  std::mt19937 random_;
};

/// What a report must be whatever the file: consistent, and located inside the file.
void expect_sane(ByteView file, const Report& report) {
  EXPECT_EQ(report.verdict() == Verdict::valid, report.errors() == 0);
  for (const Finding& finding : report.findings()) {
    EXPECT_FALSE(finding.message.empty());
    EXPECT_TRUE(finding.offset == kNoOffset || finding.offset <= file.size()) << finding.code;
  }
}

/// The reader is the other opinion: what the validator calls valid can be read.
void expect_agreement(ByteView file, const Report& report) {
  expect_sane(file, report);
  const bool read =
      looks_like_xml(file) ? read_xml(file).has_value() : read_binary(file).has_value();
  EXPECT_TRUE(read || report.verdict() != Verdict::valid);
}

TEST(Mutations, OfAnyByteNeverHarm) {
  Damage damage(1);
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    const ProgressiveStrips strips = test::random_progressive_of_any_kind(seed);
    const Bytes binary = write_binary(strips).value(), xml = write_xml(strips);
    for (int i = 0; i < 15; ++i) {
      SCOPED_TRACE(seed * 100 + static_cast<std::uint32_t>(i));
      for (const Bytes* whole : {&binary, &xml}) {
        const Bytes damaged = damage(*whole);
        expect_agreement(damaged, validate(damaged));
      }
    }
  }
}

TEST(Mutations, BehindACorrectCrcNeverHarm) {
  Damage damage(2);
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const Bytes file = write_binary(test::random_progressive_of_any_kind(seed)).value();
    for (int i = 0; i < 40; ++i) {
      SCOPED_TRACE(seed * 100 + static_cast<std::uint32_t>(i));
      const Bytes damaged = damage.inside(file);
      expect_agreement(damaged, validate(damaged));
    }
  }
}

TEST(Mutations, OfMapsOfTrianglesNeverHarm) {
  Damage damage(4);
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const ProgressiveStrips strips = test::random_progressive(
        seed, {.encoding = MapEncoding::triangles, .single_wedges = seed % 2 == 0});
    const Bytes binary = write_binary(strips).value(), xml = write_xml(strips);
    for (int i = 0; i < 20; ++i) {
      SCOPED_TRACE(seed * 100 + static_cast<std::uint32_t>(i));
      for (const Bytes& damaged : {damage.inside(binary), damage(xml)})
        expect_agreement(damaged, validate(damaged));
    }
  }
}

TEST(Mutations, OfBatchesNeverHarm) {
  Damage damage(5);
  for (const ProgressiveStrips& strips : {test::batches(), test::small(), test::compact()}) {
    const Bytes file = write_binary(strips).value();
    for (int i = 0; i < 4000; ++i) {
      SCOPED_TRACE(i);
      const Bytes damaged = damage.inside(file);
      expect_agreement(damaged, validate(damaged));
    }
  }
}

TEST(Mutations, OfTheCorpusNeverHarm) {
  Damage damage(3);
  for (const test::CorpusFile& file : test::invalid_corpus()) {
    SCOPED_TRACE(file.name);
    for (int i = 0; i < 20; ++i) {
      const Bytes damaged = damage(file.bytes);
      expect_agreement(damaged, validate(damaged));
    }
  }
}

TEST(Mutations, EveryPrefixIsTruncated) {
  for (const test::CorpusFile& file : test::valid_corpus()) {
    if (file.name.ends_with(".pstripx")) continue;
    for (std::size_t size = 0; size < file.bytes.size(); ++size) {
      const Bytes cut(file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const Report report = validate(cut);
      EXPECT_EQ(report.verdict(), Verdict::truncated) << file.name << " cut at " << size;
      EXPECT_EQ(report.findings().size(), 1u);
    }
  }
}

}  // namespace
}  // namespace pstrips
