#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline core {

/// A texture image, embedded or named.
struct Image {
  std::string name;
  std::string uri;        ///< relative path as the source file wrote it; may be empty
  std::string mime_type;  ///< "image/png" …; may be empty
  Bytes data;             ///< the encoded file when it was embedded, else empty
  friend bool operator==(const Image&, const Image&) = default;
};

/// What every target format can express of a material. Scene::foreign keeps the exact words of the
/// source format.
struct Material {
  std::string name;
  std::array<double, 4> base_color{1, 1, 1, 1};  ///< linear RGBA
  std::array<double, 3> emissive{0, 0, 0};
  double metallic = 1;
  double roughness = 1;
  Index base_color_image = kNone;  ///< into Scene::images
  bool double_sided = false;
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
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// What a mesh format reads and writes.
struct Model {
  Scene scene;
  std::vector<Mesh> meshes;
  friend bool operator==(const Model&, const Model&) = default;
};

}  // namespace pstrips::inline core
