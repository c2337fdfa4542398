#include "formats/ply/ply_edit.h"

#include <iterator>
#include <limits>
#include <utility>

#include "formats/ply/ply_numbers.h"

namespace pstrips::inline formats::ply {
namespace {

void append(std::vector<std::string>& to, std::vector<std::string>& more) {
  to.insert(to.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
  more.clear();
}

}  // namespace

void erase_elements(Header& header, const std::vector<bool>& gone) {
  std::vector<Element> left;
  std::vector<std::string> remarks;
  for (std::size_t e = 0; e < gone.size(); ++e) {
    Element& element = header.elements[e];
    append(remarks, element.remarks);
    if (gone[e]) {
      for (Property& property : element.properties) append(remarks, property.remarks);
      continue;
    }
    element.remarks = std::exchange(remarks, {});
    left.push_back(std::move(element));
  }
  append(remarks, header.last_remarks);
  header.last_remarks = std::move(remarks);
  header.elements = std::move(left);
}

void erase_properties(Header& header, Element& element, const std::vector<bool>& gone) {
  std::vector<Property> left;
  std::vector<std::string> remarks;
  for (std::size_t p = 0; p < gone.size(); ++p) {
    Property& property = element.properties[p];
    append(remarks, property.remarks);
    if (gone[p]) continue;
    property.remarks = std::exchange(remarks, {});
    left.push_back(std::move(property));
  }
  element.properties = std::move(left);
  const bool last = &element == &header.elements.back();
  auto& later = last ? header.last_remarks : (&element + 1)->remarks;
  append(remarks, later);
  later = std::move(remarks);
}

void set_type(Property& property, ComponentType type) {
  if (property.type == type) return;
  property.type = type;
  property.word = word_of(type);
}

void widen_count(Property& list, std::uint64_t length) {
  if (fits(list.count_type, length)) return;
  list.count_type = ComponentType::u32;
  list.count_word = word_of(list.count_type);
}

bool fits(ComponentType type, std::uint64_t value) {
  return visit_type(type, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_integral_v<T>)
      return value <= static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    else
      return true;
  });
}

}  // namespace pstrips::inline formats::ply
