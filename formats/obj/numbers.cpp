#include "formats/obj/numbers.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string_view>

#include "core/numbers.h"
#include "formats/text/decimal.h"

namespace pstrips::inline formats::obj {
namespace {

constexpr int kExactPower = std::size(kPowersOfTen) - 1;

double scaled(std::uint64_t m, int exponent) {
  const auto value = static_cast<double>(m);
  return exponent < 0 ? value / kPowersOfTen[-exponent] : value * kPowersOfTen[exponent];
}

/// A double half way between two floats: the decimal it stands for may lie on either side.
bool is_tie(double value) {
  return (std::bit_cast<std::uint64_t>(value) & 0x1fff'ffff) == 0x1000'0000;
}

/// fits_f32 for m·10^exponent, most often without printing. Six digits always survive a float.
/// Seven to nine do when the decimals next to them belong to other floats.
bool decimal_fits_f32(std::uint64_t m, int exponent, double magnitude) {
  constexpr std::uint64_t kSixDigits = 1'000'000, kNineDigits = 1'000'000'000;
  if (m == 0) return true;
  while (m >= kSixDigits && m % 10 == 0) {
    m /= 10;
    ++exponent;
  }
  // Well inside the normal floats; larger integers may print with all their digits.
  constexpr double kSmallest = 1e-37, kLargest = 1 << 24;
  if (magnitude < kSmallest || magnitude > kLargest) return fits_f32(magnitude);
  if (m < kSixDigits) return true;
  if (m >= kNineDigits || exponent > kExactPower) return fits_f32(magnitude);
  const double lower = scaled(m - 1, exponent), upper = scaled(m + 1, exponent);
  if (is_tie(lower) || is_tie(upper) || is_tie(magnitude)) return fits_f32(magnitude);
  const auto nearest = static_cast<float>(magnitude);
  if (static_cast<float>(lower) != nearest && static_cast<float>(upper) != nearest) return true;
  return fits_f32(magnitude);
}

/// What the C runtime of Visual Studio before 2015 printed for NaN and infinity.
bool parse_msvc_special(std::string_view token, double& value) {
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  if (!token.starts_with("1.#")) return false;
  token.remove_prefix(3);
  while (token.ends_with('0')) token.remove_suffix(1);
  if (token == "INF")
    value = std::numeric_limits<double>::infinity();
  else if (token == "IND" || token == "QNAN" || token == "SNAN")
    value = std::numeric_limits<double>::quiet_NaN();
  else
    return false;
  value = std::copysign(value, negative ? -1 : 1);
  return true;
}

const char* parse_any_number(const char* p, const char* end, Number& out) {
  const char* stop = p;
  while (stop != end && !is_space(*stop)) ++stop;
  const std::string_view token(p, static_cast<std::size_t>(stop - p));
  const bool plus = token.starts_with('+');
  const bool whole =
      parse_decimal(token.substr(plus ? 1 : 0), out.value) && !token.starts_with("+-");
  if (!whole && !parse_msvc_special(token, out.value)) return nullptr;
  const bool says_so = token.find_first_of("nN") != token.npos;  // inf, nan, 1.#INF …
  if (!std::isfinite(out.value) && !says_so) return nullptr;
  out.fits_f32 = fits_f32(out.value);
  return stop;
}

template <class T>
void append_shortest(std::string& out, T value) {
  char text[32];  // -1.7976931348623157e+308 has 24 characters
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  out.append(text, end);
}

}  // namespace

bool fits_f32(double value) {
  constexpr double kRoundsToLargest = 3.40282356e38;  // the shortest FLT_MAX is below
  if (!std::isfinite(value)) return true;
  if (std::abs(value) > kRoundsToLargest) return false;
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), static_cast<float>(value)).ptr;
  double again = 0;
  parse_decimal({text, end}, again);
  return std::bit_cast<std::uint64_t>(again) == std::bit_cast<std::uint64_t>(value);
}

const char* parse_number(const char* p, const char* end, Number& out) {
  ShortDecimal decimal;
  const char* const stop = read_short_decimal(p, end, decimal);
  if (!stop) return parse_any_number(p, end, out);
  const double magnitude = decimal.magnitude();
  out.value = decimal.is_negative ? -magnitude : magnitude;
  out.fits_f32 = decimal_fits_f32(decimal.mantissa, -static_cast<int>(decimal.decimals), magnitude);
  return stop;
}

void append_number(std::string& out, float value) { append_shortest(out, value); }
void append_number(std::string& out, double value) { append_shortest(out, value); }

bool turns_in_f32(float value) {
  const auto turned = static_cast<float>(1 - static_cast<double>(value));
  return !std::isfinite(value) || static_cast<float>(1 - static_cast<double>(turned)) == value;
}

void append_turned(std::string& out, float value, bool in_f32) {
  const double turned = 1 - static_cast<double>(value);
  if (!std::isfinite(turned)) return append_shortest(out, turned);
  char text[32];
  const auto with_digits = [&](int digits) -> std::string_view {
    const auto end =
        std::to_chars(std::begin(text), std::end(text), turned, std::chars_format::general, digits)
            .ptr;
    return {text, end};
  };
  const auto read = [&](std::string_view decimal) {
    double number = 0;
    parse_decimal(decimal, number);
    return in_f32 ? static_cast<double>(static_cast<float>(number)) : number;
  };
  int least = 1, most = std::numeric_limits<double>::max_digits10;
  while (least < most) {
    const int middle = (least + most) / 2;
    if (static_cast<float>(1 - read(with_digits(middle))) == value)
      most = middle;
    else
      least = middle + 1;
  }
  const double number = read(with_digits(most));
  if (in_f32)
    append_shortest(out, static_cast<float>(number));
  else
    append_shortest(out, number);
}

void append_turned(std::string& out, double value) { append_shortest(out, 1 - value); }

}  // namespace pstrips::inline formats::obj
