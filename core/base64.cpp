#include "core/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace pstrips::inline core {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> kValues = [] {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  return values;
}();

// Takes up to two signs of padding off; false when they do not fill the last four digits.
bool remove_padding(std::string_view& digits) {
  const bool is_filled = digits.size() % 4 == 0;
  for (int k = 0; k < 2 && digits.ends_with('='); ++k) digits.remove_suffix(1);
  return is_filled;
}

// The digits of one to three bytes.
std::array<char, 4> digits_of(ByteView bytes) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < 3; ++k)
    bits = bits << 8 | (k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[k]) : 0);
  std::array<char, 4> out;
  for (std::size_t k = 0; k < 4; ++k)
    out[k] = k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  return out;
}

}  // namespace

std::string base64(ByteView bytes) {
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto digits = digits_of(bytes.subspan(i, std::min<std::size_t>(3, bytes.size() - i)));
    out.append(digits.data(), digits.size());
  }
  return out;
}

std::optional<Bytes> parse_base64(std::string_view digits, Base64 form) {
  if (form == Base64::lenient)
    while (digits.ends_with('=')) digits.remove_suffix(1);
  else if (!remove_padding(digits))
    return std::nullopt;
  if (digits.size() % 4 == 1) return std::nullopt;
  Bytes out(digits.size() / 4 * 3 + digits.size() % 4 * 3 / 4);
  std::uint32_t bits = 0;
  unsigned held = 0;  // of `bits` that no byte has yet
  std::size_t n = 0;
  for (const char c : digits) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out[n++] = static_cast<std::byte>(bits >> held);
  }
  const bool is_cut_clean = (bits & ((1u << held) - 1)) == 0;
  if (form == Base64::strict && !is_cut_clean) return std::nullopt;
  return out;
}

}  // namespace pstrips::inline core
