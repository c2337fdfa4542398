#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/gltf/container.h"
#include "formats/gltf/fit.h"
#include "formats/gltf/primitives.h"
#include "formats/gltf/topology.h"

namespace pstrips::inline formats {
namespace gltf {
namespace {

using nlohmann::json;

ByteView find_foreign(const Scene& scene, std::string_view key) {
  const auto found = std::ranges::find(scene.foreign, key, &Foreign::key);
  return found == scene.foreign.end() ? ByteView{} : ByteView(found->data);
}

bool is_list_of(const json& root, const char* key, std::size_t count) {
  const auto list = root.find(key);
  if (list == root.end()) return count == 0;
  return list->is_array() && list->size() == count &&
         std::ranges::all_of(*list, [](const json& element) { return element.is_object(); });
}

/// A list of objects of any length, or nothing.
bool is_list(const json& root, const char* key) {
  const auto list = root.find(key);
  return list == root.end() || (list->is_array() && is_list_of(root, key, list->size()));
}

/// The asset as it was read, when it still speaks of this model.
struct Kept {
  json root;
  PrimitiveMap map;
};

std::optional<Kept> find_kept(const Model& model) {
  const std::string_view text = as_text(find_foreign(model.scene, kRestKey));
  auto map = PrimitiveMap::read(find_foreign(model.scene, kPrimitivesKey));
  if (text.empty() || !map || !map->fits(model.meshes)) return std::nullopt;
  if (nests_deeper(text, Limits{}.xml_depth)) return std::nullopt;
  Kept out{json::parse(text, nullptr, false), std::move(*map)};
  const json& root = out.root;
  if (!root.is_object() || !is_list_of(root, "meshes", out.map.meshes.size()) ||
      !is_list_of(root, "materials", model.scene.materials.size()) ||
      !is_list_of(root, "images", model.scene.images.size()) || !is_list(root, "accessors") ||
      !is_list(root, "bufferViews"))
    return std::nullopt;
  for (std::size_t m = 0; m < out.map.meshes.size(); ++m)
    if (!is_list_of(root["meshes"][m], "primitives", out.map.meshes[m].size())) return std::nullopt;
  std::uint64_t targets = 0;
  for (const PrimitiveMap::Layout& layout : out.map.layouts) targets += layout.targets;
  return targets <= kMaxTargets ? std::optional(std::move(out)) : std::nullopt;
}

int component_type(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
      return 5120;
    case ComponentType::u8:
      return 5121;
    case ComponentType::i16:
      return 5122;
    case ComponentType::u16:
      return 5123;
    case ComponentType::u32:
      return 5125;
    default:
      return 5126;
  }
}

json number(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15)
    return value == 0 ? json(0) : json(static_cast<std::int64_t>(value));
  return value;
}

/// Adds min and max over the finite values; both are 0 where there is none.
void add_bounds(json& accessor, Attribute attribute) {
  attribute.normalized = false;  // bounds are of the stored numbers
  accessor["min"] = json::array();
  accessor["max"] = json::array();
  for (std::size_t c = 0; c < attribute.count; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const bool is_float = attribute.type == ComponentType::f32;
    const std::byte* at = attribute.data.data() + c * size_of(attribute.type);
    for (std::size_t i = 0; i < attribute.elements(); ++i, at += attribute.element_bytes()) {
      float single = 0;
      if (is_float) std::memcpy(&single, at, sizeof single);
      const double value = is_float ? single : component(attribute, i, c);
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    accessor["min"].push_back(number(low <= high ? low : 0));
    accessor["max"].push_back(number(low <= high ? high : 0));
  }
}

template <class T>
std::vector<T> narrowed(const std::vector<Index>& indices) {
  std::vector<T> out(indices.size());
  std::ranges::transform(indices, out.begin(), [](Index i) { return static_cast<T>(i); });
  return out;
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

/// Elements at multiples of four bytes, as are the columns of matrices.
Bytes aligned_elements(const Attribute& attribute, std::uint8_t rows, std::size_t& stride) {
  const std::size_t column = size_of(attribute.type) * (rows == 0 ? attribute.count : rows);
  const std::size_t padded = (column + 3) / 4 * 4;
  stride = attribute.element_bytes() / column * padded;
  Bytes out(attribute.elements() * stride);
  const std::size_t columns = attribute.data.size() / column;
  for (std::size_t k = 0; k < columns; ++k)
    std::memcpy(out.data() + k * padded, attribute.data.data() + k * column, column);
  return out;
}

/// Whether the MIME type, or without one the file's ending, is among those named.
bool is_image_of(const Image& image, std::initializer_list<std::string_view> endings) {
  const std::string& name = image.mime_type.empty() ? image.uri : image.mime_type;
  const std::size_t dot = name.find_last_of("./");
  std::string ending = dot == std::string::npos ? "" : name.substr(dot + 1);
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::ranges::find(endings, ending) != endings.end();
}

/// The extension by which a texture names an image that is neither PNG nor JPEG.
const char* texture_extension(const Image& image) {
  if (is_image_of(image, {"ktx2"})) return "KHR_texture_basisu";
  return is_image_of(image, {"webp"}) ? "EXT_texture_webp" : nullptr;
}

double finite_or(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

class AssetWriter {
 public:
  AssetWriter(const Model& model, const GltfWriteOptions& options)
      : model_(model), options_(options), kept_(find_kept(model)) {
    const ByteView chunks = find_foreign(model.scene, kChunksKey);
    if (!chunks.empty() && !options.binary) dropped_.push_back("unknown chunks of the .glb file");
    if (!kept_ && !find_foreign(model.scene, kRestKey).empty())
      dropped_.push_back("the rest of the glTF asset: the model no longer has its meshes");
  }

  Result<GltfFiles> write() {
    bin_.reserve(expected_bytes(model_));
    if (kept_) {
      root_ = std::move(kept_->root);
      bin_.bytes(find_foreign(model_.scene, kBinKey));
      bin_.align(4);
      accessors_ = take_list("accessors");
      views_ = take_list("bufferViews");
      restore_meshes();
    } else {
      root_["asset"] = {{"version", "2.0"}, {"generator", "pstrips"}};
      add_materials();
      add_meshes_and_nodes();
    }
    add_images();
    add_index_views();
    if (quantized_) {
      extensions_used_.emplace(kQuantization);
      list_in("extensionsRequired").push_back(kQuantization);
    }
    for (const std::string& name : extensions_used_) list_in("extensionsUsed").push_back(name);
    if (!accessors_.empty()) root_["accessors"] = std::move(accessors_);
    if (!views_.empty()) root_["bufferViews"] = std::move(views_);
    return finish();
  }

 private:
  json take_list(const char* key) {
    json list = root_.contains(key) ? std::move(root_[key]) : json::array();
    root_.erase(key);
    return list;
  }

  // ---- binary data ----

  std::size_t add_view(ByteView bytes) {
    bin_.align(4);
    json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (bin_.size() > 0) view["byteOffset"] = bin_.size();
    bin_.bytes(bytes);
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }

  std::size_t add_attribute(const Fitted& fitted) {
    const Attribute& attribute = fitted.attribute();
    json accessor = {{"componentType", component_type(attribute.type)},
                     {"count", attribute.elements()},
                     {"type", fitted.type}};
    if (attribute.normalized) accessor["normalized"] = true;
    if (fitted.needs_bounds()) add_bounds(accessor, attribute);
    if (attribute.elements() > 0) {
      std::size_t stride = attribute.element_bytes();
      const bool is_aligned = fitted.rows == 0 && stride % 4 == 0;
      const Bytes aligned = is_aligned ? Bytes{} : aligned_elements(attribute, fitted.rows, stride);
      const std::size_t view = add_view(is_aligned ? attribute.data : aligned);
      views_[view]["target"] = 34962;
      if (!is_aligned) views_[view]["byteStride"] = stride;
      accessor["bufferView"] = view;
    }
    quantized_ |= fitted.needs_quantization();
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  /// An index type's largest value would mean a restart. [glTF 2.0 §3.7.2.1]
  std::size_t add_indices(const std::vector<Index>& indices) {
    const Index largest = indices.empty() ? 0 : *std::ranges::max_element(indices);
    const ComponentType type = largest < 0xff     ? ComponentType::u8
                               : largest < 0xffff ? ComponentType::u16
                                                  : ComponentType::u32;
    json accessor = {
        {"componentType", component_type(type)}, {"count", indices.size()}, {"type", "SCALAR"}};
    if (!indices.empty()) {
      ByteWriter& stream = index_streams_[type];
      if (stream.size() > 0) accessor["byteOffset"] = stream.size();
      index_accessors_.emplace_back(accessors_.size(), type);
      if (type == ComponentType::u8)
        stream.array<std::uint8_t>(narrowed<std::uint8_t>(indices));
      else if (type == ComponentType::u16)
        stream.array<std::uint16_t>(narrowed<std::uint16_t>(indices));
      else
        stream.array<Index>(indices);
    }
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  void add_index_views() {
    std::map<ComponentType, std::size_t> view;
    for (const auto& [type, stream] : index_streams_) {
      view[type] = add_view(stream.view());
      views_[view[type]]["target"] = 34963;
    }
    for (const auto& [accessor, type] : index_accessors_)
      accessors_[accessor]["bufferView"] = view[type];
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
      const std::size_t accessor = add_attribute(fitted);
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

  json make_primitive(const json& attributes, const IndexList& list, const Group& group) {
    json out = attributes;
    out["indices"] = add_indices(list.indices);
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
      lists.push_back(index_lists(model_.meshes[m], options_.topology, dropped_));
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
    const auto lists = index_lists(mesh, options_.topology, dropped_);
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
    for (std::size_t i = 0; i < model_.scene.images.size(); ++i) {
      json texture = json::object();
      const char* extension = texture_extension(model_.scene.images[i]);
      if (extension == nullptr) {
        texture["source"] = i;
      } else {
        texture["extensions"][extension]["source"] = i;
        extensions_used_.insert(extension);
      }
      root_["textures"].push_back(std::move(texture));
    }
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
        out["bufferView"] = add_view(image.data);
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
    if (bin_.size() > std::numeric_limits<std::uint32_t>::max())
      return fail(ErrorCode::over_limit, "the buffer would reach 4 GiB");
    GltfFiles out;
    Bytes buffer = std::move(bin_).take();
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
  std::optional<Kept> kept_;
  json root_ = json::object(), accessors_ = json::array(), views_ = json::array();
  ByteWriter bin_;
  std::map<ComponentType, ByteWriter> index_streams_;
  std::vector<std::pair<std::size_t, ComponentType>> index_accessors_;
  bool quantized_ = false;
  std::set<std::string> extensions_used_;  ///< those that the kept asset does not name
  std::vector<std::string> dropped_;
};

}  // namespace
}  // namespace gltf

Result<GltfFiles> write_gltf(const Model& model, const GltfWriteOptions& options) {
  return gltf::AssetWriter(model, options).write();
}

}  // namespace pstrips::inline formats
