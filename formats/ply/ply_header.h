#pragma once

#include <string>
#include <vector>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/result.h"

namespace pstrips::inline formats::ply {

enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

struct Property {
  std::vector<std::string> remarks;  ///< header lines before this one that are not ours to read
  std::string name;
  std::string word;        ///< the type as spelled: "float" or "float32"
  std::string count_word;  ///< of a list, else empty
  ComponentType type = ComponentType::f32;
  ComponentType count_type = ComponentType::u8;  ///< of a list; an integer
  std::size_t kept = kNotKept;                   ///< the KeptColumn that holds its values, if any

  static constexpr std::size_t kNotKept = ~std::size_t{0};
  bool is_list() const { return !count_word.empty(); }
};

struct Element {
  std::vector<std::string> remarks;
  std::string name;
  std::uint64_t count = 0;  ///< rows as promised; not checked against anything
  std::vector<Property> properties;

  Property* find(std::string_view property);
  const Property* find(std::string_view property) const {
    return const_cast<Element*>(this)->find(property);
  }
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::vector<std::string> last_remarks;  ///< before end_header
  std::uint64_t body = 0;                 ///< offset of the first byte after the header

  Element* find(std::string_view element);
  const Element* find(std::string_view element) const {
    return const_cast<Header*>(this)->find(element);
  }
};

/// Reads all lines up to end_header; they end in LF, CR LF, or CR when the first one does.
/// An unknown line before the first element is kept as a remark (exporters forget the word
/// "comment"); after it, where it could shift every value, it is corrupt.
Result<Header> parse_header(ByteView file, const Limits& limits);

/// The header's text with one space between words; parse_header of it gives the header back.
std::string format_header(const Header& header);

/// The usual word for a type: "float" for f32.
std::string_view word_of(ComponentType type);

Property scalar_property(std::string name, ComponentType type);
Property list_property(std::string name, ComponentType count_type, ComponentType type);

/// "line 12" of a position in text.
std::string line_of(ByteView file, std::uint64_t offset);

constexpr bool is_integer(ComponentType type) {
  return type != ComponentType::f32 && type != ComponentType::f64;
}
constexpr bool is_signed_integer(ComponentType type) {
  return type == ComponentType::i8 || type == ComponentType::i16 || type == ComponentType::i32;
}

}  // namespace pstrips::inline formats::ply
