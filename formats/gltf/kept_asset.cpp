#include "formats/gltf/kept_asset.h"

#include <algorithm>

namespace pstrips::inline formats::gltf {
namespace {

bool is_list_of(const json& root, const char* key, std::size_t count) {
  const auto list = root.find(key);
  if (list == root.end()) return count == 0;
  return list->is_array() && list->size() == count &&
         std::ranges::all_of(*list, [](const json& element) { return element.is_object(); });
}

/// A list of objects of any length, or nothing.
bool is_list(const json& root, const char* key) {
  const auto list = root.find(key);
  return list == root.end() || (list->is_array() && is_list_of(root, key, list->size()));
}

}  // namespace

std::optional<KeptAsset> find_kept_asset(const Model& model) {
  const std::string_view text = as_text(find_foreign(model.scene, kRestKey));
  auto map = PrimitiveMap::read(find_foreign(model.scene, kPrimitivesKey));
  if (text.empty() || !map || !map->fits(model.meshes)) return std::nullopt;
  if (nests_deeper(text, Limits{}.xml_depth)) return std::nullopt;
  KeptAsset out{json::parse(text, nullptr, false), std::move(*map)};
  const json& root = out.root;
  if (!root.is_object() || !is_list_of(root, "meshes", out.map.meshes.size()) ||
      !is_list_of(root, "materials", model.scene.materials.size()) ||
      !is_list_of(root, "images", model.scene.images.size()) || !is_list(root, "accessors") ||
      !is_list(root, "bufferViews"))
    return std::nullopt;
  for (std::size_t m = 0; m < out.map.meshes.size(); ++m)
    if (!is_list_of(root["meshes"][m], "primitives", out.map.meshes[m].size())) return std::nullopt;
  std::uint64_t targets = 0;
  for (const PrimitiveMap::Layout& layout : out.map.layouts) targets += layout.targets;
  return targets <= kMaxTargets ? std::optional(std::move(out)) : std::nullopt;
}

ByteView find_foreign(const Scene& scene, std::string_view key) {
  const auto found = std::ranges::find(scene.foreign, key, &Foreign::key);
  return found == scene.foreign.end() ? ByteView{} : ByteView(found->data);
}

}  // namespace pstrips::inline formats::gltf
