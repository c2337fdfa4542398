#pragma once

#include <string>
#include <string_view>

namespace pstrips::inline core {

/// The text without the byte order mark that some programs put in front of UTF-8.
constexpr std::string_view without_utf8_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

/// ASCII letters to lower case, all else as it is.
inline std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace pstrips::inline core
