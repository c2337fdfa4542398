#include "formats/obj/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

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

/// One number stands for all three channels.
bool parse_color(std::string_view text, std::span<double, 3> color) {
  const Numbers numbers = parse_numbers(text);
  if (numbers.count != 1 && numbers.count != 3) return false;
  for (std::size_t i = 0; i < 3; ++i) color[i] = numbers.value[numbers.count == 1 ? 0 : i];
  return true;
}

bool parse_scalar(std::string_view text, double& value) {
  const Numbers numbers = parse_numbers(text);
  if (numbers.count > 0) value = numbers.value[0];
  return numbers.count > 0;
}

/// The most values an option of a texture map takes; -1 for what is no option. [WavefrontMtl]
int option_values(std::string_view word) {
  constexpr std::pair<std::string_view, int> kOptions[] = {
      {"-blendu", 1}, {"-blendv", 1}, {"-cc", 1},   {"-clamp", 1},     {"-mm", 2},
      {"-o", 3},      {"-s", 3},      {"-t", 3},    {"-texres", 1},    {"-imfchan", 1},
      {"-bm", 1},     {"-boost", 1},  {"-type", 1}, {"-colorspace", 1}};
  const auto* found = std::ranges::find(kOptions, word, &std::pair<std::string_view, int>::first);
  return found == std::end(kOptions) ? -1 : found->second;
}

/// The file of a map statement: all that follows its options, spaces included.
std::string map_file(std::string_view text) {
  for (;;) {
    text = trimmed(text);
    std::string_view rest = text;
    int values = option_values(next_word(rest));
    if (values < 0) break;
    const bool numeric = values > 1;  // -o -s -t take one to three numbers, -mm two
    for (text = rest; values > 0; --values, text = rest) {
      const std::string_view word = next_word(rest);
      Number ignored;
      if (numeric &&
          (word.empty() || !parse_number(word.data(), word.data() + word.size(), ignored)))
        break;
    }
  }
  std::string uri = clean_name(text);
  std::ranges::replace(uri, '\\', '/');
  return uri;
}

/// Reads one material after the other; the statements of a material come in any order.
class MtlReader {
 public:
  explicit MtlReader(Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.images.size(); ++i)
      image_of_.emplace(scene.images[i].uri, static_cast<Index>(i));
  }

  void begin(std::string_view name) {
    scene_.materials.push_back(named_material(clean_name(name)));
    has_dissolve_ = has_roughness_ = false;
  }

  void statement(std::string_view word, std::string_view rest) {
    if (scene_.materials.empty()) return;
    Material& material = scene_.materials.back();
    std::array<double, 3> color{};
    double value = 0;
    if (word == "Kd" && parse_color(rest, color)) {
      std::ranges::copy(color, material.base_color.begin());
    } else if (word == "Ke" && parse_color(rest, color)) {
      material.emissive = color;
    } else if (word == "d" && parse_scalar(without_halo(rest), value)) {
      material.base_color[3] = value;
      has_dissolve_ = true;
    } else if (word == "Tr" && !has_dissolve_ && parse_scalar(rest, value)) {
      material.base_color[3] = 1 - value;
    } else if (word == "Pm" && parse_scalar(rest, value)) {
      material.metallic = value;
    } else if (word == "Pr" && parse_scalar(rest, value)) {
      material.roughness = value;
      has_roughness_ = true;
    } else if (word == "Ns" && !has_roughness_ && parse_scalar(rest, value) && value >= 0) {
      // The exponent of Blinn's lobe that fits a Beckmann lobe of this roughness. [Walter07 §5.2]
      material.roughness = std::sqrt(2 / (value + 2));
    } else if (word == "map_Kd") {
      const std::string uri = map_file(rest);
      if (!uri.empty()) material.base_color_image = image(uri);
    }
  }

 private:
  static std::string_view without_halo(std::string_view text) {
    std::string_view rest = text;
    return next_word(rest) == "-halo" ? rest : text;
  }

  Index image(const std::string& uri) {
    const auto [at, is_new] = image_of_.emplace(uri, static_cast<Index>(scene_.images.size()));
    if (is_new) scene_.images.push_back({.name = {}, .uri = uri, .mime_type = {}, .data = {}});
    return at->second;
  }

  Scene& scene_;
  std::map<std::string, Index> image_of_;
  bool has_dissolve_ = false, has_roughness_ = false;
};

void append_statement(std::string& out, std::string_view word, std::span<const double> values) {
  out += word;
  for (const double value : values) append_number(out += ' ', value);
  out += '\n';
}

}  // namespace

Material named_material(std::string name) {
  Material material;
  material.name = std::move(name);
  material.metallic = 0;  // MTL's own model is diffuse plus gloss
  return material;
}

Result<void> read_mtl(std::string_view text, Scene& scene, const Limits& limits) {
  MtlReader reader(scene);
  const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(line_end), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view word = next_word(line);
    if (word == "newmtl") {
      if (scene.materials.size() >= limits.meshes)
        return fail(ErrorCode::over_limit, "more materials than the limit allows");
      reader.begin(line);
    } else {
      reader.statement(word, line);
    }
  }
  return {};
}

std::string write_mtl(const Scene& scene, const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    const std::span<const double> color = material.base_color;
    out += "newmtl " + names[i] + '\n';
    append_statement(out, "Kd", color.first(3));
    if (color[3] != 1) append_statement(out, "d", color.subspan(3));
    if (material.emissive != std::array<double, 3>{})
      append_statement(out, "Ke", material.emissive);
    append_statement(out, "Pm", std::span(&material.metallic, 1));
    append_statement(out, "Pr", std::span(&material.roughness, 1));
    if (material.base_color_image != kNone) {
      const std::string uri = clean_name(scene.images[material.base_color_image].uri);
      if (!uri.empty()) out += "map_Kd " + uri + '\n';
    }
  }
  return out;
}

}  // namespace pstrips::inline formats::obj
