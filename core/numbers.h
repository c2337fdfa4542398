#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace pstrips::inline core {

/// White space as text files have it, line ends included.
constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

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

}  // namespace pstrips::inline core
