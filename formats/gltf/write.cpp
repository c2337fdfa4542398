#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/base64.h"
#include "formats/gltf/asset_buffer.h"
#include "formats/gltf/container.h"
#include "formats/gltf/extensions/extension.h"
#include "formats/gltf/image_type.h"
#include "formats/gltf/kept_asset.h"
#include "formats/gltf/topology.h"

namespace pstrips::inline formats {
namespace gltf {
namespace {

double finite_or(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

/// About what a model's meshes take in the buffer.
std::size_t expected_bytes(const Model& model) {
  std::size_t bytes = 0;
  for (const Mesh& mesh : model.meshes) {
    bytes += mesh.wedge_count() * mesh.position.element_bytes() + 4 * mesh.corners.size();
    for (const Attribute& attribute : mesh.wedge_attributes) bytes += attribute.data.size();
  }
  return bytes;
}

class AssetWriter {
 public:
  AssetWriter(const Model& model, const GltfWriteOptions& options)
      : model_(model), options_(options), kept_(find_kept_asset(model)) {
    const ByteView chunks = find_foreign(model.scene, kChunksKey);
    if (!chunks.empty() && !options.binary) dropped_.push_back("unknown chunks of the .glb file");
    if (!kept_ && !find_foreign(model.scene, kRestKey).empty())
      dropped_.push_back("the rest of the glTF asset: the model no longer has its meshes");
  }

  Result<GltfFiles> write() {
    buffer_.reserve(expected_bytes(model_));
    if (kept_) {
      root_ = std::move(kept_->root);
      json views = take_list("bufferViews"), accessors = take_list("accessors");
      buffer_.start_with(find_foreign(model_.scene, kBinKey), std::move(views),
                         std::move(accessors));
      restore_meshes();
    } else {
      root_["asset"] = {{"version", "2.0"}, {"generator", "pstrips"}};
      add_materials();
      add_meshes_and_nodes();
    }
    add_images();
    buffer_.add_index_views();
    for (const std::string_view name : extensions_required_)
      list_in("extensionsRequired").push_back(name);
    for (const std::string_view name : extensions_used_) list_in("extensionsUsed").push_back(name);
    if (json accessors = buffer_.take_accessors(); !accessors.empty())
      root_["accessors"] = std::move(accessors);
    if (json views = buffer_.take_views(); !views.empty()) root_["bufferViews"] = std::move(views);
    return finish();
  }

 private:
  json take_list(const char* key) {
    json list = root_.contains(key) ? std::move(root_[key]) : json::array();
    root_.erase(key);
    return list;
  }

  // ---- meshes ----

  /// The members that all primitives of a mesh have in common.
  json attributes_of(std::size_t m) {
    FitOptions fit;
    if (kept_) {
      const PrimitiveMap::Layout& layout = kept_->map.layouts[m];
      fit = {true, layout.targets, &layout.mat2};
    }
    json out = {{"attributes", json::object()}};
    std::vector<json> targets(fit.targets, json::object());
    bool has_targets = false;
    for (const Fitted& fitted : fit_attributes(model_.meshes[m], fit, dropped_)) {
      const std::size_t accessor = buffer_.add_attribute(fitted);
      note_extensions(fitted);
      if (fitted.target == kNone) {
        out["attributes"][fitted.name] = accessor;
        continue;
      }
      has_targets = true;
      if (fitted.target >= targets.size()) targets.resize(fitted.target + 1, json::object());
      targets[fitted.target][fitted.name] = accessor;
    }
    if (has_targets) out["targets"] = std::move(targets);
    return out;
  }

  void note_extensions(const Fitted& attribute) {
    for (const Extension* extension : extensions())
      if (extension->writes_attribute && extension->writes_attribute(attribute)) {
        extensions_used_.insert(extension->name);
        extensions_required_.insert(extension->name);
      }
  }

  json make_primitive(const json& attributes, const IndexList& list, const Group& group) {
    json out = attributes;
    out["indices"] = buffer_.add_indices(list.indices);
    if (list.mode != Mode::triangles) out["mode"] = static_cast<int>(list.mode);
    if (group.material < model_.scene.materials.size()) out["material"] = group.material;
    return out;
  }

  /// What reads as a primitive without faces: valid glTF as far as there is any.
  static IndexList without_faces(const Mesh& mesh, FaceKind kind) {
    if (kind == FaceKind::lines)
      return {Mode::line_strip, std::vector<Index>(mesh.wedge_count() > 0 ? 1 : 0)};
    if (kind == FaceKind::points) return {Mode::points, {}};
    return {Mode::strip, std::vector<Index>(mesh.wedge_count() > 0 ? 3 : 0)};
  }

  void note_face_data(const Mesh& mesh) {
    for (const Attribute& attribute : mesh.face_attributes)
      dropped_.push_back("face attribute " + attribute.semantic);
    if (std::ranges::any_of(mesh.groups, [](const Group& g) { return !g.name.empty(); }))
      dropped_.push_back("group names of mesh " + mesh.name);
  }

  void restore_meshes() {
    std::vector<json> attributes;
    std::vector<std::vector<std::vector<IndexList>>> lists;
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
      attributes.push_back(attributes_of(m));
      lists.push_back(index_lists(model_.meshes[m], options_, dropped_));
      note_face_data(model_.meshes[m]);
    }
    for (std::size_t i = 0; i < kept_->map.meshes.size(); ++i) {
      json& gltf_mesh = root_["meshes"][i];
      json primitives = json::array();
      for (std::size_t p = 0; p < kept_->map.meshes[i].size(); ++p) {
        const auto [m, g] = kept_->map.meshes[i][p];
        if (m == kNone) {
          primitives.push_back(std::move(gltf_mesh["primitives"][p]));
          continue;
        }
        const Mesh& mesh = model_.meshes[m];
        if (!mesh.name.empty()) gltf_mesh["name"] = mesh.name;
        if (lists[m][g].empty()) lists[m][g].push_back(without_faces(mesh, mesh.groups[g].kind));
        for (const IndexList& list : lists[m][g]) {
          json primitive = gltf_mesh["primitives"][p];
          primitive.update(make_primitive(attributes[m], list, mesh.groups[g]));
          primitives.push_back(std::move(primitive));
        }
      }
      gltf_mesh["primitives"] = std::move(primitives);
    }
  }

  /// The place of a mesh in a new asset, kNone when it has no vertices.
  Index add_mesh(std::size_t m) {
    const Mesh& mesh = model_.meshes[m];
    note_face_data(mesh);
    if (mesh.wedge_count() == 0) {
      dropped_.push_back("mesh " + mesh.name + ", which has no vertices");
      return kNone;
    }
    const json attributes = attributes_of(m);
    json primitives = json::array();
    const auto lists = index_lists(mesh, options_, dropped_);
    for (std::size_t g = 0; g < lists.size(); ++g)
      for (const IndexList& list : lists[g])
        primitives.push_back(make_primitive(attributes, list, mesh.groups[g]));
    if (primitives.empty()) {  // vertices alone are a cloud of points
      primitives.push_back(attributes);
      primitives.back()["mode"] = static_cast<int>(Mode::points);
      const Index material = mesh.groups.front().material;
      if (material < model_.scene.materials.size()) primitives.back()["material"] = material;
    }
    json out = {{"primitives", std::move(primitives)}};
    if (!mesh.name.empty()) out["name"] = mesh.name;
    root_["meshes"].push_back(std::move(out));
    return static_cast<Index>(root_["meshes"].size() - 1);
  }

  // ---- a new scene ----

  void add_meshes_and_nodes() {
    std::vector<Index> place;
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) place.push_back(add_mesh(m));
    std::vector<Node> nodes = model_.scene.nodes;
    if (nodes.empty())
      for (Index m = 0; m < place.size(); ++m) nodes.push_back({.name = {}, .meshes = {m}});
    json scene = json::object(), list = json::array(), more = json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      json node = make_node(nodes[i]);
      std::vector<Index> meshes;
      for (const Index m : nodes[i].meshes)
        if (m < place.size() && place[m] != kNone) meshes.push_back(place[m]);
      if (meshes.size() == 1) node["mesh"] = meshes.front();
      if (meshes.size() > 1)
        for (const Index mesh : meshes) {  // a node of glTF has one mesh
          node["children"].push_back(nodes.size() + more.size());
          more.push_back({{"mesh", mesh}});
        }
      list.push_back(std::move(node));
      const Index parent = nodes[i].parent;
      (parent < i ? list[parent]["children"] : scene["nodes"]).push_back(i);
    }
    for (json& node : more) list.push_back(std::move(node));
    if (list.empty()) return;
    root_["nodes"] = std::move(list);
    root_["scenes"] = json::array({std::move(scene)});
    root_["scene"] = 0;
  }

