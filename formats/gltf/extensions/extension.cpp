#include "formats/gltf/extensions/extension.h"

#include <algorithm>

namespace pstrips::inline formats::gltf {
namespace {

constexpr const Extension* kExtensions[] = {
    &kDracoCompression,  &kExtMeshopt,         &kKhrMeshopt,     &kMeshQuantization,
    &kMeshGpuInstancing, &kStructuralMetadata, &kTextureBasisu,  &kTextureWebp,
    &kTextureAvif,       &kMeshManifold,       &kEdgeVisibility, &kPrimitiveOutline};

// Extensions that a file may require, since they leave the geometry alone: nothing is to be done
// for them but to keep them.
constexpr Extension kKeptAsTheyAre[] = {
    {.name = "EXT_mesh_features", .may_be_required = true},
    {.name = "EXT_instance_features", .may_be_required = true},
    {.name = "MSFT_lod", .may_be_required = true},
    {.name = "KHR_xmp_json_ld", .may_be_required = true},
    {.name = "KHR_techniques_webgl", .may_be_required = true},
    {.name = "KHR_animation_pointer", .may_be_required = true},
    {.name = "KHR_node_visibility", .may_be_required = true},
    {.name = "GOOGLE_texture_basis", .may_be_required = true},
    {.name = "CESIUM_RTC", .may_be_required = true},
    // Their numbers are those of nodes, meshes, materials, textures and their own lists.
    {.name = "KHR_audio_emitter"},
    {.name = "KHR_implicit_shapes"},
    {.name = "KHR_interactivity"},
    {.name = "KHR_node_hoverability"},
    {.name = "KHR_node_selectability"},
    {.name = "KHR_physics_rigid_bodies"},
    {.name = "AGI_articulations"},
    {.name = "VRM"},
};

// The same for families, by the beginnings of their names.
constexpr Extension kFamilies[] = {
    {.name = "KHR_materials_", .may_be_required = true},
    {.name = "KHR_texture_", .may_be_required = true},
    {.name = "EXT_texture_", .may_be_required = true},
    {.name = "KHR_lights_", .may_be_required = true},
    {.name = "EXT_lights_", .may_be_required = true},
    {.name = "MSFT_texture_", .may_be_required = true},
    {.name = "MSFT_packing_", .may_be_required = true},
    {.name = "VRMC_"},
};

}  // namespace

std::span<const Extension* const> extensions() { return kExtensions; }

const Extension* find_extension(std::string_view name) {
  for (const Extension* extension : kExtensions)
    if (extension->name == name) return extension;
  for (const Extension& extension : kKeptAsTheyAre)
    if (extension.name == name) return &extension;
  for (const Extension& family : kFamilies)
    if (name.starts_with(family.name)) return &family;
  return nullptr;
}

Reference conventional_reference(std::string_view key) {
  if (key == "accessor") return Reference::accessor;
  if (key == "bufferView" || key.ends_with("BufferView")) return Reference::view;
  return Reference::none;
}

}  // namespace pstrips::inline formats::gltf
