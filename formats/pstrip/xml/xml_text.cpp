#include "formats/pstrip/xml/xml_text.h"

#include <algorithm>
#include <array>

namespace pstrips::inline formats {
namespace {

constexpr char kHexDigits[] = "0123456789abcdef";

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// Bytes that the first byte of a UTF-8 sequence announces; 0 for one that cannot be first.
std::size_t announced_bytes(unsigned first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  if (first >= 0xf0 && first < 0xf5) return 4;
  return 0;
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

constexpr char kBase64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> kBase64Values = [] {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (int i = 0; i < 64; ++i)
    values[static_cast<unsigned char>(kBase64[i])] = static_cast<std::int8_t>(i);
  return values;
}();

}  // namespace

std::size_t character_bytes(std::string_view text) {
  if (text.empty()) return 0;
  const unsigned first = byte_at(text, 0);
  if (first < 0x80) return first >= 0x20 || is_xml_space(text[0]) ? 1 : 0;
  const std::size_t size = announced_bytes(first);
  if (size == 0 || text.size() < size) return 0;
  unsigned code = first & (0xffu >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte_at(text, i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte_at(text, i) & 0x3f);
  }
  constexpr unsigned kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kSmallest[size] || code > 0x10ffff || surrogate || (code & ~1u) == 0xfffe) return 0;
  return size;
}

bool is_cut_character(std::string_view text) {
  if (text.empty() || announced_bytes(byte_at(text, 0)) <= text.size()) return false;
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

void write_base64(TextWriter& out, ByteView bytes) {
  constexpr std::size_t kLineBytes = 57;  // 76 characters
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    if (i > 0 && i % kLineBytes == 0) out.character('\n');
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned v = 0;
    for (std::size_t k = 0; k < 3; ++k)
      v = v << 8 | (k < n ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
    char quad[4] = {kBase64[v >> 18], kBase64[v >> 12 & 63], kBase64[v >> 6 & 63], kBase64[v & 63]};
    for (std::size_t k = n + 1; k < 4; ++k) quad[k] = '=';
    out.text({quad, 4});
  }
}

std::optional<Bytes> parse_base64(std::string_view text) {
  Bytes out;
  out.reserve(text.size() / 4 * 3);
  unsigned value = 0;
  int digits = 0, padding = 0;
  bool ended = false;
  for (const char c : text) {
    if (is_xml_space(c)) continue;
    if (ended) return std::nullopt;
    const int v = kBase64Values[static_cast<unsigned char>(c)];
    if (c == '=') {
      ++padding;
    } else if (v < 0 || padding > 0) {
      return std::nullopt;
    }
    value = value << 6 | static_cast<unsigned>(std::max(v, 0));
    if (++digits < 4) continue;
    if (padding > 2) return std::nullopt;
    for (int k = 0; k < 3 - padding; ++k)
      out.push_back(static_cast<std::byte>(value >> (16 - 8 * k) & 0xff));
    // Bits that padding cuts off must be zero: each value is written in one way only.
    if (padding > 0 && (value & ((1u << (8 * padding)) - 1)) != 0) return std::nullopt;
    value = 0;
    digits = 0;
    ended = padding > 0;
  }
  if (digits != 0) return std::nullopt;
  return out;
}

}  // namespace pstrips::inline formats
