#include "formats/ply/ply_numbers.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/text.h"
#include "formats/text/decimal.h"

namespace pstrips::inline formats::ply {
namespace {

template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

template <class T>
constexpr BitsOf<T> kMantissaMask = (BitsOf<T>{1} << (std::numeric_limits<T>::digits - 1)) - 1;
template <class T>
constexpr BitsOf<T> kSignBit = BitsOf<T>{1} << (sizeof(T) * 8 - 1);
template <class T>
constexpr BitsOf<T> kQuietBit = (kMantissaMask<T> + 1) >> 1;
template <class T>
constexpr BitsOf<T> kInfinity = static_cast<BitsOf<T>>(~kSignBit<T> & ~kMantissaMask<T>);

/// The magnitude's bits of "inf", "nan", "nan(0x…)" and what Microsoft's library once printed.
template <class T>
std::optional<BitsOf<T>> not_finite(std::string_view token) {
  // Longer ones are none of these; the cap keeps a huge token from being copied.
  if (token.size() > kMaxNumberChars) return std::nullopt;
  const std::string word = lower_case(token);
  if (word == "inf" || word == "infinity" || word == "1.#inf") return kInfinity<T>;
  if (word == "nan" || word == "1.#qnan" || word == "1.#ind" || word == "1.#snan")
    return kInfinity<T> | kQuietBit<T>;
  if (!word.starts_with("nan(0x") || !word.ends_with(')')) return std::nullopt;
  BitsOf<T> payload = 0;
  const char* const last = word.data() + word.size() - 1;
  const auto [end, failed] = std::from_chars(word.data() + 6, last, payload, 16);
  if (failed != std::errc{} || end != last || payload == 0 || payload > kMantissaMask<T>)
    return std::nullopt;
  return kInfinity<T> | payload;
}

template <class T>
bool parse_real(std::string_view token, T& value) {
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  if (token.empty()) return false;
  if (token[0] != '.' && (token[0] < '0' || token[0] > '9')) {
    const auto bits = not_finite<T>(token);
    if (!bits) return false;
    value = std::bit_cast<T>(*bits | (negative ? kSignBit<T> : BitsOf<T>{0}));
    return true;
  }
  if (!parse_decimal(token, value)) {
    const auto bits = not_finite<T>(token);  // 1.#INF
    if (!bits) return false;
    value = std::bit_cast<T>(*bits);
  } else if (std::isinf(value)) {
    return false;  // digits that overflow the type
  }
  if (negative) value = std::bit_cast<T>(std::bit_cast<BitsOf<T>>(value) | kSignBit<T>);
  return true;
}

template <class T>
char* format_real(char* at, T value) {
  if (!std::isnan(value)) return std::to_chars(at, at + kMaxNumberChars - 1, value).ptr;
  const auto bits = std::bit_cast<BitsOf<T>>(value);
  if ((bits & kSignBit<T>) != 0) *at++ = '-';
  at = std::copy_n("nan", 3, at);
  const BitsOf<T> payload = bits & kMantissaMask<T>;
  if (payload == kQuietBit<T>) return at;
  at = std::copy_n("(0x", 3, at);
  at = std::to_chars(at, at + 16, payload, 16).ptr;
  *at++ = ')';
  return at;
}

}  // namespace

template <class T>
bool parse_token(std::string_view token, T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    return parse_real(token, value);
  } else {
    double real;
    if (!parse_real(token, real) || !(real >= std::numeric_limits<T>::min()) ||
        !(real <= std::numeric_limits<T>::max()) || real != std::floor(real))
      return false;
    value = static_cast<T>(real);
    return true;
  }
}

bool may_start_number(std::string_view token) {
  if (token.empty()) return true;
  double ignored;
  // A digit more mends "-", "1e" and "1e-"; "1." and "1e5" are numbers already.
  if (token.size() <= 1000 && parse_real(std::string(token) + '0', ignored)) return true;
  if (token[0] == '-' || token[0] == '+') token.remove_prefix(1);
  if (token.size() > kMaxNumberChars) return false;
  const std::string word = lower_case(token);
  constexpr std::string_view kWords[] = {"inf",     "infinity", "nan(0x", "1.#inf",
                                         "1.#qnan", "1.#ind",   "1.#snan"};
  if (std::ranges::any_of(kWords, [&](std::string_view w) { return w.starts_with(word); }))
    return true;
  return word.starts_with("nan(0x") && not_finite<double>(word + "1)");
}

template <class T>
char* format_number(char* at, T value) {
  if constexpr (std::is_floating_point_v<T>) {
    return format_real(at, value);
  } else {
    return std::to_chars(at, at + kMaxNumberChars - 1, value).ptr;
  }
}

#define PSTRIP_PLY_NUMBER(T)                          \
  template bool parse_token<T>(std::string_view, T&); \
  template char* format_number<T>(char*, T);
PSTRIP_PLY_NUMBER(std::int8_t)
PSTRIP_PLY_NUMBER(std::uint8_t)
PSTRIP_PLY_NUMBER(std::int16_t)
PSTRIP_PLY_NUMBER(std::uint16_t)
PSTRIP_PLY_NUMBER(std::int32_t)
PSTRIP_PLY_NUMBER(std::uint32_t)
PSTRIP_PLY_NUMBER(float)
PSTRIP_PLY_NUMBER(double)
#undef PSTRIP_PLY_NUMBER

}  // namespace pstrips::inline formats::ply
