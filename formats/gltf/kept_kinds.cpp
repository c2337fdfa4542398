#include "formats/gltf/kept_kinds.h"

#include "formats/gltf/kept_asset.h"

namespace pstrips::inline formats {
namespace gltf {
namespace {

json kept_root(const Scene& scene) {
  const std::string_view text = as_text(find_foreign(scene, kRestKey));
  if (text.empty() || nests_deeper(text, Limits{}.xml_depth)) return json::object();
  json root = json::parse(text, nullptr, false);
  return root.is_object() ? root : json::object();
}

/// A member of a member …; an empty array where there is none.
json list_at(const json& root, std::initializer_list<const char*> path) {
  const json* at = &root;
  for (const char* key : path) {
    if (!at->is_object() || !at->contains(key)) return json::array();
    at = &(*at)[key];
  }
  return at->is_array() ? *at : json::array();
}

struct List {
  const char* name;
  std::initializer_list<const char*> path;
};
const List kLists[] = {
    {"animations", {"animations"}},
    {"skins", {"skins"}},
    {"cameras", {"cameras"}},
    {"lights", {"extensions", "KHR_lights_punctual", "lights"}},
};

}  // namespace
}  // namespace gltf

std::vector<std::pair<std::string, std::uint64_t>> kept_kinds(const Scene& scene) {
  const gltf::json root = gltf::kept_root(scene);
  std::vector<std::pair<std::string, std::uint64_t>> out;
  for (const gltf::List& list : gltf::kLists)
    if (const std::size_t n = gltf::list_at(root, list.path).size(); n > 0)
      out.emplace_back(list.name, n);
  for (const gltf::json& name : gltf::list_at(root, {"extensionsUsed"}))
    if (name.is_string() && name != "KHR_lights_punctual")
      out.emplace_back("extension " + name.get<std::string>(), 1);
  return out;
}

std::vector<std::string> different_kinds(const Scene& a, const Scene& b) {
  const gltf::json root_a = gltf::kept_root(a), root_b = gltf::kept_root(b);
  std::vector<std::string> out;
  bool has_accessors = false;
  for (const gltf::List& list : gltf::kLists) {
    const gltf::json x = gltf::list_at(root_a, list.path), y = gltf::list_at(root_b, list.path);
    const std::string name = list.name;
    has_accessors |= !x.empty() && (name == "animations" || name == "skins");
    if (x.size() != y.size())
      out.push_back(name + ": " + std::to_string(x.size()) + " against " +
                    std::to_string(y.size()));
    else if (x != y)
      out.push_back(name);
  }
  const ByteView bytes_a = gltf::find_foreign(a, gltf::kBinKey);
  const ByteView bytes_b = gltf::find_foreign(b, gltf::kBinKey);
  if (out.empty() && has_accessors && !std::ranges::equal(bytes_a, bytes_b))
    out.emplace_back("values of animations or skins");
  return out;
}

}  // namespace pstrips::inline formats
