#pragma once

#include <cstring>
#include <string_view>

#include "core/mesh.h"
#include "core/numbers.h"

namespace pstrips::inline formats::ply {

/// Bytes that the longest number takes in ascii, a separator included.
inline constexpr std::size_t kMaxNumberChars = 40;

constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

template <class T>
void store(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
}
template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Calls f with a value of the C++ type that `type` names.
template <class F>
decltype(auto) visit_type(ComponentType type, F&& f) {
  switch (type) {
    case ComponentType::i8:
      return f(std::int8_t{});
    case ComponentType::u8:
      return f(std::uint8_t{});
    case ComponentType::i16:
      return f(std::int16_t{});
    case ComponentType::u16:
      return f(std::uint16_t{});
    case ComponentType::i32:
      return f(std::int32_t{});
    case ComponentType::u32:
      return f(std::uint32_t{});
    case ComponentType::f32:
      return f(float{});
    case ComponentType::f64:
      return f(double{});
  }
  return f(double{});
}

/// Reads a whole token as a number, correctly rounded; for integer types also "3.0" and "1e2".
/// False when it is no number or does not fit the type (floats that underflow do).
template <class T>
bool parse_token(std::string_view token, T& value);

/// Whether `token`, which ends at the end of a cut file, could be the start of a number.
bool may_start_number(std::string_view token);

/// Reads the number at `at`, at its first character, and moves behind it; the next character is a
/// space or the end. The usual short decimals take this inline road, all others parse_token.
template <class T>
bool parse_number(const char*& at, const char* end, T& value);

/// Writes the shortest text that parse_token turns into the same bits; returns its end.
/// At most kMaxNumberChars - 1 characters.
template <class T>
char* format_number(char* at, T value);

namespace detail {

/// A correctly rounded double as a T. Rounding it once more to a float is right unless it fell
/// exactly between two floats or below the normal ones.
inline bool narrow(double exact_once, double& out) {
  out = exact_once;
  return true;
}
inline bool narrow(double exact_once, float& out) {
  constexpr std::uint64_t kDropped = (std::uint64_t{1} << 29) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(exact_once);
  out = static_cast<float>(exact_once);
  return (bits & kDropped) != (kDropped + 1) / 2 && (exact_once >= 1.2e-38 || exact_once == 0);
}

template <class T>
bool parse_slowly(const char*& at, const char* end, T& value) {
  const char* stop = at;
  while (stop != end && !is_space(*stop)) ++stop;
  if (!parse_token(std::string_view(at, stop), value)) return false;
  at = stop;
  return true;
}

}  // namespace detail

template <class T>
bool parse_number(const char*& at, const char* end, T& value) {
  const char* stop = at;
  if constexpr (std::is_integral_v<T>) {
    const bool negative = stop != end && *stop == '-';
    stop += negative;
    std::uint64_t magnitude = 0;
    // Ten digits hold every 32-bit number.
    const std::uint32_t digits = read_digits(stop, end, magnitude);
    const bool plain = digits != 0 && digits <= 10 && (stop == end || is_space(*stop));
    if (!plain) return detail::parse_slowly(at, end, value);
    const auto wide =
        negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
    if (wide < std::numeric_limits<T>::min() || wide > std::numeric_limits<T>::max()) return false;
    value = static_cast<T>(wide);
  } else {
    ShortDecimal decimal;
    stop = read_short_decimal(at, end, decimal);
    T positive;
    if (!stop || !detail::narrow(decimal.magnitude(), positive))
      return detail::parse_slowly(at, end, value);
    value = decimal.is_negative ? -positive : positive;
  }
  at = stop;
  return true;
}

}  // namespace pstrips::inline formats::ply
