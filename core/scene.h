#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline core {

/// A texture image, embedded or named.
struct Image {
  std::string name;
  /// Plain text (not percent-encoded), most often a path from the model's folder with '/' between
  /// its parts; nothing that a file says here is safe to open. May be empty.
  std::string uri;
  std::string mime_type;  ///< "image/png" …; may be empty
  Bytes data;             ///< the encoded file when it is embedded, else empty
  friend bool operator==(const Image&, const Image&) = default;
};

/// The corner of an image at which texture coordinates are (0, 0): the upper left one as in glTF,
/// or the lower left one as in OBJ and PLY. [spec/model.md §9]
enum class TextureOrigin : std::uint8_t { upper_left, lower_left };

/// What alpha means, as in glTF. [glTF §3.9.4]
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Which property of a material an image varies. Each image is multiplied by the material's factor.
enum class MapRole : std::uint8_t {
  base_color,          ///< RGB, and alpha where the material uses it
  opacity,             ///< luminance of an image of its own
  metallic,            ///< luminance
  roughness,           ///< luminance
  metallic_roughness,  ///< blue is metallic, green is roughness
  normal,              ///< tangent space
  occlusion,           ///< red
  emissive,            ///< RGB
};

/// An image on a surface. Texture coordinates go through scale, rotation (counter-clockwise for v
/// downwards) and offset, in this order, before they meet the image. [KHR_texture_transform]
struct TextureMap {
  MapRole role = MapRole::base_color;
  Index image = kNone;  ///< into Scene::images
  Index texcoord = 0;   ///< n of TEXCOORD_n
  double strength = 1;  ///< of a normal or occlusion map
  std::array<double, 2> offset{0, 0};
  std::array<double, 2> scale{1, 1};
  double rotation = 0;  ///< radians
  friend bool operator==(const TextureMap&, const TextureMap&) = default;
};

/// What every target format can express of a material. Scene::foreign keeps the exact words of the
/// source format.
struct Material {
  std::string name;
  std::array<double, 4> base_color{1, 1, 1, 1};  ///< linear RGBA
  std::array<double, 3> emissive{0, 0, 0};
  double metallic = 1;
  double roughness = 1;
  AlphaMode alpha_mode = AlphaMode::opaque;
  double alpha_cutoff = 0.5;  ///< with AlphaMode::mask
  bool double_sided = false;
  std::vector<TextureMap> maps{};  ///< ascending by role, each role at most once

  const TextureMap* map(MapRole role) const;  ///< null where there is none
  Index image(MapRole role) const;            ///< kNone where there is none
  /// Puts a map in its place; it replaces the one of the same role.
  void set_map(const TextureMap& map);
  friend bool operator==(const Material&, const Material&) = default;
};

/// A node of the scene graph. A parent comes before its children.
struct Node {
  std::string name;
  Index parent = kNone;
  std::array<double, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  ///< column-major
  std::vector<Index> meshes;  ///< into the model's meshes
  friend bool operator==(const Node&, const Node&) = default;
};

/// What a reader keeps for the writer of the same format: comments, unknown elements, the rest of a
/// glTF. Only the format named before the first '/' of the key reads or writes the data.
struct Foreign {
  std::string key;  ///< "ply/…", "obj/…", "gltf/…"; unique within a scene
  Bytes data;
  friend bool operator==(const Foreign&, const Foreign&) = default;
};

/// All of a model but its meshes.
struct Scene {
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<Node> nodes;  ///< may be empty: each mesh stands once, untransformed
  std::vector<Foreign> foreign;
  TextureOrigin texture_origin = TextureOrigin::upper_left;
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// What a mesh format reads and writes.
struct Model {
  Scene scene;
  std::vector<Mesh> meshes;
  friend bool operator==(const Model&, const Model&) = default;
};

}  // namespace pstrips::inline core
