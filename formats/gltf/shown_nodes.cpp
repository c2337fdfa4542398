#include "formats/gltf/shown_nodes.h"

#include <algorithm>

#include "formats/gltf/accessors.h"
#include "formats/gltf/kept_asset.h"
#include "formats/gltf/nodes.h"

namespace pstrips::inline formats {
namespace gltf {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// The nodes that the default scene names; all when the asset has no scenes.
std::vector<bool> roots_of(const json& root, std::size_t nodes) {
  const auto scenes = root.find("scenes");
  if (scenes == root.end() || !scenes->is_array() || scenes->empty())
    return std::vector<bool>(nodes, true);
  const std::size_t wanted =
      root.value("scene", json(0)).is_number_unsigned() ? root.value("scene", std::size_t{0}) : 0;
  const json& scene = (*scenes)[std::min(wanted, scenes->size() - 1)];
  std::vector<bool> out(nodes, false);
  if (!scene.is_object() || !scene.contains("nodes") || !scene["nodes"].is_array()) return out;
  for (const json& node : scene["nodes"])
    if (node.is_number_unsigned() && node.get<std::uint64_t>() < nodes)
      out[node.get<std::size_t>()] = true;
  return out;
}

/// The accessors that a reader kept, over the bytes that it kept.
class KeptAccessors {
 public:
  KeptAccessors(const json& root, ByteView bytes, const Limits& limits)
      : bytes_(bytes), budget_(limits) {
    const json part = {{"asset", {{"version", "2.0"}}},
                       {"buffers", json::array({{{"byteLength", bytes.size()}}})},
                       {"bufferViews", root.value("bufferViews", json::array())},
                       {"accessors", root.value("accessors", json::array())}};
    std::vector<std::string> dropped;
    document_ = parse(part.dump(), 0, limits, dropped);
  }

  /// Element after element. errors  corrupt when it is no accessor of `components` floats or
  /// normalized integers
  Result<Attribute> read(const json& accessor, std::uint8_t components) {
    if (!document_) return tl::unexpected(document_.error());
    if (!accessor.is_number_unsigned() ||
        accessor.get<std::uint64_t>() >= document_->accessors.size())
      return fail(ErrorCode::corrupt, "an attribute of instances refers to nothing");
    const Accessor& in = document_->accessors[accessor.get<std::size_t>()];
    if (in.components != components)
      return fail(ErrorCode::corrupt, "an attribute of instances is of another type");
    const ReadFile no_files;
    Data data(*document_, bytes_, no_files, budget_);
    Result<Bytes> bytes = data.elements(accessor.get<Index>());
    if (!bytes) return tl::unexpected(std::move(bytes).error());
    return Attribute{{}, in.type, in.components, in.normalized, std::move(*bytes)};
  }

 private:
  ByteView bytes_;
  Budget budget_;
  Result<Document> document_;
};

template <std::size_t n>
std::array<double, n> element_of(const std::optional<Attribute>& in, std::size_t i,
                                 std::array<double, n> otherwise) {
  for (std::size_t c = 0; in && c < n; ++c) otherwise[c] = component(*in, i, c);
  return otherwise;
}

Result<std::vector<Matrix4>> read_instances(KeptAccessors& accessors, const json& attributes) {
  constexpr std::pair<const char*, std::uint8_t> kNames[] = {
      {"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}};
  std::optional<Attribute> read[3];
  std::optional<std::size_t> count;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [name, components] = kNames[k];
    if (!attributes.contains(name)) continue;
    auto attribute = accessors.read(attributes[name], components);
    if (!attribute) return tl::unexpected(std::move(attribute).error());
    if (count.value_or(attribute->elements()) != attribute->elements())
      return fail(ErrorCode::corrupt, "attributes of instances are of different lengths");
    count = attribute->elements();
    read[k] = std::move(*attribute);
  }
  std::vector<Matrix4> out;
  if (!count) return std::vector<Matrix4>{kIdentity4};
  for (std::size_t i = 0; i < *count; ++i)
    out.push_back(matrix_of(element_of<3>(read[0], i, {0, 0, 0}),
                            element_of<4>(read[1], i, {0, 0, 0, 1}),
                            element_of<3>(read[2], i, {1, 1, 1})));
  return out;
}

/// The attributes of a node's instances; null without any.
const json* instance_attributes(const json& node) {
  const auto at = [](const json* in, const char* key) -> const json* {
    if (!in || !in->is_object()) return nullptr;
    const auto found = in->find(key);
    return found == in->end() ? nullptr : &*found;
  };
  const json* found = at(at(at(&node, "extensions"), kInstancing), "attributes");
  return found && found->is_object() ? found : nullptr;
}

}  // namespace
}  // namespace gltf

Result<std::vector<ShownNode>> find_shown_nodes(const Scene& scene, const Limits& limits) {
  using namespace gltf;
  std::vector<ShownNode> out(scene.nodes.size());
  const std::string_view text = as_text(find_foreign(scene, kRestKey));
  if (text.empty() || nests_deeper(text, limits.xml_depth)) return out;
  json root = json::parse(text, nullptr, false);
  if (!root.is_object()) return out;
  Cursor::Shared shared{std::nullopt, limits};
  std::vector<Index> sources;
  const std::size_t meshes = root.contains("meshes") ? root["meshes"].size() : 0;
  if (read_nodes(Cursor(root, "", shared), meshes, limits, &sources).size() != out.size() ||
      shared.error)
    return out;
  const json& nodes = root["nodes"];
  const std::vector<bool> is_root = roots_of(root, nodes.size());
  KeptAccessors accessors(root, find_foreign(scene, kBinKey), limits);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Index parent = scene.nodes[i].parent;
    out[i].is_shown = is_root[sources[i]] || (parent < i && out[parent].is_shown);
    const json* attributes = instance_attributes(nodes[sources[i]]);
    if (!attributes || scene.nodes[i].meshes.empty()) continue;
    auto instances = read_instances(accessors, *attributes);
    if (!instances) return tl::unexpected(std::move(instances).error());
    out[i].instances = std::move(*instances);
  }
  return out;
}

}  // namespace pstrips::inline formats
