#include "core/texture_origin.h"

#include <algorithm>
#include <cmath>

namespace pstrips::inline core {
namespace {

/// 1 - v of an unsigned share is a share again; other integers may leave their range.
bool keeps_type(const Attribute& a) {
  if (a.type == ComponentType::f32 || a.type == ComponentType::f64) return true;
  return a.normalized && (a.type == ComponentType::u8 || a.type == ComponentType::u16);
}

template <class MeshType>
void turn_meshes(std::vector<MeshType>& meshes) {
  for (MeshType& mesh : meshes)
    for (Attribute& attribute : mesh.wedge_attributes)
      if (is_texcoord(attribute.semantic)) attribute = turned(attribute);
}

/// Whether there was something to turn.
bool turn_scene(Scene& scene, TextureOrigin origin) {
  if (scene.texture_origin == origin) return false;
  scene.texture_origin = origin;
  for (Material& material : scene.materials)
    for (TextureMap& map : material.maps) map = turned(map);
  return true;
}

}  // namespace

bool is_texcoord(std::string_view semantic) {
  constexpr std::string_view kPrefix = "TEXCOORD_";
  if (!semantic.starts_with(kPrefix) || semantic.size() == kPrefix.size()) return false;
  return std::ranges::all_of(semantic.substr(kPrefix.size()),
                             [](char c) { return c >= '0' && c <= '9'; });
}

Attribute turned(const Attribute& texcoord) {
  if (texcoord.count < 2) return texcoord;
  Attribute out = texcoord;
  if (!keeps_type(texcoord)) {
    out = {texcoord.semantic, ComponentType::f32, texcoord.count, false, {}};
    out.data.resize(texcoord.elements() * out.element_bytes());
    for (std::size_t i = 0; i < texcoord.elements(); ++i)
      for (std::size_t c = 0; c < texcoord.count; ++c)
        set_component(out, i, c, component(texcoord, i, c));
  }
  for (std::size_t i = 0; i < texcoord.elements(); ++i)
    set_component(out, i, 1, 1 - component(texcoord, i, 1));
  return out;
}

TextureMap turned(const TextureMap& map) {
  TextureMap out = map;
  out.rotation = map.rotation == 0 ? 0 : -map.rotation;
  // Where the other corner, (0, 1), goes is where the new origin goes, seen from there.
  const double sine = std::sin(map.rotation), cosine = std::cos(map.rotation);
  out.offset = {map.offset[0] + sine * map.scale[1], 1 - (map.offset[1] + cosine * map.scale[1])};
  return out;
}

Model with_texture_origin(Model model, TextureOrigin origin) {
  if (turn_scene(model.scene, origin)) turn_meshes(model.meshes);
  return model;
}

ProgressiveStrips with_texture_origin(ProgressiveStrips strips, TextureOrigin origin) {
  if (turn_scene(strips.scene, origin)) turn_meshes(strips.meshes);
  return strips;
}

}  // namespace pstrips::inline core
