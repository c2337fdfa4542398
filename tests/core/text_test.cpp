#include "core/text.h"

#include <gtest/gtest.h>

#include <string>

namespace pstrips {
namespace {

// The code point as UTF-8 in that many bytes, however few or many it takes.
std::string encoded(std::uint32_t code, std::size_t bytes) {
  constexpr unsigned char kLeads[] = {0, 0, 0xc0, 0xe0, 0xf0};
  std::string out(bytes, '\0');
  for (std::size_t i = bytes; i-- > 1; code >>= 6) out[i] = static_cast<char>(0x80 | (code & 0x3f));
  out[0] = static_cast<char>(bytes == 1 ? code : kLeads[bytes] | code);
  return out;
}

std::size_t shortest(std::uint32_t code) {
  return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
}

TEST(Utf8, IsEveryCodePointInItsShortestFormAndNothingElse) {
  for (std::uint32_t code = 0; code < 0x120000; ++code) {
    const bool is_character = code < 0x110000 && (code < 0xd800 || code > 0xdfff);
    for (std::size_t bytes = shortest(code); bytes <= 4; ++bytes) {
      const bool is_right = is_character && bytes == shortest(code);
      const std::string text = encoded(code, bytes);
      ASSERT_EQ(utf8_length(text), is_right ? bytes : 0) << std::hex << code << " in " << bytes;
      ASSERT_EQ(utf8_length(text + "x"), is_right ? bytes : 0) << std::hex << code;
      if (bytes > 1) {
        ASSERT_EQ(utf8_length(std::string_view(text).substr(0, bytes - 1)), 0u) << code;
      }
    }
  }
}

TEST(Utf8, IsNoByteThatCannotBeginACharacterAndNoLoneOnes) {
  EXPECT_EQ(utf8_length(""), 0u);
  for (unsigned byte = 0x80; byte < 0x100; ++byte)
    EXPECT_EQ(utf8_length(std::string(1, static_cast<char>(byte))), 0u) << byte;
  for (const unsigned byte : {0x00u, 0x7fu, 0xc0u, 0xffu}) {
    const std::string text = {static_cast<char>(0xe2), static_cast<char>(0x82),
                              static_cast<char>(byte)};
    EXPECT_EQ(utf8_length(text), 0u) << byte;
  }
}

TEST(Utf8, IsFollowedToWhereItBreaks) {
  EXPECT_EQ(first_not_utf8(""), 0u);
  EXPECT_EQ(first_not_utf8("a\xc3\xa4\xe2\x82\xac"), 6u);
  EXPECT_EQ(first_not_utf8("a\xc3\xa4\xe4"), 3u);
  EXPECT_TRUE(is_utf8("\xf0\x9f\x98\x80"));
  EXPECT_FALSE(is_utf8("\xf0\x9f\x98"));
}

TEST(Utf8, MayHaveAMarkInFront) {
  EXPECT_EQ(without_utf8_mark("\xef\xbb\xbf"
                              "a"),
            "a");
  EXPECT_EQ(without_utf8_mark("\xef\xbb\xbf\xef\xbb\xbf"), "\xef\xbb\xbf");
  for (const std::string_view text : {"", "a", "\xef\xbb", "a\xef\xbb\xbf"})
    EXPECT_EQ(without_utf8_mark(text), text);
}

TEST(LowerCase, IsForAsciiLetters) {
  EXPECT_EQ(lower_case("@AZaz[`{09\xc3\x84"), "@azaz[`{09\xc3\x84");
}

}  // namespace
}  // namespace pstrips
