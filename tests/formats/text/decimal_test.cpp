#include "formats/text/decimal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace pstrips {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Row {
  std::string_view text;
  double value;
};
const Row kRows[] = {
    {"0", 0},
    {"-1.5e3", -1500},
    {".5", 0.5},
    {"1e400", kInfinity},
    {"-1e400", -kInfinity},
    {"1e-400", 0},
    {"inf", kInfinity},
    {"-Infinity", -kInfinity},
    {"0.1000000000000000055511151231257827021181583404541015625", 0.1},
    {"9007199254740993", 9007199254740992},  // half way, to even
};

TEST(Decimals, AreRoundedOnceWhateverTheirLength) {
  for (const auto& [text, value] : kRows) {
    double read = 1;
    ASSERT_TRUE(parse_decimal(text, read)) << text;
    EXPECT_EQ(read, value) << text;
  }
  double nan = 0;
  ASSERT_TRUE(parse_decimal("NaN", nan));
  EXPECT_TRUE(std::isnan(nan));
  float single = 0;
  // Above the middle of two floats, but not as a double: rounding twice would give 1.
  ASSERT_TRUE(parse_decimal("1.00000005960464477540", single));
  EXPECT_EQ(single, std::nextafter(1.0f, 2.0f));
}

TEST(Decimals, AreWholeTokens) {
  double value = 0;
  for (const std::string_view text : {"", "-", "+1", ".", "1 ", " 1", "1e", "0x10", "1.2.3", "1,5"})
    EXPECT_FALSE(parse_decimal(text, value)) << text;
}

}  // namespace
}  // namespace pstrips