  json make_node(const Node& node) {
    json out = json::object();
    if (!node.name.empty()) out["name"] = node.name;
    if (!std::ranges::all_of(node.matrix, [](double x) { return std::isfinite(x); }))
      dropped_.push_back("the matrix of node " + node.name + ", which is not finite");
    else if (node.matrix != Node{}.matrix)
      out["matrix"] = node.matrix;
    return out;
  }

  void add_materials() {
    for (const Material& material : model_.scene.materials) {
      json pbr = json::object(), out = json::object();
      const auto share = [](double x) { return std::clamp(finite_or(x, 1), 0.0, 1.0); };
      std::array<double, 4> color;
      std::ranges::transform(material.base_color, color.begin(), share);
      std::array<double, 3> light;
      std::ranges::transform(material.emissive, light.begin(), share);
      if (color != material.base_color || light != material.emissive ||
          share(material.metallic) != material.metallic ||
          share(material.roughness) != material.roughness)
        dropped_.push_back("factors of material " + material.name + " beyond 0 to 1");
      pbr["baseColorFactor"] = color;
      pbr["metallicFactor"] = share(material.metallic);
      pbr["roughnessFactor"] = share(material.roughness);
      if (material.base_color_image < model_.scene.images.size())
        pbr["baseColorTexture"] = {{"index", material.base_color_image}};
      out["pbrMetallicRoughness"] = std::move(pbr);
      out["emissiveFactor"] = light;
      if (material.double_sided) out["doubleSided"] = true;
      if (!material.name.empty()) out["name"] = material.name;
      root_["materials"].push_back(std::move(out));
    }
    for (std::size_t i = 0; i < model_.scene.images.size(); ++i)
      root_["textures"].push_back(make_texture(i));
  }

