#include "formats/gltf/unknown_extensions.h"

#include <algorithm>
#include <set>

#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {
namespace {

class Search {
 public:
  explicit Search(std::size_t numbered) : numbered_(numbered) {}

  void walk(const json& value, bool in_primitive) {
    if (value.is_array())
      for (const json& element : value) walk(element, in_primitive);
    if (!value.is_object()) return;
    for (const auto& [key, member] : value.items()) {
      if (key == "extras" || !member.is_structured()) continue;
      if (key == "extensions" && member.is_object())
        for (const auto& [name, extension] : member.items()) {
          if (!find_extension(name) && may_refer(extension, in_primitive)) found_.insert(name);
          walk(extension, in_primitive);
        }
      else
        walk(member, in_primitive || key == "primitives");
    }
  }
  const std::set<std::string>& found() const { return found_; }

 private:
  bool may_be_reference(const json& number) const {
    if (number.is_number_unsigned()) return number.get<std::uint64_t>() < numbered_;
    return false;
  }

  bool may_refer(const json& value, bool in_primitive) const {
    if (value.is_number()) return in_primitive || may_be_reference(value);
    if (value.is_array())
      return std::ranges::any_of(value, [&](const json& x) { return may_refer(x, in_primitive); });
    if (!value.is_object()) return false;
    for (const auto& [key, member] : value.items()) {
      if (key == "extras" || key == "extensions") continue;
      const bool is_known = !in_primitive && conventional_reference(key) != Reference::none;
      if (!is_known && may_refer(member, in_primitive)) return true;
    }
    return false;
  }

  std::size_t numbered_;
  std::set<std::string> found_;
};

void erase_extensions(json& value, const std::set<std::string>& names) {
  if (value.is_array())
    for (json& element : value) erase_extensions(element, names);
  if (!value.is_object()) return;
  const auto extensions = value.find("extensions");
  if (extensions != value.end() && extensions->is_object()) {
    for (const std::string& name : names) extensions->erase(name);
    if (extensions->empty()) value.erase("extensions");
  }
  for (auto& [key, member] : value.items())
    if (key != "extras" && member.is_structured()) erase_extensions(member, names);
}

void erase_names(json& root, const char* key, const std::set<std::string>& names) {
  const auto list = root.find(key);
  if (list == root.end() || !list->is_array()) return;
  json left = json::array();
  for (json& name : *list)
    if (!name.is_string() || !names.contains(name.get_ref<const std::string&>()))
      left.push_back(std::move(name));
  if (left.empty())
    root.erase(list);
  else
    *list = std::move(left);
}

}  // namespace

std::vector<std::string> drop_unknown_references(json& root, std::size_t numbered) {
  Search search(numbered);
  search.walk(root, false);
  const std::set<std::string>& names = search.found();
  if (names.empty()) return {};
  erase_extensions(root, names);
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) erase_names(root, key, names);
  return {names.begin(), names.end()};
}

}  // namespace pstrips::inline formats::gltf
