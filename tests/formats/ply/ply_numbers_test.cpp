#include "formats/ply/ply_numbers.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace pstrips::ply {
namespace {

template <class T>
T parsed(const std::string& text) {
  T value{};
  const char* at = text.data();
  RC_ASSERT(parse_number(at, text.data() + text.size(), value));
  RC_ASSERT(at == text.data() + text.size());
  return value;
}

/// The C library's answer, correctly rounded too.
void check_reals(const std::string& text) {
  const float f = std::strtof(text.c_str(), nullptr);
  const double d = std::strtod(text.c_str(), nullptr);
  if (!std::isinf(f))
    RC_ASSERT(std::bit_cast<std::uint32_t>(parsed<float>(text)) == std::bit_cast<std::uint32_t>(f));
  RC_ASSERT(std::bit_cast<std::uint64_t>(parsed<double>(text)) == std::bit_cast<std::uint64_t>(d));
}

std::string decimal(double value, const char* format, int digits) {
  char text[400];
  return std::string(
      text, static_cast<std::size_t>(std::snprintf(text, sizeof text, format, digits, value)));
}

RC_GTEST_PROP(PlyNumbers, RoundAsTheCLibraryDoes, ()) {
  const auto bits = *rc::gen::arbitrary<std::uint32_t>();
  const auto value = std::bit_cast<float>(bits);
  RC_PRE(std::isfinite(value));
  const double near_one = std::ldexp(static_cast<double>(bits), -16);
  for (const int digits : {0, 3, 6, 9, 17}) {
    check_reals(decimal(value, "%.*g", digits));
    check_reals(decimal(near_one, "%.*f", digits));
    check_reals(decimal(-near_one, "%.*e", digits));
  }
}

/// Decimals that lie on or right beside the middle of two floats, where rounding twice goes wrong.
RC_GTEST_PROP(PlyNumbers, RoundOnceBetweenTwoFloats, (std::uint32_t mantissa)) {
  const float low = static_cast<float>(mantissa % (1u << 23) + (1u << 23));
  const std::string middle = decimal(static_cast<double>(low) + 0.5, "%.*f", 1);
  check_reals(middle);
  check_reals(middle + "0000001");
  check_reals(decimal(static_cast<double>(low), "%.*f", 0) + ".4999999");
  check_reals(middle + "00000000000000000000001");
}

RC_GTEST_PROP(PlyNumbers, FormatAndParseAreInverse, ()) {
  char text[kMaxNumberChars];
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  const auto d = std::bit_cast<double>(bits);
  const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
  const char* end = format_number(text, d);
  RC_ASSERT(end < text + kMaxNumberChars);
  RC_ASSERT(std::bit_cast<std::uint64_t>(parsed<double>({text, format_number(text, d)})) == bits);
  RC_ASSERT(std::bit_cast<std::uint32_t>(parsed<float>({text, format_number(text, f)})) ==
            bits >> 32);
  const auto i = static_cast<std::int32_t>(bits);
  RC_ASSERT(parsed<std::int32_t>({text, format_number(text, i)}) == i);
}

TEST(PlyNumbers, TakesTheExtremes) {
  const char* const texts[] = {"0",
                               "-0",
                               "1e-400",
                               "-1e-46",
                               "1.17549435e-38",
                               "1e-38",
                               "4.9e-324",
                               "3.4028235e38",
                               "1.7976931348623157e308",
                               "9007199254740993",
                               "16777217",
                               "0.1",
                               ".5",
                               "5.",
                               "+7",
                               "00000000000000000000000001",
                               "1E5",
                               "0.000000000000000000000000000000000000011754943",
                               "33554431.000000001"};
  for (const char* text : texts) check_reals(text);
}

TEST(PlyNumbers, RefusesWhatIsNone) {
  for (const char* text : {"",        "-",        "+",       ".",     "e5",     "1e",   "1e+",
                           "0x10",    "1,5",      "1.5f",    "--1",   "+-1",    "nano", "nan(",
                           "nan(0x)", "nan(0x0)", "infinit", "1e400", "-1e400", "1.#",  "1..5"}) {
    const std::string token(text);
    double value = 0;
    const char* at = token.data();
    EXPECT_FALSE(parse_number(at, token.data() + token.size(), value)) << text;
  }
}

}  // namespace
}  // namespace pstrips::ply
