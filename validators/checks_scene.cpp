#include <algorithm>
#include <set>

#include "validators/checks.h"

namespace pstrips::inline validators::checks {

void node_parents(const Document& doc, Findings& out) {
  const std::vector<Node>& nodes = doc.strips.scene.nodes;
  for (std::size_t i = 0; i < nodes.size() && !out.full(); ++i)
    if (nodes[i].parent != kNone && nodes[i].parent >= i)
      out.add({.field = Field::node, .element = i}, std::to_string(nodes[i].parent));
}

void node_meshes(const Document& doc, Findings& out) {
  if (doc.ended_early) return;
  const std::vector<Node>& nodes = doc.strips.scene.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Index mesh : nodes[i].meshes)
      if (mesh >= doc.strips.meshes.size())
        out.add({.field = Field::node, .element = i}, std::to_string(mesh));
}

void material_images(const Document& doc, Findings& out) {
  const Scene& scene = doc.strips.scene;
  for (std::size_t i = 0; i < scene.materials.size() && !out.full(); ++i) {
    for (const TextureMap& map : scene.materials[i].maps)
      if (map.image >= scene.images.size())
        out.add({.field = Field::material, .element = i}, std::to_string(map.image));
  }
}

void material_maps(const Document& doc, Findings& out) {
  const std::vector<Material>& materials = doc.strips.scene.materials;
  for (std::size_t i = 0; i < materials.size() && !out.full(); ++i) {
    const std::vector<TextureMap>& maps = materials[i].maps;
    const auto found =
        std::ranges::adjacent_find(maps, std::ranges::greater_equal{}, &TextureMap::role);
    if (found != maps.end())
      out.add({.field = Field::material, .element = i},
              std::to_string(static_cast<unsigned>(found->role)));
  }
}

void images_there(const Document& doc, Findings& out) {
  if (doc.ended_early) return;
  for (std::size_t i = 0; i < doc.image_embedded.size() && !out.full(); ++i)
    if (doc.image_embedded[i] && doc.strips.scene.images[i].data.empty())
      out.add({.field = Field::image, .element = i});
}

void foreign_keys_differ(const Document& doc, Findings& out) {
  std::set<std::string_view> seen;
  const std::vector<Foreign>& foreign = doc.strips.scene.foreign;
  for (std::size_t i = 0; i < foreign.size() && !out.full(); ++i)
    if (!seen.insert(foreign[i].key).second)
      out.add({.field = Field::foreign, .element = i}, foreign[i].key);
}

}  // namespace pstrips::inline validators::checks
