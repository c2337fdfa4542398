#include "core/bytes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace pstrips {
namespace {

Bytes sample() {
  ByteWriter out;
  out.u8(1);
  out.align(4);
  out.u32(2);
  out.string("abc");
  out.f64(-0.0);
  return std::move(out).take();
}

TEST(ByteReader, ReadsWhatTheWriterWrote) {
  const Bytes bytes = sample();
  ByteReader in(bytes);
  EXPECT_EQ(in.u8(), 1);
  in.align(4);
  EXPECT_EQ(in.u32(), 2u);
  EXPECT_EQ(in.string(3), "abc");
  EXPECT_TRUE(std::signbit(in.f64()));
  in.expect_end();
  EXPECT_FALSE(in.error());
}

TEST(ByteReader, EveryPrefixIsTruncated) {
  const Bytes good = sample();
  for (std::size_t size = 0; size < good.size(); ++size) {
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    ByteReader in(cut);
    in.u8(), in.align(4), in.u32(), in.string(3), in.f64();
    ASSERT_TRUE(in.error());
    EXPECT_EQ(in.error()->code, ErrorCode::truncated);
    EXPECT_LE(in.error()->offset, size);
  }
}

TEST(ByteReader, TheFirstFailureSticks) {
  const Bytes bytes(3);
  ByteReader in(bytes, 100);
  EXPECT_EQ(in.u32(), 0u);
  EXPECT_EQ(in.u8(), 0);
  EXPECT_EQ(in.error()->offset, 100u);
}

TEST(ByteReader, CountsThatTheBytesCannotJustifyAreRefused) {
  ByteWriter out;
  out.u32(0xffffffff);
  out.u64(0);
  ByteReader in(out.view());
  EXPECT_EQ(in.count(4), 0u);
  EXPECT_EQ(in.error()->code, ErrorCode::truncated);
  ByteReader again(out.view());
  EXPECT_TRUE(again.array<double>(1ull << 61).empty());
  EXPECT_TRUE(again.error());
}

TEST(ByteReader, NonZeroPaddingIsCorrupt) {
  const Bytes bytes{std::byte{1}, std::byte{0}, std::byte{7}, std::byte{0}};
  ByteReader in(bytes);
  in.u8();
  in.align(4);
  EXPECT_EQ(in.error()->code, ErrorCode::corrupt);
}

RC_GTEST_PROP(ByteReader, ArraysComeBack, (const std::vector<std::uint32_t>& values)) {
  ByteWriter out;
  out.array(std::span<const std::uint32_t>(values));
  ByteReader in(out.view());
  RC_ASSERT(in.array<std::uint32_t>(values.size()) == values);
  RC_ASSERT(!in.error());
}

}  // namespace
}  // namespace pstrips
