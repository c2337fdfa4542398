#include "formats/ply/ply_textures.h"

#include <algorithm>

#include "core/text.h"

namespace pstrips::inline formats::ply {
namespace {

/// The name in "comment TextureFile NAME"; empty when it is no such remark.
std::string_view texture_of(std::string_view remark) {
  for (const std::string_view word : {"comment", "TextureFile"}) {
    if (!remark.starts_with(word) || remark.size() == word.size() || !is_space(remark[word.size()]))
      return {};
    remark = trimmed(remark.substr(word.size()));
  }
  return remark;
}

void add_textures(const std::vector<std::string>& remarks, Scene& scene) {
  for (const std::string& remark : remarks) {
    const std::string_view name = texture_of(remark);
    if (name.empty()) continue;
    Material material;
    material.metallic = 0;
    material.set_map({.image = static_cast<Index>(scene.images.size())});
    scene.materials.push_back(std::move(material));
    scene.images.push_back({.name = {}, .uri = std::string(name), .mime_type = {}, .data = {}});
  }
}

}  // namespace

bool read_textures(const Header& header, std::uint64_t limit, Scene& scene, Mesh& mesh) {
  for (const Element& e : header.elements) {
    add_textures(e.remarks, scene);
    for (const Property& property : e.properties) add_textures(property.remarks, scene);
  }
  add_textures(header.last_remarks, scene);
  const auto images = static_cast<Index>(scene.images.size());
  const auto number = std::ranges::find(mesh.face_attributes, "texnumber", &Attribute::semantic);
  if (images > limit) return false;
  if (images == 0) return true;
  mesh.groups.resize(1);
  mesh.groups[0].material = 0;
  if (number == mesh.face_attributes.end() || number->count != 1 || !is_integer(number->type))
    return true;
  mesh.groups.resize(images);
  for (Index i = 0; i < images; ++i) mesh.groups[i].material = i;
  mesh.face_group.resize(number->elements());
  for (std::size_t f = 0; f < mesh.face_group.size(); ++f) {
    const double n = component(*number, f, 0);
    mesh.face_group[f] = n >= 0 && n < images ? static_cast<Index>(n) : images;
  }
  if (std::ranges::count(mesh.face_group, images) != 0) mesh.groups.emplace_back();
  return true;
}

}  // namespace pstrips::inline formats::ply
