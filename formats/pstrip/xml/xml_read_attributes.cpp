#include "formats/pstrip/xml/xml_read_attributes.h"

#include <tinyxml2.h>

#include <algorithm>
#include <limits>

#include "formats/pstrip/xml/xml_text.h"

namespace pstrips::inline formats {

bool XmlReadAttributes::has(const char* name) const {
  return element_.FindAttribute(name) != nullptr;
}

std::string_view XmlReadAttributes::raw(const char* name) {
  const tinyxml2::XMLAttribute* found = element_.FindAttribute(name);
  if (found == nullptr) {
    fail(shape_, "required attribute is missing", name);
    return {};
  }
  ++taken_;
  return found->Value();
}

template <class T>
void XmlReadAttributes::number(const char* name, T& v) {
  const std::string_view text = raw(name);
  if (in_.ok() && !parse_number(text, v)) fail(Fault::xml_number, kBadNumber, name);
}

void XmlReadAttributes::version(const char* name, Index) {
  const std::string_view text = raw(name);
  const std::size_t dot = std::min(text.find('.'), text.size());
  Index major = 0, minor = 0;
  if (!demand(parse_number(text.substr(0, dot), major) && dot < text.size() &&
                  parse_number(text.substr(dot + 1), minor),
              shape_, "malformed version", name))
    return;
  demand(major == kXmlVersionMajor, Fault::version_unknown, "version that this build does not know",
         name);
  if (minor > kXmlVersionMinor) in_.set_newer_version();
}

void XmlReadAttributes::profile(const char* name, Profile& v) {
  const std::optional<Profile> profile = profile_named(raw(name));
  if (demand(profile.has_value(), Fault::profile_unknown, "profile that this build does not know",
             name))
    v = *profile;
}

void XmlReadAttributes::constant(const char* name, std::string_view value, Fault unknown) {
  demand(raw(name) == value, unknown, std::string(name) + " that this build does not know", name);
}

void XmlReadAttributes::string(const char* name, std::string& v) {
  const std::string_view text = raw(name);
  if (!demand(text.size() <= in_.limits().string_bytes, Fault::over_limit,
              "string longer than the limit", name))
    return;
  std::optional<std::string> value = unescape(text);
  if (demand(value.has_value(), Fault::xml_backslash, "backslash that escapes nothing", name))
    v = std::move(*value);
}

void XmlReadAttributes::index(const char* name, Index& v) { number(name, v); }

void XmlReadAttributes::index_or_none(const char* name, Index& v) {
  v = kNone;
  if (has(name)) number(name, v);
}

void XmlReadAttributes::component_count(const char* name, std::uint8_t& v) {
  constexpr Index kMax = std::numeric_limits<std::uint8_t>::max();
  Index n = 0;
  number(name, n);
  if (demand(n >= 1 && n <= kMax, Fault::no_components, "not between 1 and 255", name))
    v = static_cast<std::uint8_t>(n);
}

void XmlReadAttributes::real(const char* name, float& v) { number(name, v); }
void XmlReadAttributes::real(const char* name, double& v) { number(name, v); }

template <class T>
void XmlReadAttributes::numbers(const char* name, std::span<T> values) {
  Tokens tokens(raw(name));
  for (T& v : values)
    if (in_.ok() && !parse_number(tokens.next(), v)) fail(Fault::xml_number, kBadComponent, name);
  demand(tokens.at_end(), Fault::xml_list_length, kTooMany, name);
}

void XmlReadAttributes::reals(const char* name, std::span<double> values) { numbers(name, values); }
void XmlReadAttributes::integers(const char* name, std::span<std::int64_t> values) {
  numbers(name, values);
}

void XmlReadAttributes::flag(const char* name, bool& v) {
  const std::string_view text = raw(name);
  v = text == "true" || text == "1";
  demand(v || text == "false" || text == "0", shape_, "neither true nor false", name);
}

void XmlReadAttributes::flag_unless(const char* name, bool& v, bool absent) {
  v = absent;
  if (has(name)) flag(name, v);
}

std::size_t XmlReadAttributes::number_of_word(const char* name,
                                              std::span<const std::string_view> words,
                                              Fault undefined) {
  const auto found = std::ranges::find(words, raw(name));
  if (!demand(found != words.end(), undefined, "word is none of those defined", name)) return 0;
  return static_cast<std::size_t>(found - words.begin());
}

void XmlReadAttributes::letters(const char* name, std::span<char> v, Fault malformed) {
  const std::string_view text = raw(name);
  if (demand(text.size() == v.size(), malformed, "not of so many letters", name))
    std::ranges::copy(text, v.begin());
}

void XmlReadAttributes::indices(const char* name, std::vector<Index>& list) {
  for (Tokens tokens(raw(name)); in_.ok() && !tokens.at_end();) {
    Index v = 0;
    if (!parse_number(tokens.next(), v)) fail(Fault::xml_number, kBadNumber, name);
    list.push_back(v);
  }
}

void XmlReadAttributes::run(const char* name, std::vector<Index>& list, std::size_t, Index& count) {
  const std::size_t before = list.size();
  indices(name, list);
  count = static_cast<Index>(list.size() - before);
}

void XmlReadAttributes::run_unless_empty(const char* name, std::vector<Index>& list,
                                         std::size_t first, Index& count) {
  count = 0;
  if (has(name)) run(name, list, first, count);
}

void XmlReadAttributes::run_to_bound(const char* name, std::vector<Index>& list,
                                     std::vector<Index>& bounds, std::size_t) {
  indices(name, list);
  bounds.push_back(static_cast<Index>(list.size()));
}

void XmlReadAttributes::element(const char* name, const Attribute& format, Bytes& data,
                                std::size_t) {
  Tokens tokens(raw(name));
  if (!in_.ok()) return;
  if (!append_element(tokens, format, data)) return fail(Fault::xml_number, kBadComponent, name);
  demand(tokens.at_end(), Fault::xml_list_length, kTooMany, name);
}

void XmlReadAttributes::values(const char* name, std::vector<Attribute>& attributes, std::size_t) {
  if (attributes.empty()) return;
  Tokens tokens(raw(name));
  for (Attribute& a : attributes)
    if (in_.ok() && !append_element(tokens, a, a.data))
      fail(Fault::xml_number, kBadComponent, name);
  demand(tokens.at_end(), Fault::xml_list_length, kTooMany, name);
}

bool XmlReadAttributes::demand(bool holds, Fault fault, std::string_view message,
                               std::string_view attribute) {
  if (!holds) fail(fault, message, attribute);
  return in_.ok();
}

void XmlReadAttributes::finish_attributes() {
  std::size_t present = 0;
  for (auto* a = element_.FirstAttribute(); a != nullptr; a = a->Next()) ++present;
  if (present != taken_) in_.fail_unknown(element_, shape_, "attribute is unknown or stands twice");
}

bool XmlReadAttributes::append_element(Tokens& tokens, const Attribute& format, Bytes& out) {
  const std::size_t before = out.size(), size = size_of(format.type);
  out.resize(before + format.element_bytes());
  for (std::size_t c = 0; c < format.count; ++c)
    if (!parse_component(tokens.next(), format.type, out.data() + before + c * size)) return false;
  return true;
}

}  // namespace pstrips::inline formats
