#include "formats/pstrip/xml/xml_read_io.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "formats/pstrip/xml/xml_text.h"

namespace pstrips::inline formats {

using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

XmlReadIo::XmlReadIo(XmlReadContext& in, const XMLElement& element)
    : XmlReadAttributes(in, element, Fault::xml_schema) {
  if (in.places() != nullptr)
    place_ =
        in.places()->add(kNone, kRootName, 0, static_cast<std::uint32_t>(element.GetLineNum()));
}

XmlReadIo::XmlReadIo(const XmlReadIo& parent, const XMLElement& element, const char* name,
                     std::size_t ordinal)
    : XmlReadAttributes(parent.in_, element, parent.shape_) {
  if (in_.places() != nullptr)
    place_ = in_.places()->add(parent.place_, name, ordinal,
                               static_cast<std::uint32_t>(element.GetLineNum()));
}

// ---- Content -------------------------------------------------------------------------------

void XmlReadIo::content(bool) {
  finish_attributes();
  content_ = Content::elements;
  next_ = element_from(element_.FirstChild());
}

void XmlReadIo::finish() {
  if (!in_.ok() || content_ == Content::text) return;
  if (content_ == Content::none) content();
  if (next_ != nullptr) in_.fail_unknown(*next_, shape_, "element is unknown or out of place");
}

const XMLElement* XmlReadIo::element_from(const XMLNode* node) {
  for (; node != nullptr; node = node->NextSibling()) {
    if (const XMLElement* element = node->ToElement()) return element;
    if (node->ToText() != nullptr) fail(shape_, "text where only elements may be");
  }
  return nullptr;
}

const XMLElement* XmlReadIo::take_if(std::string_view name) {
  if (!in_.ok() || next_ == nullptr || next_->Name() != name) return nullptr;
  const XMLElement* taken = next_;
  next_ = element_from(taken->NextSibling());
  return taken;
}

const XMLElement* XmlReadIo::take(std::string_view name) {
  const XMLElement* taken = take_if(name);
  if (taken == nullptr)
    in_.fail(next_ != nullptr ? *next_ : element_, shape_,
             "required element is missing before or in here");
  return taken;
}

/// The text of this element, which holds nothing else; comments around it do not matter.
std::string_view XmlReadIo::own_text() {
  finish_attributes();
  content_ = Content::text;
  std::string_view text;
  bool seen = false;
  for (const XMLNode* node = element_.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr || seen) {
      fail(shape_, "more than one run of text");
      return {};
    }
    text = node->Value();
    seen = true;
  }
  return text;
}

void XmlReadIo::elements(const char* name, Attribute& attribute, std::size_t count) {
  const XMLElement* at = take(name);
  if (at == nullptr) return;
  XmlReadIo child(*this, *at, name, 0);
  Tokens tokens(child.own_text());
  if (!child.demand(count <= tokens.max_left() / attribute.count, Fault::xml_list_length, kTooFew))
    return;
  attribute.data.reserve(count * attribute.element_bytes());
  for (std::size_t i = 0; i < count && in_.ok(); ++i)
    if (!append_element(tokens, attribute, attribute.data))
      child.fail(Fault::xml_number, kBadComponent);
  child.demand(tokens.at_end(), Fault::xml_list_length, kTooMany);
}

template <class T>
void XmlReadIo::list_of_numbers(const char* name, const char* part, std::vector<T>& list) {
  const XMLElement* at = take(name);
  if (at == nullptr) return;
  XmlReadIo child(*this, *at, name, 0);
  child.stands_for(path_ + part);
  for (Tokens tokens(child.own_text()); in_.ok() && !tokens.at_end();) {
    std::uint32_t v = 0;
    if (!parse_number(tokens.next(), v) || v > std::numeric_limits<T>::max())
      child.fail(Fault::xml_number, kBadNumber);
    list.push_back(static_cast<T>(v));
  }
}

void XmlReadIo::numbers(const char* name, const char* part, std::vector<Index>& list) {
  list_of_numbers(name, part, list);
}
void XmlReadIo::numbers(const char* name, const char* part, std::vector<std::uint8_t>& list) {
  list_of_numbers(name, part, list);
}
void XmlReadIo::numbers(const char* name, const char* part, std::vector<Index>& list,
                        std::size_t count) {
  list_of_numbers(name, part, list);
  demand(list.size() == count, Fault::xml_list_length, list.size() < count ? kTooFew : kTooMany);
}

void XmlReadIo::map_entries(const char* name, const char* part, std::vector<Index>& map,
                            MapEncoding) {
  const XMLElement* at = take(name);
  if (at == nullptr) return;
  XmlReadIo child(*this, *at, name, 0);
  child.stands_for(path_ + part);
  for (Tokens tokens(child.own_text()); in_.ok() && !tokens.at_end();) {
    const std::string_view token = tokens.next();
    const auto marker = std::ranges::find(kMarkerNames, token);
    Index entry = kSameAsMinus2 + static_cast<Index>(marker - kMarkerNames.begin());
    if (marker == kMarkerNames.end() && (!parse_number(token, entry) || !is_wedge(entry)))
      child.fail(Fault::xml_number, "index-map entry is neither a wedge nor a marker");
    map.push_back(entry);
  }
}

void XmlReadIo::hexadecimal(Bytes& bytes, std::size_t size) {
  Tokens tokens(own_text());
  const std::string_view digits = tokens.next();
  bool good = digits.size() == 2 * size && tokens.at_end();
  for (std::size_t i = 0; i < size && good; ++i) {
    std::uint8_t value = 0;
    const char* begin = digits.data() + 2 * i;
    good = std::from_chars(begin, begin + 2, value, 16).ptr == begin + 2;
    bytes.push_back(static_cast<std::byte>(value));
  }
  demand(good, shape_, "not as many hexadecimal digits as there must be");
}

void XmlReadIo::base64(Bytes& bytes) {
  std::optional<Bytes> parsed = parse_base64_lines(own_text());
  if (demand(parsed.has_value(), Fault::xml_base64, "malformed base64")) bytes = std::move(*parsed);
}

void XmlReadIo::text(Bytes& bytes) {
  const ByteView view = as_bytes(own_text());
  bytes.assign(view.begin(), view.end());
}

// ---- Places --------------------------------------------------------------------------------

void XmlReadIo::belongs_to(const char* list_path, std::size_t item) {
  path_ = list_path + std::to_string(item);
}

void XmlReadIo::stands_for(std::string path) {
  path_ = std::move(path);
  if (in_.places() != nullptr) in_.places()->name(path_, place_);
}

std::vector<Index>* XmlReadIo::item_places(const char* part) {
  return in_.places() == nullptr ? nullptr : &in_.places()->items(path_ + part);
}

Index XmlReadIo::item_of_part(const char* attribute, std::size_t items, Fault past_end) {
  Index i = 0;
  index(attribute, i);
  demand(i < items, past_end, std::string("names no such ") + attribute, attribute);
  return i;
}

}  // namespace pstrips::inline formats
