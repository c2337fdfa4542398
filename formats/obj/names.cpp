#include "formats/obj/names.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "core/text.h"
#include "formats/obj/numbers.h"
#include "formats/obj/obj.h"

namespace pstrips::inline formats::obj {
namespace {

/// What no escape of a name begins with: the number of an object among those of its name follows.
constexpr std::string_view kInstance = "%n";

bool ends_in_mtl(std::string_view word) {
  constexpr std::size_t kLength = 4;
  return word.size() >= kLength && lower_case(word.substr(word.size() - kLength)) == ".mtl";
}

}  // namespace

std::string_view next_word(std::string_view& text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  const auto end = static_cast<std::size_t>(std::ranges::find_if(text, is_space) - text.begin());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

std::string clean_name(std::string_view text) {
  const bool utf8 = is_utf8(text);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<std::uint8_t>(c);
    if (byte < 0x20 || byte == 0x7f) {
      out += ' ';
    } else if (byte < 0x80 || utf8) {
      out += c;
    } else {
      out += static_cast<char>(0xc0 | byte >> 6);
      out += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return std::string(trimmed(out));
}

std::string clean_group(std::string_view text) {
  const std::string clean = clean_name(text);
  std::string_view rest = clean;
  std::string out;
  for (auto word = next_word(rest); !word.empty(); word = next_word(rest)) {
    if (!out.empty()) out += ' ';
    out += word;
  }
  return out;
}

std::optional<std::string> companion_path(std::string_view written, bool may_climb) {
  std::string path;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const char c = written[i];
    if (static_cast<std::uint8_t>(c) < 0x20 || c == ':') return std::nullopt;
    if (c == '\\' && i + 1 < written.size() && written[i + 1] == ' ') continue;
    path += c == '\\' ? '/' : c;
  }
  if (path.starts_with('/')) return std::nullopt;
  std::string out;
  for (std::string_view rest = path; !rest.empty();) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view part = rest.substr(0, slash);
    rest.remove_prefix(std::min(slash + 1, rest.size()));
    if (part == ".." && !may_climb) return std::nullopt;
    if (part.empty() || part == ".") continue;
    if (!out.empty()) out += '/';
    out += part;
  }
  if (out.empty()) return std::nullopt;
  return out;
}

std::vector<std::string_view> split_mtllib(std::string_view text) {
  std::vector<std::string_view> names;
  text = trimmed(text);
  for (std::size_t begin = 0, at = 0; at < text.size();) {
    while (at < text.size() && (!is_space(text[at]) || text[at - 1] == '\\')) ++at;
    const std::string_view name = text.substr(begin, at - begin);
    while (at < text.size() && is_space(text[at])) ++at;
    if (!ends_in_mtl(name) && at < text.size()) continue;
    names.push_back(name);
    begin = at;
  }
  return names;
}

GroupName split_group_name(std::string_view name) {
  GroupName out;
  const std::size_t slash = name.find('/');
  if (slash == name.npos) {
    out.group = name;
    return out;
  }
  out.group = name.substr(slash + 1);
  for (std::string_view rest = name.substr(0, slash); !rest.empty();) {
    if (rest.starts_with(kInstance)) {
      std::from_chars(rest.data() + kInstance.size(), rest.data() + rest.size(), out.instance);
      break;
    }
    const std::string_view escape = rest.substr(0, 3);
    const bool escaped = escape == "%2F" || escape == "%25";
    out.object += escape == "%2F" ? '/' : rest.front();
    rest.remove_prefix(escaped ? 3 : 1);
  }
  return out;
}

}  // namespace pstrips::inline formats::obj

namespace pstrips::inline formats {

std::string obj_group_name(std::string_view object, std::string_view group, Index instance) {
  std::string out;
  for (const char c : object) {
    if (c == '/')
      out += "%2F";
    else if (c == '%')
      out += "%25";
    else
      out += c;
  }
  if (instance > 1) out.append(obj::kInstance) += std::to_string(instance);
  if (!out.empty() || group.find('/') != group.npos) out += '/';
  return out.append(group);
}

}  // namespace pstrips::inline formats
