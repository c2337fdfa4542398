#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "formats/obj/mtl.h"
#include "formats/obj/mtl_map.h"
#include "formats/obj/names.h"
#include "formats/obj/numbers.h"

namespace pstrips::inline formats::obj {
namespace {

/// As many finite numbers as there are at the start of `text`, at most three.
struct Numbers {
  std::array<double, 3> value{};
  std::size_t count = 0;
};

Numbers parse_numbers(std::string_view text) {
  Numbers out;
  for (; out.count < out.value.size(); ++out.count) {
    const std::string_view word = next_word(text);
    Number number;
    if (word.empty() || !parse_number(word.data(), word.data() + word.size(), number)) break;
    if (!std::isfinite(number.value)) break;  // no factor of a material can be that
    out.value[out.count] = number.value;
  }
  return out;
}

using Color = std::array<double, 3>;

/// One number stands for all three channels.
void parse_color(std::string_view text, std::optional<Color>& color) {
  const Numbers numbers = parse_numbers(text);
  if (numbers.count == 1) color.emplace().fill(numbers.value[0]);
  if (numbers.count == 3) color = numbers.value;
}

void parse_scalar(std::string_view text, std::optional<double>& value) {
  const Numbers numbers = parse_numbers(text);
  if (numbers.count > 0) value = numbers.value[0];
}

std::string_view without_halo(std::string_view text) {
  std::string_view rest = text;
  return lower_case(next_word(rest)) == "-halo" ? rest : text;
}

constexpr std::pair<std::string_view, MapRole> kMapWords[] = {{"map_kd", MapRole::base_color},
                                                              {"map_ke", MapRole::emissive},
                                                              {"map_d", MapRole::opacity},
                                                              {"map_pm", MapRole::metallic},
                                                              {"map_pr", MapRole::roughness}};

/// The statements of one material, which come in any order.
struct Statements {
  std::optional<Color> diffuse, specular, emission;
  std::optional<double> dissolve, transparency, exponent, metallic, roughness, illumination;
  std::map<MapRole, MapStatement> maps;
  std::optional<MapStatement> bump, normal;

  void add(std::string_view word, std::string_view rest) {
    if (word == "kd") parse_color(rest, diffuse);
    if (word == "ks") parse_color(rest, specular);
    if (word == "ke") parse_color(rest, emission);
    if (word == "d") parse_scalar(without_halo(rest), dissolve);
    if (word == "tr") parse_scalar(rest, transparency);
    if (word == "ns") parse_scalar(rest, exponent);
    if (word == "pm") parse_scalar(rest, metallic);
    if (word == "pr") parse_scalar(rest, roughness);
    if (word == "illum") parse_scalar(rest, illumination);
    add_map(word, rest);
  }

  /// No highlight: Ks is black, or the model of illumination has none.
  bool is_matt() const {
    return (specular && *specular == Color{}) || (illumination && *illumination < 2);
  }

 private:
  void add_map(std::string_view word, std::string_view rest) {
    const auto* const known =
        std::ranges::find(kMapWords, word, &std::pair<std::string_view, MapRole>::first);
    const bool is_bump = word == "bump" || word == "map_bump";
    const bool is_normal = word == "norm" || word == "map_norm" || word == "map_kn";
    if (known == std::end(kMapWords) && !is_bump && !is_normal) return;
    MapStatement statement = parse_map(rest);
    if (statement.file.empty()) return;
    if (is_bump)
      bump = std::move(statement);
    else if (is_normal)
      normal = std::move(statement);
    else
      maps[known->second] = std::move(statement);
  }
};

/// Makes materials of statements.
class MaterialMaker {
 public:
  explicit MaterialMaker(Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.images.size(); ++i)
      image_of_.emplace(scene.images[i].uri, static_cast<Index>(i));
  }

  void make(const Statements& in, Material& out) {
    const auto has = [&](MapRole role) { return in.maps.contains(role); };
    constexpr Color kWhite{1, 1, 1};
    std::ranges::copy(in.diffuse.value_or(kWhite), out.base_color.begin());
    out.emissive = in.emission.value_or(has(MapRole::emissive) ? kWhite : Color{});
    out.base_color[3] = in.dissolve.value_or(1 - in.transparency.value_or(0));
    out.metallic = in.metallic.value_or(has(MapRole::metallic) ? 1 : 0);
    out.roughness = in.roughness.value_or(has(MapRole::roughness) ? 1 : roughness_of(in));
    if (out.base_color[3] < 1 || has(MapRole::opacity)) out.alpha_mode = AlphaMode::blend;
    for (const auto& [role, statement] : in.maps) add(role, statement, out);
    if (in.normal || in.bump) add(MapRole::normal, in.normal ? *in.normal : *in.bump, out);
    join_maps(in, out);
  }

 private:
  static double roughness_of(const Statements& in) {
    if (in.is_matt() || !in.exponent || !(*in.exponent >= 0)) return 1;
    return std::sqrt(2 / (*in.exponent + 2));
  }

  void add(MapRole role, const MapStatement& statement, Material& out) {
    TextureMap map = statement.map;
    map.role = role;
    if (role != MapRole::normal) map.strength = 1;
    map.image = image(statement.file);
    out.set_map(map);
  }

  static bool same_place(const TextureMap& a, const TextureMap& b) {
    return a.image == b.image && a.offset == b.offset && a.scale == b.scale;
  }

  /// Channels of one image: the colour's alpha, roughness and metallic side by side.
  static void join_maps(const Statements& in, Material& out) {
    const auto remove = [&](MapRole role) {
      std::erase_if(out.maps, [&](const TextureMap& map) { return map.role == role; });
    };
    const auto channel = [&](MapRole role) { return in.maps.at(role).channel; };
    const TextureMap *color = out.map(MapRole::base_color), *opacity = out.map(MapRole::opacity);
    if (color && opacity && same_place(*color, *opacity) && channel(MapRole::opacity) == 'm')
      remove(MapRole::opacity);
    const TextureMap *metallic = out.map(MapRole::metallic), *rough = out.map(MapRole::roughness);
    if (!metallic || !rough || !same_place(*metallic, *rough) ||
        channel(MapRole::metallic) != 'b' || channel(MapRole::roughness) != 'g')
      return;
    TextureMap both = *rough;
    both.role = MapRole::metallic_roughness;
    remove(MapRole::metallic);
    remove(MapRole::roughness);
    out.set_map(both);
  }

  Index image(const std::string& uri) {
    const auto [at, is_new] = image_of_.emplace(uri, static_cast<Index>(scene_.images.size()));
    if (is_new) scene_.images.push_back({.name = {}, .uri = uri, .mime_type = {}, .data = {}});
    return at->second;
  }

  Scene& scene_;
  std::map<std::string, Index> image_of_;
};

}  // namespace

Material named_material(std::string name) {
  Material material;
  material.name = std::move(name);
  material.metallic = 0;  // MTL's own model is diffuse plus gloss
  return material;
}

Result<void> read_mtl(std::string_view text, Scene& scene, const Limits& limits) {
  MaterialMaker maker(scene);
  std::optional<Statements> statements;
  const auto finish = [&] {
    if (statements) maker.make(*statements, scene.materials.back());
  };
  const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(line_end), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string word = lower_case(next_word(line));
    if (word == "newmtl") {
      if (scene.materials.size() >= limits.meshes)
        return fail(ErrorCode::over_limit, "more materials than the limit allows");
      finish();
      scene.materials.push_back(named_material(clean_name(line)));
      statements.emplace();
    } else if (statements) {
      statements->add(word, line);
    }
  }
  finish();
  return {};
}

}  // namespace pstrips::inline formats::obj
