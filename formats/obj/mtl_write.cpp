#include <algorithm>
#include <array>
#include <span>

#include "core/texture_origin.h"
#include "formats/obj/mtl.h"
#include "formats/obj/mtl_map.h"
#include "formats/obj/names.h"
#include "formats/obj/numbers.h"

namespace pstrips::inline formats::obj {
namespace {

class MtlWriter {
 public:
  MtlWriter(const Scene& scene, std::set<std::string>& dropped)
      : scene_(scene), dropped_(dropped) {}

  void add(const Material& material, const std::string& name) {
    out_ += "newmtl " + name + '\n';
    const std::span<const double> color = material.base_color;
    statement("Kd", color.first(3));
    add_highlight(material);
    if (const double d = opacity_of(material); d != 1) statement("d", std::span(&d, 1));
    if (material.emissive != std::array<double, 3>{}) statement("Ke", material.emissive);
    statement("Pm", std::span(&material.metallic, 1));
    statement("Pr", std::span(&material.roughness, 1));
    for (const TextureMap& map : material.maps) add_map(material, map);
    if (material.double_sided) dropped_.insert("double_sided");
  }
  std::string take() && { return std::move(out_); }

 private:
  void statement(std::string_view word, std::span<const double> values) {
    out_ += word;
    for (const double value : values) append_number(out_ += ' ', value);
    out_ += '\n';
  }

  /// For who knows neither Pm nor Pr: the reflectance of what glTF takes for a dielectric or a
  /// metal, and the exponent of a lobe as wide.
  void add_highlight(const Material& material) {
    constexpr double kDielectric = 0.04, kSharpest = 1000;
    const double metallic = std::clamp(material.metallic, 0.0, 1.0);
    std::array<double, 3> reflected{};
    for (std::size_t i = 0; i < 3; ++i)
      reflected[i] = kDielectric * (1 - metallic) + material.base_color[i] * metallic;
    statement("Ks", reflected);
    const double square = material.roughness * material.roughness;
    const double exponent = square > 0 ? std::clamp(2 / square - 2, 0.0, kSharpest) : kSharpest;
    statement("Ns", std::span(&exponent, 1));
    out_ += "illum 2\n";
  }

  double opacity_of(const Material& material) {
    const double alpha = material.base_color[3];
    if (material.alpha_mode == AlphaMode::opaque) return 1;
    if (material.alpha_mode == AlphaMode::blend) return alpha;
    if (material.map(MapRole::base_color)) {
      dropped_.insert("alpha masks, written as opacity");
      return 1;
    }
    return alpha < material.alpha_cutoff ? 0 : 1;
  }

  void add_map(const Material& material, const TextureMap& map) {
    switch (map.role) {
      case MapRole::base_color:
        write("map_Kd", map);
        if (material.alpha_mode != AlphaMode::opaque && !material.map(MapRole::opacity))
          write("map_d", map, 'm');
        break;
      case MapRole::opacity:
        write("map_d", map);
        break;
      case MapRole::metallic:
        write("map_Pm", map);
        break;
      case MapRole::roughness:
        write("map_Pr", map);
        break;
      case MapRole::metallic_roughness:
        write("map_Pr", map, 'g');
        write("map_Pm", map, 'b');
        break;
      case MapRole::normal:
        write("norm", map);
        break;
      case MapRole::occlusion:
        dropped_.insert("occlusion maps");
        break;
      case MapRole::emissive:
        write("map_Ke", map);
        break;
    }
  }

  void write(std::string_view word, const TextureMap& written, char channel = '\0') {
    const TextureMap map =
        scene_.texture_origin == TextureOrigin::lower_left ? written : turned(written);
    if (map.texcoord != 0) {
      dropped_.insert("maps by TEXCOORD_" + std::to_string(map.texcoord));
      return;
    }
    if (map.rotation != 0) dropped_.insert("rotations of maps");
    const std::string file = clean_name(scene_.images[map.image].uri);
    if (file.empty())
      dropped_.insert("embedded images");
    else
      out_ += map_line(word, {file, channel, map});
  }

  const Scene& scene_;
  std::set<std::string>& dropped_;
  std::string out_;
};

}  // namespace

std::string write_mtl(const Scene& scene, const std::vector<std::string>& names,
                      std::set<std::string>& dropped) {
  MtlWriter writer(scene, dropped);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) writer.add(scene.materials[i], names[i]);
  return std::move(writer).take();
}

}  // namespace pstrips::inline formats::obj
