#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/base64.h"
#include "formats/gltf/asset_buffer.h"
#include "formats/gltf/container.h"
#include "formats/gltf/extensions/extension.h"
#include "formats/gltf/image_type.h"
#include "formats/gltf/kept_asset.h"
#include "formats/gltf/materials.h"
#include "formats/gltf/mesh_writer.h"
#include "formats/gltf/needs.h"

namespace pstrips::inline formats {
namespace gltf {
namespace {

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
      : model_(model),
        options_(options),
        kept_(find_kept_asset(model)),
        meshes_(model, options, kept_ ? &kept_->map.layouts : nullptr, buffer_, notes_) {
    const ByteView chunks = find_foreign(model.scene, kChunksKey);
    if (!chunks.empty() && !options.binary)
      notes_.dropped.push_back("unknown chunks of the .glb file");
    if (!kept_ && !find_foreign(model.scene, kRestKey).empty())
      notes_.dropped.push_back("the rest of the glTF asset: the model no longer has its meshes");
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
    if (materials().empty()) root_.erase("materials");
    for (const std::string_view name : meshes_.extensions())
      list_in("extensionsRequired").push_back(name);
    image_extensions_.insert(meshes_.extensions().begin(), meshes_.extensions().end());
    for (const std::string_view name : image_extensions_) list_in("extensionsUsed").push_back(name);
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

  void restore_meshes() {
    std::vector<std::vector<std::vector<json>>> written;
    for (std::size_t m = 0; m < model_.meshes.size(); ++m)
      written.push_back(meshes_.primitives(m, materials()));
    for (std::size_t i = 0; i < kept_->map.meshes.size(); ++i) {
      json& gltf_mesh = root_["meshes"][i];
      json primitives = json::array();
      for (std::size_t p = 0; p < kept_->map.meshes[i].size(); ++p) {
        const auto [m, g] = kept_->map.meshes[i][p];
        if (m == kNone) {
          primitives.push_back(std::move(gltf_mesh["primitives"][p]));
          continue;
        }
        const Mesh& mesh = meshes_.mesh(m);
        if (!mesh.name.empty()) gltf_mesh["name"] = mesh.name;
        for (const json& part : written[m][g]) {
          json primitive = gltf_mesh["primitives"][p];
          primitive.update(part);
          primitives.push_back(std::move(primitive));
        }
      }
      gltf_mesh["primitives"] = std::move(primitives);
    }
    drop_unmet_needs(root_, notes_);
  }

  json& materials() { return root_["materials"]; }

  /// The place of a mesh in a new asset, kNone when it has no vertices.
  Index add_mesh(std::size_t m) {
    const Mesh& mesh = meshes_.mesh(m);
    if (mesh.wedge_count() == 0) {
      notes_.dropped.push_back("mesh " + mesh.name + ", which has no vertices");
      return kNone;
    }
    json primitives = json::array();
    for (auto& group : meshes_.primitives(m, materials()))
      for (json& primitive : group) primitives.push_back(std::move(primitive));
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
    const bool is_new = nodes.empty();
    if (is_new)
      for (Index m = 0; m < place.size(); ++m) nodes.push_back({.name = {}, .meshes = {m}});
    json scene = json::object(), list = json::array(), more = json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      json node = make_node(nodes[i]);
      std::vector<Index> meshes;
      for (const Index m : nodes[i].meshes)
        if (m < place.size() && place[m] != kNone) meshes.push_back(place[m]);
      // A node of glTF has one mesh, and its translation is its children's, too.
      if (meshes.size() == 1 && (is_new || !meshes_.origin()))
        node.update(placed_mesh(meshes.front()));
      else
        for (const Index mesh : meshes) {
          node["children"].push_back(nodes.size() + more.size());
          more.push_back(placed_mesh(mesh));
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

  /// The members of a node that shows a mesh where it was before its positions got an origin.
  json placed_mesh(Index mesh) const {
    json out = {{"mesh", mesh}};
    if (meshes_.origin()) out["translation"] = *meshes_.origin();
    return out;
  }

  json make_node(const Node& node) {
    json out = json::object();
    if (!node.name.empty()) out["name"] = node.name;
    if (!std::ranges::all_of(node.matrix, [](double x) { return std::isfinite(x); }))
      notes_.dropped.push_back("the matrix of node " + node.name + ", which is not finite");
    else if (node.matrix != Node{}.matrix)
      out["matrix"] = node.matrix;
    return out;
  }

  void add_materials() {
    MaterialWriter writer(model_.scene, image_extensions_, notes_.dropped);
    for (const Material& material : model_.scene.materials)
      root_["materials"].push_back(writer.write(material));
    for (std::size_t i = 0; i < model_.scene.images.size(); ++i)
      root_["textures"].push_back(make_texture(i));
  }

  json make_texture(std::size_t image) {
    json texture = json::object();
    for (const Extension* extension : extensions())
      if (extension->writes_image && extension->writes_image(model_.scene.images[image])) {
        texture["extensions"][extension->name]["source"] = image;
        image_extensions_.insert(extension->name);
        return texture;
      }
    texture["source"] = image;
    return texture;
  }

  void embed(const Image& image, json& out) {
    out.erase("uri");
    out["bufferView"] = buffer_.add_view(image.data);
    if (image.mime_type.empty()) out["mimeType"] = mime_type_of(image.data);
    if (image.name.empty() && !image.uri.empty()) out["name"] = image.uri;
  }

  /// A URI that the asset kept is left as it was written.
  static void set_uri(std::string path, json& out) {
    const auto kept = out.find("uri");
    if (kept != out.end() && kept->is_string() &&
        percent_decode(kept->get_ref<const std::string&>()) == path)
      return;
    std::ranges::replace(path, '\\', '/');
    out["uri"] = percent_encode(path);
  }

  void add_images() {
    for (std::size_t i = 0; i < model_.scene.images.size(); ++i) {
      const Image& image = model_.scene.images[i];
      if (!kept_) root_["images"].push_back(json::object());
      json& out = root_["images"][i];
      if (!image.name.empty()) out["name"] = image.name;
      if (!image.mime_type.empty()) out["mimeType"] = image.mime_type;
      if (!image.data.empty() && (options_.embed_images || image.uri.empty()))
        embed(image, out);
      else if (!image.uri.empty())
        set_uri(image.uri, out);
      if (!kept_ && !is_image_of(image, {"png", "jpg", "jpeg", "ktx2", "webp"}))
        notes_.dropped.push_back(
            "image " + (image.uri.empty() ? image.name : image.uri) +
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
    out.dropped = std::move(notes_.dropped);
    out.converted = std::move(notes_.converted);
    return out;
  }

  const Model& model_;
  const GltfWriteOptions& options_;
  std::optional<KeptAsset> kept_;
  json root_ = json::object();
  AssetBuffer buffer_;
  Notes notes_;
  MeshWriter meshes_;
  std::set<std::string_view> image_extensions_;  ///< of images and materials: used, not required
};

}  // namespace
}  // namespace gltf

Result<GltfFiles> write_gltf(const Model& model, const GltfWriteOptions& options) {
  return gltf::AssetWriter(model, options).write();
}

}  // namespace pstrips::inline formats
