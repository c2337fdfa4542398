#pragma once

#include <span>

#include "formats/pstrip/numbers.h"
#include "formats/pstrip/xml/xml_read_context.h"

namespace pstrips::inline formats {

/// The attributes of one element of the DOM, as the layout functions name them. Lists are appended
/// to: `first` and `i` must be their size. After the first failure nothing is read.
class XmlReadAttributes {
 public:
  XmlReadAttributes(XmlReadContext& in, const tinyxml2::XMLElement& element, Fault shape)
      : in_(in), element_(element), shape_(shape) {}

  void version(const char* name, Index);
  void profile(const char* name, Profile& v);
  void constant(const char* name, std::string_view value, Fault unknown);
  void string(const char* name, std::string& v);
  void index(const char* name, Index& v);
  void index_or_none(const char* name, Index& v);
  void component_count(const char* name, std::uint8_t& v);
  void real(const char* name, float& v);
  void real(const char* name, double& v);
  void reals(const char* name, std::span<double> values);
  void integers(const char* name, std::span<std::int64_t> values);
  void flag(const char* name, bool& v);
  /// The attribute may be absent, which means `absent`.
  void flag_unless(const char* name, bool& v, bool absent);
  /// An enumeration, by the words for its values.
  template <class E>
  void word(const char* name, E& v, std::span<const std::string_view> words, Fault undefined) {
    v = static_cast<E>(number_of_word(name, words, undefined));
  }
  void letters(const char* name, std::span<char> v, Fault malformed);
  void indices(const char* name, std::vector<Index>& list);
  void run(const char* name, std::vector<Index>& list, std::size_t first, Index& count);
  void run_unless_empty(const char* name, std::vector<Index>& list, std::size_t first,
                        Index& count);
  /// The run between bounds i and i + 1.
  void run_to_bound(const char* name, std::vector<Index>& list, std::vector<Index>& bounds,
                    std::size_t i);
  /// Element i of `data`, in the format of the attribute.
  void element(const char* name, const Attribute& format, Bytes& data, std::size_t i);
  /// Element i of each attribute; absent when there are none.
  void values(const char* name, std::vector<Attribute>& attributes, std::size_t i);

  bool demand(bool holds, Fault fault, std::string_view message, std::string_view attribute = {});
  void announce(const XmlTotals& more) { in_.announce(element_, more); }
  /// What is wrong when attributes or elements are not those of the layout.
  void shape_is(Fault fault) { shape_ = fault; }

 protected:
  static constexpr const char* kBadComponent = "number is missing, malformed or out of range";
  static constexpr const char* kBadNumber = "not a number in range";
  static constexpr const char* kTooFew = "fewer numbers than announced";
  static constexpr const char* kTooMany = "more numbers than announced";

  void fail(Fault fault, std::string_view message, std::string_view attribute = {}) {
    in_.fail(element_, fault, message, attribute);
  }
  /// Refuses attributes that the layout did not name.
  void finish_attributes();
  /// Appends the components of one element of the format; false when one of them is none.
  static bool append_element(Tokens& tokens, const Attribute& format, Bytes& out);

  XmlReadContext& in_;
  const tinyxml2::XMLElement& element_;
  Fault shape_;

 private:
  bool has(const char* name) const;
  std::string_view raw(const char* name);
  template <class T>
  void number(const char* name, T& v);
  template <class T>
  void numbers(const char* name, std::span<T> values);
  std::size_t number_of_word(const char* name, std::span<const std::string_view> words,
                             Fault undefined);

  std::size_t taken_ = 0;
};

}  // namespace pstrips::inline formats
