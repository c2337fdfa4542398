#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

#include "core/bytes.h"
#include "core/mesh.h"

namespace pstrips::inline formats {

// Numbers as the XML and the text variant write them: decimals that read back to the same bits,
// as short as they can be. [spec/xml.md §3]

/// Appends characters and numbers to a growing file.
class TextWriter {
 public:
  void text(std::string_view v) {
    const ByteView bytes = as_bytes(v);
    out_.insert(out_.end(), bytes.begin(), bytes.end());
  }
  void character(char c) { out_.push_back(static_cast<std::byte>(c)); }
  void integer(std::uint64_t v) { number(v); }
  void integer(std::int64_t v) { number(v); }
  void integer(std::uint32_t v) { number(v); }

  /// Shortest round-trip decimal; INF, -INF, NaN; other NaNs than the default quiet one as
  /// `nan:0x` and their bits.
  void real(float v);
  void real(double v);
  /// The component of type `type` stored at `at`.
  void component(ComponentType type, const std::byte* at);
  /// The components of one element, parted by spaces.
  void element(const Attribute& format, ByteView element);

  std::size_t size() const { return out_.size(); }
  Bytes take() && { return std::move(out_); }

 private:
  template <class T>
  void number(T v) {
    char digits[40];  // a double takes 24, a nan:0x… 22
    const auto end = std::to_chars(digits, digits + sizeof digits, v).ptr;
    text({digits, static_cast<std::size_t>(end - digits)});
  }
  template <class T>
  void real_number(T v);

  Bytes out_;
};

/// Reads one token, all of it. False when it is no number of that type or out of its range.
bool parse_number(std::string_view token, std::uint32_t& out);
bool parse_number(std::string_view token, std::int64_t& out);
bool parse_number(std::string_view token, float& out);
bool parse_number(std::string_view token, double& out);
/// Stores the component at `at`, which has room for size_of(type) bytes.
bool parse_component(std::string_view token, ComponentType type, std::byte* at);

/// White space as XML has it.
constexpr bool is_xml_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Tokens of a text, parted by white space.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : rest_(text) { skip_space(); }
  bool at_end() const { return rest_.empty(); }
  std::string_view next() {
    std::size_t n = 0;
    while (n < rest_.size() && !is_xml_space(rest_[n])) ++n;
    const std::string_view token = rest_.substr(0, n);
    rest_.remove_prefix(n);
    skip_space();
    return token;
  }
  /// An upper bound of the tokens left, to be checked before a count sizes an allocation.
  std::size_t max_left() const { return (rest_.size() + 1) / 2; }

 private:
  void skip_space() {
    std::size_t n = 0;
    while (n < rest_.size() && is_xml_space(rest_[n])) ++n;
    rest_.remove_prefix(n);
  }
  std::string_view rest_;
};

}  // namespace pstrips::inline formats
