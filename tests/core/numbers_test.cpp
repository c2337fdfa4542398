#include "core/numbers.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace pstrips {
namespace {

struct Row {
  std::string_view text;
  std::size_t length;  ///< that is read; 0: none
  double value;
};
const Row kRows[] = {
    {"0", 1, 0},
    {"-0", 2, 0},
    {"12 3", 2, 12},
    {"1.5\n", 3, 1.5},
    {".5", 2, 0.5},
    {"-.5", 3, -0.5},
    {"7.", 2, 7},
    {"0.1", 3, 0.1},
    {"9007199254740991", 16, 9007199254740991.0},  // 2^53 - 1
    {"9007199254740992", 0, 0},
    {"0.000000000000000001", 20, 1e-18},  // 19 digits
    {"0.0000000000000000001", 0, 0},      // 20 digits
    {"", 0, 0},
    {"-", 0, 0},
    {".", 0, 0},
    {"+1", 0, 0},
    {"1e5", 0, 0},
    {"1.2.3", 0, 0},
    {"1,5", 0, 0},
    {"nan", 0, 0},
    {"99999999999999999999999", 0, 0},  // overflows 64 bits
};

TEST(ShortDecimals, AreReadUpToWhiteSpace) {
  for (const Row& row : kRows) {
    SCOPED_TRACE(std::string(row.text));
    ShortDecimal out;
    const char* const begin = row.text.data();
    const char* const stop = read_short_decimal(begin, begin + row.text.size(), out);
    if (row.length == 0) {
      EXPECT_EQ(stop, nullptr);
      continue;
    }
    ASSERT_EQ(stop, begin + row.length);
    EXPECT_EQ(out.is_negative ? -out.magnitude() : out.magnitude(), row.value);
    EXPECT_EQ(out.is_negative, row.text.starts_with('-'));
  }
}

TEST(ShortDecimals, AreRoundedAsTheLibraryRounds) {
  EXPECT_TRUE(rc::check([](std::uint64_t digits, std::uint8_t decimals) {
    digits %= std::uint64_t{1} << 53;
    std::string text = std::to_string(digits);
    text.insert(text.size() - decimals % text.size(), ".");
    ShortDecimal out;
    RC_ASSERT(read_short_decimal(text.data(), text.data() + text.size(), out) ==
              text.data() + text.size());
    double expected = 0;
    RC_ASSERT(parse_number(text, expected));
    RC_ASSERT(out.magnitude() == expected);
  }));
}

TEST(Numbers, AreWholeTokens) {
  double real = 0;
  for (const std::string_view token : {"1", "+1", "-1e-3", "INF", "nan", "1e308"})
    EXPECT_TRUE(parse_number(token, real)) << token;
  for (const std::string_view token : {"", "+", "+-1", "1 ", " 1", "1x", "1e999", "1e-999"})
    EXPECT_FALSE(parse_number(token, real)) << token;
  std::uint32_t whole = 0;
  EXPECT_TRUE(parse_number("4294967295", whole));
  for (const std::string_view token : {"4294967296", "-1", "1.0", "1e3"})
    EXPECT_FALSE(parse_number(token, whole)) << token;
}

}  // namespace
}  // namespace pstrips