  json make_texture(std::size_t image) {
    json texture = json::object();
    for (const Extension* extension : extensions())
      if (extension->writes_image && extension->writes_image(model_.scene.images[image])) {
        texture["extensions"][extension->name]["source"] = image;
        extensions_used_.insert(extension->name);
        return texture;
      }
    texture["source"] = image;
    return texture;
  }

  void add_images() {
    // URIs of a model that was glTF once are encoded already.
    const bool encoded = !find_foreign(model_.scene, kRestKey).empty();
    for (std::size_t i = 0; i < model_.scene.images.size(); ++i) {
      const Image& image = model_.scene.images[i];
      if (!kept_) root_["images"].push_back(json::object());
      json& out = root_["images"][i];
      if (!image.name.empty()) out["name"] = image.name;
      if (!image.mime_type.empty()) out["mimeType"] = image.mime_type;
      if (!image.data.empty()) {
        out["bufferView"] = buffer_.add_view(image.data);
      } else if (!image.uri.empty()) {
        std::string path = image.uri;
        if (!encoded) std::ranges::replace(path, '\\', '/');
        out["uri"] = encoded ? path : percent_encode(path);
      }
      if (!kept_ && !is_image_of(image, {"png", "jpg", "jpeg", "ktx2", "webp"}))
        dropped_.push_back("image " + (image.uri.empty() ? image.name : image.uri) +
                           " is of a format that glTF does not know; viewers may not show it");
    }
  }

  // ---- files ----

  json& list_in(const char* key) {
    json& list = root_[key];
    if (!list.is_array()) list = json::array();
    return list;
  }

  Result<GltfFiles> finish() {
    if (buffer_.size() > std::numeric_limits<std::uint32_t>::max())
      return fail(ErrorCode::over_limit, "the buffer would reach 4 GiB");
    GltfFiles out;
    Bytes buffer = buffer_.take_bytes();
    if (!buffer.empty()) {
      json entry = {{"byteLength", buffer.size()}};
      if (!options_.binary)
        entry["uri"] = options_.embed ? "data:application/octet-stream;base64," + base64(buffer)
                                      : percent_encode(options_.buffer_name);
      root_["buffers"] = json::array({std::move(entry)});
    }
    // Names may come from files whose text is no UTF-8.
    const std::string text =
        root_.dump(options_.binary ? -1 : 2, ' ', false, json::error_handler_t::replace);
    if (options_.binary) {
      Result<Bytes> glb = join(text, buffer, find_foreign(model_.scene, kChunksKey));
      if (!glb) return tl::unexpected(std::move(glb).error());
      out.main = std::move(*glb);
    } else {
      const ByteView bytes = as_bytes(text);
      out.main.assign(bytes.begin(), bytes.end());
      if (!buffer.empty() && !options_.embed)
        out.others.emplace_back(options_.buffer_name, std::move(buffer));
    }
    out.dropped = std::move(dropped_);
    return out;
  }

  const Model& model_;
  const GltfWriteOptions& options_;
  std::optional<KeptAsset> kept_;
  json root_ = json::object();
  AssetBuffer buffer_;
  std::set<std::string_view> extensions_used_, extensions_required_;  ///< beside the kept ones
  std::vector<std::string> dropped_;
};

}  // namespace
}  // namespace gltf

Result<GltfFiles> write_gltf(const Model& model, const GltfWriteOptions& options) {
  return gltf::AssetWriter(model, options).write();
}

}  // namespace pstrips::inline formats
