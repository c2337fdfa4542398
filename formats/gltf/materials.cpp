#include "formats/gltf/materials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/texture_origin.h"

namespace pstrips::inline formats::gltf {
namespace {

constexpr std::string_view kTransform = "KHR_texture_transform";
constexpr std::string_view kEmissiveStrength = "KHR_materials_emissive_strength";
constexpr std::string_view kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

// ---- reading ----

const json* member(const json& object, std::string_view key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? nullptr : &*found;
}

const json* extension_of(const json& object, std::string_view name) {
  const json* const extensions = member(object, "extensions");
  return extensions ? member(*extensions, name) : nullptr;
}

void read_number(const json& object, std::string_view key, double& out) {
  const json* const value = member(object, key);
  if (value && value->is_number()) out = value->get<double>();
}

template <std::size_t n>
void read_numbers(const json& object, std::string_view key, std::array<double, n>& out) {
  const json* const list = member(object, key);
  const auto is_number = [](const json& x) { return x.is_number(); };
  if (!list || !list->is_array() || list->size() != n || !std::ranges::all_of(*list, is_number))
    return;
  for (std::size_t i = 0; i < n; ++i) out[i] = (*list)[i].template get<double>();
}

/// A number of something; kNone for what is none.
Index read_index(const json& object, std::string_view key, Index absent) {
  const json* const value = member(object, key);
  if (!value) return absent;
  if (!value->is_number_unsigned() || value->get<std::uint64_t>() >= kNone) return kNone;
  return static_cast<Index>(value->get<std::uint64_t>());
}

void read_map(const json& parent, std::string_view key, MapRole role,
              const std::vector<Index>& texture_image, Material& out) {
  const json* const info = member(parent, key);
  if (!info) return;
  const Index texture = read_index(*info, "index", kNone);
  TextureMap map{.role = role};
  map.image = texture < texture_image.size() ? texture_image[texture] : kNone;
  map.texcoord = read_index(*info, "texCoord", 0);
  if (role == MapRole::normal) read_number(*info, "scale", map.strength);
  if (role == MapRole::occlusion) read_number(*info, "strength", map.strength);
  if (const json* const transform = extension_of(*info, kTransform)) {
    read_numbers(*transform, "offset", map.offset);
    read_numbers(*transform, "scale", map.scale);
    read_number(*transform, "rotation", map.rotation);
    map.texcoord = read_index(*transform, "texCoord", map.texcoord);
  }
  if (map.image != kNone && map.texcoord != kNone) out.set_map(map);
}

/// The older model's diffuse part; its gloss is the opposite of roughness.
void read_specular_glossiness(const json& in, const std::vector<Index>& texture_image,
                              Material& out) {
  double gloss = 1;
  read_numbers(in, "diffuseFactor", out.base_color);
  read_number(in, "glossinessFactor", gloss);
  out.roughness = 1 - gloss;
  out.metallic = 0;
  read_map(in, "diffuseTexture", MapRole::base_color, texture_image, out);
}

void read_alpha(const json& in, Material& out) {
  const json* const mode = member(in, "alphaMode");
  if (mode && *mode == "MASK") out.alpha_mode = AlphaMode::mask;
  if (mode && *mode == "BLEND") out.alpha_mode = AlphaMode::blend;
  read_number(in, "alphaCutoff", out.alpha_cutoff);
}

// ---- writing ----

bool is_moved(const TextureMap& map) {
  const TextureMap still;
  return map.offset != still.offset || map.scale != still.scale || map.rotation != 0;
}

bool same_place(const TextureMap& a, const TextureMap& b) {
  return a.image == b.image && a.texcoord == b.texcoord && a.offset == b.offset &&
         a.scale == b.scale && a.rotation == b.rotation;
}

double share(double x) { return std::clamp(std::isfinite(x) ? x : 1, 0.0, 1.0); }

}  // namespace

Material read_material(const Cursor& in, const std::vector<Index>& texture_image) {
  Material out;
  out.name = in.text("name");
  out.double_sided = in.flag("doubleSided");
  in.numbers("emissiveFactor", out.emissive);
  const json& all = in.value();
  if (const json* const gloss = extension_of(all, kSpecularGlossiness))
    read_specular_glossiness(*gloss, texture_image, out);
  if (in.has_object("pbrMetallicRoughness")) {
    const Cursor pbr = in["pbrMetallicRoughness"];
    pbr.numbers("baseColorFactor", out.base_color);
    pbr.number("metallicFactor", out.metallic);
    pbr.number("roughnessFactor", out.roughness);
    if (pbr.has_object("baseColorTexture"))
      pbr["baseColorTexture"].reference("index", texture_image.size());
    read_map(pbr.value(), "baseColorTexture", MapRole::base_color, texture_image, out);
    read_map(pbr.value(), "metallicRoughnessTexture", MapRole::metallic_roughness, texture_image,
             out);
  }
  read_alpha(all, out);
  read_map(all, "normalTexture", MapRole::normal, texture_image, out);
  read_map(all, "occlusionTexture", MapRole::occlusion, texture_image, out);
  read_map(all, "emissiveTexture", MapRole::emissive, texture_image, out);
  if (const json* const strength = extension_of(all, kEmissiveStrength)) {
    double factor = 1;
    read_number(*strength, "emissiveStrength", factor);
    for (double& x : out.emissive) x *= factor;
  }
  return out;
}

void MaterialWriter::note(const Material& material, std::string_view what) {
  dropped_.push_back(std::string(what) + " of material " + material.name);
}

json MaterialWriter::write(const Material& material) {
  json out = json::object();
  out["pbrMetallicRoughness"] = factors_of(material);
  if (!material.name.empty()) out["name"] = material.name;
  if (material.double_sided) out["doubleSided"] = true;
  write_alpha(material, out);
  std::array<double, 3> light = material.emissive;
  const double strongest = std::ranges::max(light);
  if (std::isfinite(strongest) && strongest > 1) {
    for (double& x : light) x /= strongest;
    out["extensions"][kEmissiveStrength]["emissiveStrength"] = strongest;
    extensions_.insert(kEmissiveStrength);
  }
  std::array<double, 3> written;
  std::ranges::transform(light, written.begin(), share);
  if (written != light) note(material, "an emission that is no light");
  if (written != std::array<double, 3>{}) out["emissiveFactor"] = written;
  write_maps(material, out);
  return out;
}

json MaterialWriter::factors_of(const Material& material) {
  std::array<double, 4> color;
  std::ranges::transform(material.base_color, color.begin(), share);
  if (color != material.base_color || share(material.metallic) != material.metallic ||
      share(material.roughness) != material.roughness)
    note(material, "factors beyond 0 to 1");
  return {{"baseColorFactor", color},
          {"metallicFactor", share(material.metallic)},
          {"roughnessFactor", share(material.roughness)}};
}

void MaterialWriter::write_alpha(const Material& material, json& out) {
  if (material.alpha_mode == AlphaMode::opaque) return;
  const bool masks = material.alpha_mode == AlphaMode::mask;
  out["alphaMode"] = masks ? "MASK" : "BLEND";
  constexpr double kUsual = 0.5;
  if (masks && material.alpha_cutoff != kUsual && material.alpha_cutoff >= 0)
    out["alphaCutoff"] = material.alpha_cutoff;
}

void MaterialWriter::write_maps(const Material& material, json& out) {
  json& pbr = out["pbrMetallicRoughness"];
  for (const TextureMap& map : material.maps) {
    switch (map.role) {
      case MapRole::base_color:
        pbr["baseColorTexture"] = texture_of(map);
        break;
      case MapRole::opacity:
        // The alpha of the colour's own image is what glTF looks at.
        if (const TextureMap* const color = material.map(MapRole::base_color);
            !color || !same_place(*color, map))
          note(material, "an opacity map beside the colour's image");
        break;
      case MapRole::metallic_roughness:
        pbr["metallicRoughnessTexture"] = texture_of(map);
        break;
      case MapRole::metallic:
      case MapRole::roughness:
        break;
      case MapRole::normal:
        out["normalTexture"] = texture_of(map);
        if (map.strength != 1) out["normalTexture"]["scale"] = map.strength;
        break;
      case MapRole::occlusion:
        out["occlusionTexture"] = texture_of(map);
        if (map.strength != 1) out["occlusionTexture"]["strength"] = share(map.strength);
        break;
      case MapRole::emissive:
        out["emissiveTexture"] = texture_of(map);
        break;
    }
  }
  write_roughness_map(material, pbr);
}

/// One image holds both in glTF. A grey image of roughness will do where nothing is metallic, for
/// its blue then multiplies zero.
void MaterialWriter::write_roughness_map(const Material& material, json& pbr) {
  const TextureMap* const metallic = material.map(MapRole::metallic);
  const TextureMap* const roughness = material.map(MapRole::roughness);
  if ((!metallic && !roughness) || material.map(MapRole::metallic_roughness)) return;
  const bool fits =
      roughness && (metallic ? same_place(*metallic, *roughness) : material.metallic == 0);
  if (fits)
    pbr["metallicRoughnessTexture"] = texture_of(*roughness);
  else
    note(material, "metallic and roughness maps in images of their own");
}

json MaterialWriter::texture_of(const TextureMap& written) {
  const TextureMap map =
      scene_.texture_origin == TextureOrigin::upper_left ? written : turned(written);
  json out = {{"index", map.image}};
  if (map.texcoord != 0) out["texCoord"] = map.texcoord;
  if (!is_moved(map)) return out;
  json& transform = out["extensions"][kTransform];
  if (map.offset != TextureMap{}.offset) transform["offset"] = map.offset;
  if (map.scale != TextureMap{}.scale) transform["scale"] = map.scale;
  if (map.rotation != 0) transform["rotation"] = map.rotation;
  extensions_.insert(kTransform);
  return out;
}

}  // namespace pstrips::inline formats::gltf
