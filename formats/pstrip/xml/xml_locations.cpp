#include "formats/pstrip/numbers.h"
#include "formats/pstrip/xml/xml.h"

namespace pstrips::inline formats {

std::string XmlPlace::text() const {
  std::string out = "line " + std::to_string(line) + ", " + element;
  if (entry) out += ", entry " + std::to_string(*entry);
  return out;
}

XmlPlace XmlLocations::find(std::string_view path) const {
  std::optional<std::uint32_t> number;  // that the path had after what is searched for
  while (!path.empty()) {
    const std::size_t slash = std::min(path.rfind('/'), path.size() - 1);
    const std::string_view list = path.substr(0, slash), last = path.substr(slash + 1);
    Index i = 0;
    const bool is_number = parse_number(last, i);
    if (const auto found = items_.find(list);
        is_number && found != items_.end() && i < found->second.size())
      return place_of(found->second[i], {});
    if (const auto found = parts_.find(path); found != parts_.end())
      return place_of(found->second, number);
    number = is_number ? std::optional(i) : std::nullopt;
    path = list;
  }
  return elements_.empty() ? XmlPlace{} : place_of(0, {});
}

Index XmlLocations::add(Index parent, const char* name, std::size_t ordinal, std::uint32_t line) {
  elements_.push_back({parent, static_cast<Index>(ordinal), line, name});
  return static_cast<Index>(elements_.size() - 1);
}

void XmlLocations::name(std::string path, Index element) {
  parts_.emplace(std::move(path), element);
}

std::vector<Index>& XmlLocations::items(std::string path) { return items_[std::move(path)]; }

XmlPlace XmlLocations::place_of(Index element, std::optional<std::uint32_t> entry) const {
  XmlPlace place{.line = elements_[element].line, .element = {}, .entry = entry};
  for (Index e = element; e != kNone; e = elements_[e].parent) {
    std::string step = std::string("/") + elements_[e].name;
    if (elements_[e].parent != kNone) step += "[" + std::to_string(elements_[e].ordinal) + "]";
    place.element.insert(0, step);
  }
  return place;
}

}  // namespace pstrips::inline formats
