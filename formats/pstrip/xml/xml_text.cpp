#include "formats/pstrip/xml/xml_text.h"

#include <algorithm>
#include <iterator>

#include "core/base64.h"
#include "core/text.h"

namespace pstrips::inline formats {
namespace {

constexpr char kHexDigits[] = "0123456789abcdef";

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// Appends the entity for a character that is markup.
bool write_entity(TextWriter& out, char c) {
  switch (c) {
    case '&':
      out.text("&amp;");
      return true;
    case '<':
      out.text("&lt;");
      return true;
    case '>':
      out.text("&gt;");
      return true;
    case '"':
      out.text("&quot;");
      return true;
    default:
      return false;
  }
}

void write_escaped_byte(TextWriter& out, char c) {
  const auto v = static_cast<unsigned char>(c);
  const char digits[] = {'\\', 'x', kHexDigits[v >> 4], kHexDigits[v & 15]};
  out.text({digits, sizeof digits});
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::size_t character_bytes(std::string_view text) {
  if (text.empty()) return 0;
  const unsigned first = byte_at(text, 0);
  if (first < 0x80) return first >= 0x20 || is_xml_space(text[0]) ? 1 : 0;
  const bool is_no_character = text.starts_with("\xef\xbf\xbe") || text.starts_with("\xef\xbf\xbf");
  return is_no_character ? 0 : utf8_length(text);
}

bool is_cut_character(std::string_view text) {
  if (text.empty() || utf8_length_announced(text[0]) <= text.size()) return false;
  return std::ranges::all_of(text.substr(1), [](char c) { return (c & 0xc0) == 0x80; });
}

void write_string(TextWriter& out, std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = character_bytes(text.substr(i));
    const char c = text[i];
    if (n == 0 || (n == 1 && static_cast<unsigned char>(c) < 0x20))
      write_escaped_byte(out, c);
    else if (c == '\\')
      out.text("\\\\");
    else if (!write_entity(out, c))
      out.text(text.substr(i, n));
    i += std::max<std::size_t>(n, 1);
  }
}

std::optional<std::string> unescape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '\\') {
      out.push_back(text[i++]);
      continue;
    }
    const std::string_view rest = text.substr(i + 1);
    if (rest.starts_with('\\')) {
      out.push_back('\\');
      i += 2;
      continue;
    }
    if (rest.size() < 3 || rest[0] != 'x') return std::nullopt;
    const int high = hex_value(rest[1]), low = hex_value(rest[2]);
    if (high < 0 || low < 0) return std::nullopt;
    out.push_back(static_cast<char>(high << 4 | low));
    i += 4;
  }
  return out;
}

bool fits_content(ByteView bytes) {
  const std::string_view text = as_text(bytes);
  bool all_space = true;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = character_bytes(text.substr(i));
    if (n == 0 || text[i] == '\r') return false;
    all_space = all_space && is_xml_space(text[i]);
    i += n;
  }
  return !all_space;
}

void write_content(TextWriter& out, ByteView bytes) {
  for (const char c : as_text(bytes))
    if (!write_entity(out, c)) out.character(c);
}

void write_base64_lines(TextWriter& out, ByteView bytes) {
  constexpr std::size_t kLineBytes = 57;  // 76 characters
  for (std::size_t i = 0; i < bytes.size(); i += kLineBytes) {
    if (i > 0) out.character('\n');
    out.text(base64(bytes.subspan(i, std::min(kLineBytes, bytes.size() - i))));
  }
}

std::optional<Bytes> parse_base64_lines(std::string_view text) {
  std::string digits;
  digits.reserve(text.size());
  std::ranges::copy_if(text, std::back_inserter(digits), [](char c) { return !is_xml_space(c); });
  return parse_base64(digits);
}

}  // namespace pstrips::inline formats
