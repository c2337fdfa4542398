#include "formats/pstrip/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pstrips::inline formats {
namespace {

template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

/// The NaN that "NaN" stands for: quiet, positive, no payload.
template <class T>
constexpr BitsOf<T> kDefaultNan = std::bit_cast<BitsOf<T>>(std::numeric_limits<T>::infinity()) |
                                  (BitsOf<T>{1} << (std::numeric_limits<T>::digits - 2));

constexpr std::string_view kNanBits = "nan:0x";

template <class T>
bool parse_nan_bits(std::string_view digits, T& out) {
  if (digits.size() != 2 * sizeof(T)) return false;
  if (std::ranges::any_of(digits, [](char c) { return c >= 'A' && c <= 'F'; })) return false;
  BitsOf<T> bits{};
  const char* end = digits.data() + digits.size();
  const auto [at, error] = std::from_chars(digits.data(), end, bits, 16);
  if (error != std::errc{} || at != end) return false;
  out = std::bit_cast<T>(bits);
  return std::isnan(out);
}

template <class T>
bool parse_real(std::string_view token, T& out) {
  if (token.empty()) return false;
  // from_chars knows no plus sign, and more names of infinity and NaN than we do.
  const std::size_t sign = token[0] == '-' || token[0] == '+' ? 1 : 0;
  const char first = sign < token.size() ? token[sign] : '\0';
  if ((first >= '0' && first <= '9') || first == '.') {
    const char* end = token.data() + token.size();
    const char* begin = token.data() + (token[0] == '+' ? 1 : 0);
    const auto [at, error] = std::from_chars(begin, end, out);
    return error == std::errc{} && at == end;
  }
  if (token == "NaN") {
    out = std::bit_cast<T>(kDefaultNan<T>);
    return true;
  }
  if (token.substr(sign) == "INF") {
    out =
        token[0] == '-' ? -std::numeric_limits<T>::infinity() : std::numeric_limits<T>::infinity();
    return true;
  }
  return token.starts_with(kNanBits) && parse_nan_bits(token.substr(kNanBits.size()), out);
}

template <class T>
bool parse_integer(std::string_view token, T& out) {
  const char* end = token.data() + token.size();
  const auto [at, error] = std::from_chars(token.data(), end, out);
  return error == std::errc{} && at == end && !token.empty();
}

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <class T>
bool store_integer(std::string_view token, std::byte* at) {
  T value{};
  if (!parse_integer(token, value)) return false;
  std::memcpy(at, &value, sizeof value);
  return true;
}

template <class T>
bool store_real(std::string_view token, std::byte* at) {
  T value{};
  if (!parse_real(token, value)) return false;
  std::memcpy(at, &value, sizeof value);
  return true;
}

}  // namespace

template <class T>
void TextWriter::real_number(T v) {
  if (std::isfinite(v)) return number(v);
  if (std::isinf(v)) return text(v > 0 ? "INF" : "-INF");
  const auto bits = std::bit_cast<BitsOf<T>>(v);
  if (bits == kDefaultNan<T>) return text("NaN");
  text(kNanBits);
  // A NaN starts with the digit 7 or f, so there are no leading zeros to add.
  char digits[2 * sizeof(T)];
  std::to_chars(digits, digits + sizeof digits, bits, 16);
  text({digits, sizeof digits});
}

void TextWriter::real(float v) { real_number(v); }
void TextWriter::real(double v) { real_number(v); }

void TextWriter::component(ComponentType type, const std::byte* at) {
  switch (type) {
    case ComponentType::i8:
      return number(static_cast<int>(load<std::int8_t>(at)));
    case ComponentType::u8:
      return number(static_cast<unsigned>(load<std::uint8_t>(at)));
    case ComponentType::i16:
      return number(load<std::int16_t>(at));
    case ComponentType::u16:
      return number(load<std::uint16_t>(at));
    case ComponentType::i32:
      return number(load<std::int32_t>(at));
    case ComponentType::u32:
      return number(load<std::uint32_t>(at));
    case ComponentType::f32:
      return real(load<float>(at));
    case ComponentType::f64:
      return real(load<double>(at));
  }
}

void TextWriter::element(const Attribute& format, ByteView element) {
  const std::size_t size = size_of(format.type);
  for (std::size_t c = 0; c < format.count; ++c) {
    if (c > 0) character(' ');
    component(format.type, element.data() + c * size);
  }
}

bool parse_number(std::string_view token, std::uint32_t& out) { return parse_integer(token, out); }
bool parse_number(std::string_view token, std::int64_t& out) { return parse_integer(token, out); }
bool parse_number(std::string_view token, float& out) { return parse_real(token, out); }
bool parse_number(std::string_view token, double& out) { return parse_real(token, out); }

bool parse_component(std::string_view token, ComponentType type, std::byte* at) {
  switch (type) {
    case ComponentType::i8:
      return store_integer<std::int8_t>(token, at);
    case ComponentType::u8:
      return store_integer<std::uint8_t>(token, at);
    case ComponentType::i16:
      return store_integer<std::int16_t>(token, at);
    case ComponentType::u16:
      return store_integer<std::uint16_t>(token, at);
    case ComponentType::i32:
      return store_integer<std::int32_t>(token, at);
    case ComponentType::u32:
      return store_integer<std::uint32_t>(token, at);
    case ComponentType::f32:
      return store_real<float>(token, at);
    case ComponentType::f64:
      return store_real<double>(token, at);
  }
  return false;
}

}  // namespace pstrips::inline formats
