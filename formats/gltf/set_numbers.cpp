#include "formats/gltf/set_numbers.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace pstrips::inline formats::gltf {
namespace {

/// n of PREFIX_n.
std::optional<Index> set_number(const std::string& name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return std::nullopt;
  Index n = 0;
  const char* end = name.data() + name.size();
  const auto [after, error] = std::from_chars(name.data() + prefix.size(), end, n);
  if (error != std::errc{} || after != end) return std::nullopt;
  return n;
}

/// The set that a reference to a texture asks for.
json* set_of(json& texture) {
  if (texture.contains("extensions") && texture["extensions"].is_object()) {
    json& extensions = texture["extensions"];
    const auto transform = extensions.find("KHR_texture_transform");
    if (transform != extensions.end() && transform->is_object() && transform->contains("texCoord"))
      return &(*transform)["texCoord"];
  }
  return texture.contains("texCoord") ? &texture["texCoord"] : nullptr;
}

Index wanted_set(json& texture) {
  const json* set = set_of(texture);
  return set && set->is_number_unsigned() ? set->get<Index>() : 0;
}

bool is_texture(const std::string& key, const json& value) {
  return key.ends_with("Texture") && value.is_object() && value.contains("index");
}

/// Calls visit(texture) for each reference to a texture; those for which it is false go.
template <class Visit>
void visit_textures(json& value, Visit&& visit) {
  if (!value.is_object()) return;
  std::vector<std::string> gone;
  for (auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    if (!is_texture(key, member))
      visit_textures(member, visit);
    else if (!visit(member))
      gone.push_back(key);
  }
  for (const std::string& key : gone) value.erase(key);
}

}  // namespace

TextureSets close_gaps(std::vector<Fitted>& attributes, Notes& notes) {
  TextureSets out;
  for (const char* prefix : {"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"}) {
    std::map<Index, Fitted*> sets;
    for (Fitted& fitted : attributes)
      if (const auto n = set_number(fitted.name, prefix); n && fitted.target == kNone)
        sets.emplace(*n, &fitted);
    Index next = 0;
    for (const auto& [n, fitted] : sets) {
      if (std::string_view(prefix) == "TEXCOORD_") out[n] = next;
      const std::string name = prefix + std::to_string(next++);
      if (fitted->name == name) continue;
      notes.converted.push_back("attribute " + fitted->name + ", written as " + name);
      fitted->name = name;
    }
  }
  return out;
}

bool fits_sets(const json& material, const TextureSets& sets) {
  json copy = material;
  bool out = true;
  visit_textures(copy, [&](json& texture) {
    const auto set = sets.find(wanted_set(texture));
    out &= set != sets.end() && set->first == set->second;
    return true;
  });
  return out;
}

json on_sets(json material, const TextureSets& sets, std::uint64_t& without) {
  visit_textures(material, [&](json& texture) {
    const Index wanted = wanted_set(texture);
    const auto set = sets.find(wanted);
    if (set == sets.end()) {
      ++without;
      return false;
    }
    if (set->second == wanted) return true;
    if (json* number = set_of(texture))
      *number = set->second;
    else
      texture["texCoord"] = set->second;
    return true;
  });
  return material;
}

}  // namespace pstrips::inline formats::gltf
