#include "formats/obj/numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string_view>

namespace pstrips::obj {
namespace {

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v); }

bool parses(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  return parse_number(text.data(), end, number) == end;
}

TEST(ParseNumber, ReadsTheNotationsInUse) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const struct {
    std::string_view text;
    double value;
    bool fits;
  } kRows[] = {
      {"0", 0, true},
      {"-0.000", -0.0, true},
      {"1", 1, true},
      {"+1.5", 1.5, true},
      {".5", .5, true},
      {"5.", 5, true},
      {"-123.456001", -123.456001, false},
      {"130.000000", 130, true},
      {"16777216", 16777216, true},
      {"16777217", 16777217, false},
      {"1e-3", 1e-3, true},
      {"1E+3", 1e3, true},
      {"0.1000000000000000055511151231257827", 0.1, true},
      {"0.30000000000000004", 0.30000000000000004, false},
      {"3.4028235e+38", 3.4028235e38, true},
      {"3.5e38", 3.5e38, false},
      {"1e-45", 1e-45, true},
      {"1e-46", 1e-46, false},
      {"4.9406564584124654e-324", 5e-324, false},
      {"12345678901234567890123", 12345678901234567890123.0, false},
      {"inf", kInf, true},
      {"-Infinity", -kInf, true},
      {"-1.#INF", -kInf, true},
  };
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.text);
    Number number;
    ASSERT_TRUE(parses(row.text, number));
    EXPECT_EQ(bits(number.value), bits(row.value));
    EXPECT_EQ(number.fits_f32, row.fits);
  }
}

TEST(ParseNumber, ReadsNan) {
  for (const std::string_view text : {"nan", "NaN", "-nan", "1.#IND", "-1.#IND00", "1.#QNAN"}) {
    SCOPED_TRACE(text);
    Number number;
    ASSERT_TRUE(parses(text, number));
    EXPECT_TRUE(std::isnan(number.value));
    EXPECT_EQ(std::signbit(number.value), text.starts_with('-'));
    EXPECT_TRUE(number.fits_f32);
  }
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
  for (const std::string_view text :
       {"", "-", "+", ".", "e5", "1e", "1x", "1,5", "--1", "+-1", "0x10", "1.2.3", "1e400",
        "-1e999", "1.#FOO", "1.#", "nanx", "1/2"}) {
    SCOPED_TRACE(text);
    Number number;
    EXPECT_FALSE(parses(text, number));
  }
}

TEST(ParseNumber, StopsAtWhiteSpace) {
  const std::string_view text = "1.5\t2";
  Number number;
  EXPECT_EQ(parse_number(text.data(), text.data() + text.size(), number), text.data() + 3);
  EXPECT_EQ(number.value, 1.5);
}

// The arithmetic shortcut against the C library and against the definition.
TEST(ParseNumber, AgreesWithTheSlowWay) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300'000; ++i) {
    const int digits = 1 + static_cast<int>(random() % 10);
    std::string text = random() % 2 ? "-" : "";
    const std::size_t first = text.size();
    for (int d = 0; d < digits; ++d) text += static_cast<char>('0' + random() % 10);
    text.insert(first + random() % static_cast<unsigned>(digits + 1), ".");
    text.append(random() % 4, '0');
    Number number;
    ASSERT_TRUE(parses(text, number)) << text;
    double expected = 0;
    std::from_chars(text.data(), text.data() + text.size(), expected);
    ASSERT_EQ(bits(number.value), bits(expected)) << text;
    ASSERT_EQ(number.fits_f32, fits_f32(expected)) << text;
  }
}

TEST(FitsF32, HoldsForEveryFloatsShortestDecimal) {
  std::mt19937 random(2);
  for (int i = 0; i < 200'000; ++i) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    Number number;
    ASSERT_TRUE(parses(text, number)) << text;
    ASSERT_TRUE(number.fits_f32) << text;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(static_cast<float>(number.value)),
              std::bit_cast<std::uint32_t>(value))
        << text;
  }
}

TEST(AppendNumber, ReadsBackToTheSameDouble) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    Number number;
    ASSERT_TRUE(parses(text, number)) << text;
    ASSERT_EQ(bits(number.value), bits(value)) << text;
  }
}

}  // namespace
}  // namespace pstrips::obj
