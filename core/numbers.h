#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "core/text.h"

namespace pstrips::inline core {

/// Reads all of `token` as a number: decimals correctly rounded, "inf" and "nan" in any case, whole
/// numbers without a point. False when it is no number or not in the range of T, which for floats
/// has a lower end, too.
template <class T>
bool parse_number(std::string_view token, T& value) {
  const char* begin = token.data();
  const char* const end = begin + token.size();
  if (token.starts_with('+') && !token.starts_with("+-")) ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end;
}

/// Powers of ten that are exact in a double.
inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// What most numbers in text files are: few digits, a point among them, no exponent.
struct ShortDecimal {
  std::uint64_t mantissa = 0;  ///< < 2^53, so exact in a double
  std::uint32_t decimals = 0;  ///< <= 19
  bool is_negative = false;

  /// Correctly rounded, as a quotient of two exact doubles is. [Clinger90]
  double magnitude() const { return static_cast<double>(mantissa) / kPowersOfTen[decimals]; }
};

/// Moves `p` behind the digits there and appends them to `number`, which wraps beyond 64 bits;
/// returns how many they are.
inline std::uint32_t read_digits(const char*& p, const char* end, std::uint64_t& number) {
  const char* const begin = p;
  for (; p != end && static_cast<unsigned char>(*p - '0') < 10; ++p)
    number = 10 * number + static_cast<unsigned char>(*p - '0');
  return static_cast<std::uint32_t>(p - begin);
}

/// Reads the number that begins at `p` and ends at white space or `end`. Returns one past it; null
/// when it is longer than that or anything else.
inline const char* read_short_decimal(const char* p, const char* end, ShortDecimal& out) {
  out = {.is_negative = p != end && *p == '-'};
  p += out.is_negative;
  std::uint32_t digits = read_digits(p, end, out.mantissa);
  if (p != end && *p == '.') {
    ++p;
    out.decimals = read_digits(p, end, out.mantissa);
    digits += out.decimals;
  }
  constexpr std::uint32_t kMaxDigits = 19;  // no 64 bits overflow
  const bool is_short =
      digits != 0 && digits <= kMaxDigits && out.mantissa < (std::uint64_t{1} << 53);
  return is_short && (p == end || is_space(*p)) ? p : nullptr;
}

}  // namespace pstrips::inline core
