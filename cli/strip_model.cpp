#include "cli/strip_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "core/mesh.h"
#include "core/strips.h"

namespace pstrips::cli {
namespace {

using Color = std::array<std::uint8_t, 3>;  // sRGB

// Twelve hues far from each other, neighbours in the list farthest.
constexpr std::array<Color, 12> kPalette = {{{230, 25, 75},
                                             {60, 180, 75},
                                             {0, 130, 200},
                                             {255, 225, 25},
                                             {145, 30, 180},
                                             {70, 240, 240},
                                             {245, 130, 48},
                                             {0, 0, 128},
                                             {210, 245, 60},
                                             {240, 50, 230},
                                             {0, 128, 128},
                                             {170, 110, 40}}};

double linear(std::uint8_t value) { return std::pow(value / 255.0, 2.2); }

void set_palette(Scene& scene) {
  scene.materials.clear();
  scene.images.clear();
  scene.foreign.clear();  // what a format keeps speaks of the materials that were
  for (std::size_t k = 0; k < kPalette.size(); ++k) {
    Material material;
    material.name = "strip color " + std::to_string(k + 1);
    for (std::size_t c = 0; c < 3; ++c) material.base_color[c] = linear(kPalette[k][c]);
    material.metallic = 0;
    scene.materials.push_back(std::move(material));
  }
}

// The mesh with the triangles of strips as its faces.
class StripMesh {
 public:
  StripMesh(const Mesh& mesh, const StripModelOptions& options, bool by_material)
      : mesh_(mesh), options_(options), by_material_(by_material), out_(mesh) {
    out_.corners.clear();
    out_.face_first.clear();
    out_.face_group.clear();
    out_.face_attributes.clear();
    if (options_.of_points) out_.groups.assign(1, {});
    if (splits()) out_.groups.clear();
  }

  Mesh build(const StripMap& map) && {
    std::span<const Index> rest = map.entries;
    for (Index g = 0; g < map.group_entries.size(); ++g) {
      add_group(rest.first(map.group_entries[g]), g);
      rest = rest.subspan(map.group_entries[g]);
    }
    if (options_.colored && !by_material_) out_.face_attributes.push_back(color_);
    if (out_.groups.empty()) out_.groups.assign(1, {});
    canonicalize(out_);
    return std::move(out_);
  }

 private:
  bool splits() const { return options_.a_group_each || (options_.colored && by_material_); }

  void add_group(std::span<const Index> entries, Index group) {
    while (!entries.empty()) {
      const auto end = std::ranges::find(entries, kRestart);
      const auto length = static_cast<std::size_t>(end - entries.begin());
      if (length > 0) add_strip(entries.first(length), group);
      entries = entries.subspan(std::min(length + 1, entries.size()));
    }
  }
  void add_strip(std::span<const Index> entries, Index group) {
    const std::size_t color = strips_++ % kPalette.size();
    if (splits()) {
      Group own = options_.of_points ? Group{} : mesh_.groups[group];
      if (options_.colored && by_material_) own.material = static_cast<Index>(color);
      group = static_cast<Index>(out_.groups.size());
      out_.groups.push_back(std::move(own));
    }
    for_each_triangle(
        entries, [&](Index w) { return mesh_.vertex_of(w); },
        [&](Index a, Index b, Index c) {
          out_.corners.insert(out_.corners.end(), {a, b, c});
          out_.face_group.push_back(group);
          for (const std::uint8_t part : kPalette[color]) color_.data.push_back(std::byte{part});
        });
  }

  const Mesh& mesh_;
  StripModelOptions options_;
  bool by_material_;
  Mesh out_;
  Attribute color_{"COLOR_0", ComponentType::u8, 3, true, {}};
  std::size_t strips_ = 0;
};

}  // namespace

void put_strips(Model& model, const std::vector<StripMap>& maps, FileFormat target,
                const StripModelOptions& options) {
  const bool by_material = holds(target, Feature::materials);
  for (std::size_t m = 0; m < maps.size(); ++m)
    model.meshes[m] = StripMesh(model.meshes[m], options, by_material).build(maps[m]);
  if (options.colored && by_material) set_palette(model.scene);
}

}  // namespace pstrips::cli
