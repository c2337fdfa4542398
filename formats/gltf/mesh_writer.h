#pragma once

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "core/notes.h"
#include "core/point.h"
#include "formats/gltf/asset_buffer.h"
#include "formats/gltf/gltf.h"
#include "formats/gltf/primitives.h"
#include "formats/gltf/set_numbers.h"
#include "formats/gltf/topology.h"

namespace pstrips::inline formats::gltf {

/// Turns a model's meshes into primitives over the buffer of an asset. All that it is given must
/// outlive it.
class MeshWriter {
 public:
  /// layouts  of the meshes, when they came from glTF; else null
  MeshWriter(const Model& model, const GltfWriteOptions& options,
             const std::vector<PrimitiveMap::Layout>* layouts, AssetBuffer& buffer, Notes& notes);

  /// The mesh without what glTF cannot hold.
  const Mesh& mesh(std::size_t m) const { return finite_[m] ? *finite_[m] : model_.meshes[m]; }
  /// From where positions are counted.
  const std::optional<Point>& origin() const { return origin_; }

  /// The primitives of each group; none of a group without faces, unless meshes came from glTF.
  ///
  /// materials  the asset's; gets another one for a mesh that lacks the coordinates of its textures
  std::vector<std::vector<json>> primitives(std::size_t m, json& materials);

  /// Beside those of what was kept. What is required is used, too.
  const std::set<std::string_view>& extensions() const { return extensions_; }

 private:
  json attributes_of(std::size_t m);
  void note_extensions(const Fitted& attribute);
  json primitive(const json& attributes, const IndexList& list, const Group& group,
                 json& materials);
  json points(const json& attributes, const Group& group, json& materials);
  void set_material(json& primitive, const Group& group, json& materials);
  void note_face_data(const Mesh& mesh);

  const Model& model_;
  const GltfWriteOptions& options_;
  const std::vector<PrimitiveMap::Layout>* layouts_;
  AssetBuffer& buffer_;
  Notes& notes_;
  std::vector<std::optional<Mesh>> finite_;
  std::optional<Point> origin_;
  TextureSets sets_;  ///< of the mesh at work
  std::map<std::pair<Index, TextureSets>, std::size_t> other_materials_;
  std::set<std::string_view> extensions_;
};

}  // namespace pstrips::inline formats::gltf
