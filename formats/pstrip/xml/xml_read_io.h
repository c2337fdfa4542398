#pragma once

#include <array>

#include "formats/pstrip/xml/xml_read_attributes.h"

namespace pstrips::inline formats {

/// The Io of the layout functions that fills structures from one element of the DOM. Lists are
/// appended to; after the first failure nothing is read. [formats/pstrip/xml/xml_layout.h]
class XmlReadIo : public XmlReadAttributes {
 public:
  static constexpr bool kReads = true;

  /// For the root element.
  XmlReadIo(XmlReadContext& in, const tinyxml2::XMLElement& element);

  // Content.
  /// The attributes end, elements follow.
  void content(bool = true);
  template <class Fields>
  void child(const char* name, const char* part, Fields&& fields) {
    if (const tinyxml2::XMLElement* at = take(name)) visit(*at, name, part, fields);
  }
  template <class Fields>
  void child_if(bool, const char* name, const char* part, Fields&& fields) {
    if (const tinyxml2::XMLElement* at = take_if(name)) visit(*at, name, part, fields);
  }
  template <class T, class Fields>
  void children(const char* name, const char* part, std::vector<T>& list, Fields&& fields) {
    std::vector<Index>* const places = item_places(part);
    while (const tinyxml2::XMLElement* at = take_if(name)) {
      in_.grow(*at, list);
      XmlReadIo child(*this, *at, name, list.size());
      if (places != nullptr) places->push_back(child.place_);
      child.path_ = path_ + part + "/" + std::to_string(list.size());
      fields(child, list.emplace_back());
      child.finish();
    }
  }
  /// Elements that stand for `count` items of flat lists; returns how many there are.
  template <class Fields>
  std::size_t each(const char* name, const char* part, std::size_t, Fields&& fields) {
    std::vector<Index>* const places = item_places(part);
    std::size_t found = 0;
    while (const tinyxml2::XMLElement* at = take_if(name)) {
      XmlReadIo child(*this, *at, name, found++);
      if (places != nullptr) places->push_back(child.place_);
      fields(child);
      child.finish();
    }
    return found;
  }
  template <class T, class... Parts>
  void parts(const char* attribute, const char* list_path, std::vector<T>& items,
             const Parts&... parts) {
    std::array<std::size_t, sizeof...(Parts)> found{};
    const auto take_one = [&] {
      std::size_t k = 0;
      return (take_part(attribute, list_path, items, parts, found[k++]) || ...);
    };
    while (take_one()) {
    }
  }

  // Elements that hold a list, and content that is not elements.
  void elements(const char* name, Attribute& attribute, std::size_t count);
  void numbers(const char* name, const char* part, std::vector<Index>& list);
  void numbers(const char* name, const char* part, std::vector<std::uint8_t>& list);
  /// Demands that there are `count`.
  void numbers(const char* name, const char* part, std::vector<Index>& list, std::size_t count);
  void map_entries(const char* name, const char* part, std::vector<Index>& map, MapEncoding);
  void hexadecimal(Bytes& bytes, std::size_t size);
  void base64(Bytes& bytes);
  void text(Bytes& bytes);

  /// The path of the model that parts below this element go on.
  void belongs_to(const char* list_path, std::size_t item);
  /// Refuses what the layout did not name.
  void finish();

 private:
  enum class Content : std::uint8_t { none, elements, text };

  XmlReadIo(const XmlReadIo& parent, const tinyxml2::XMLElement& element, const char* name,
            std::size_t ordinal);

  const tinyxml2::XMLElement* element_from(const tinyxml2::XMLNode* node);
  /// The next child when it has that name, else null.
  const tinyxml2::XMLElement* take_if(std::string_view name);
  const tinyxml2::XMLElement* take(std::string_view name);
  std::string_view own_text();
  template <class T>
  void list_of_numbers(const char* name, const char* part, std::vector<T>& list);

  /// This element is the part of the model with the path, which parts below go on.
  void stands_for(std::string path);
  /// Where to note the places of a list's items; null when they are not noted.
  std::vector<Index>* item_places(const char* part);
  /// The item that a part names by its attribute; past the end only with an error.
  Index item_of_part(const char* attribute, std::size_t items, Fault past_end);

  template <class Fields>
  void visit(const tinyxml2::XMLElement& at, const char* name, const char* part, Fields&& fields) {
    XmlReadIo child(*this, at, name, 0);
    child.stands_for(path_ + part);
    fields(child);
    child.finish();
  }
  /// found  how many of these elements there were
  template <class T, class Part>
  bool take_part(const char* attribute, const char* list_path, std::vector<T>& items,
                 const Part& part, std::size_t& found) {
    const tinyxml2::XMLElement* const at = take_if(part.name);
    if (at == nullptr) return false;
    XmlReadIo child(*this, *at, part.name, found++);
    const Index i = child.item_of_part(attribute, items.size(), part.past_end);
    if (!in_.ok()) return true;
    if (!child.demand(!part.has(items[i]), Fault::xml_twice,
                      std::string("stands twice for its ") + attribute, attribute))
      return true;
    child.stands_for(list_path + std::to_string(i) + part.part);
    part.fields(child, items[i]);
    child.finish();
    child.demand(part.has(items[i]), Fault::xml_twice, "element without content");
    return true;
  }

  std::string path_;     // of the model
  Index place_ = kNone;  // in the context's places
  Content content_ = Content::none;
  const tinyxml2::XMLElement* next_ = nullptr;
};

}  // namespace pstrips::inline formats
