#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"
#include "formats/gltf/json_cursor.h"

namespace pstrips::inline formats::gltf {

/// Reads a material: its factors, alpha and maps, those of KHR_texture_transform,
/// KHR_materials_emissive_strength and KHR_materials_pbrSpecularGlossiness included; the JSON stays
/// as it is. What is malformed beyond metallic-roughness is passed over.
///
/// texture_image  the image of each texture, kNone: none
Material read_material(const Cursor& in, const std::vector<Index>& texture_image);

/// Writes materials as JSON. [glTF §3.9]
class MaterialWriter {
 public:
  /// `scene` must outlive this. extensions receives the names of those that are used, dropped
  /// phrases of what glTF cannot say.
  MaterialWriter(const Scene& scene, std::set<std::string_view>& extensions,
                 std::vector<std::string>& dropped)
      : scene_(scene), extensions_(extensions), dropped_(dropped) {}

  /// A material whose texture n shows image n.
  json write(const Material& material);

 private:
  void note(const Material& material, std::string_view what);
  json factors_of(const Material& material);
  void write_maps(const Material& material, json& out);
  void write_alpha(const Material& material, json& out);
  void write_roughness_map(const Material& material, json& pbr);
  json texture_of(const TextureMap& map);

  const Scene& scene_;
  std::set<std::string_view>& extensions_;
  std::vector<std::string>& dropped_;
};

}  // namespace pstrips::inline formats::gltf
