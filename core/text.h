#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pstrips::inline core {

/// Bytes of a UTF-8 character by its first one; 0 when none begins so.
constexpr std::size_t utf8_length_announced(char first) {
  const auto byte = static_cast<unsigned char>(first);
  if (byte < 0x80) return 1;
  if (byte < 0xc2 || byte > 0xf4) return 0;
  return byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : 2;
}

/// Bytes of the UTF-8 character that the text begins with: in the shortest form, no surrogate, at
/// most U+10FFFF. 0 when there is none, so for an empty text, too. [RFC3629 §4]
std::size_t utf8_length(std::string_view text);

/// Where the text stops being UTF-8; its size when it never does.
std::size_t first_not_utf8(std::string_view text);

inline bool is_utf8(std::string_view text) { return first_not_utf8(text) == text.size(); }

/// White space as text files have it, line ends included.
constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The text without white space at both ends.
constexpr std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// The text without the byte order mark that some programs put in front of UTF-8.
constexpr std::string_view without_utf8_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

/// ASCII letters in lower case, all else as it is.
std::string lower_case(std::string_view text);

}  // namespace pstrips::inline core
