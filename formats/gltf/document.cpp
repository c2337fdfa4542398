#include "formats/gltf/document.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

namespace pstrips::inline formats::gltf {
namespace {

using nlohmann::json;

/// A JSON value, where it stands, and the first failure of all reads from the document. Reads
/// after a failure return defaults, so the code below reads in a straight line.
class Cursor {
 public:
  struct Shared {
    std::optional<Error> error;
    const Limits& limits;
  };
  Cursor(json& value, std::string path, Shared& shared)
      : value_(value), path_(std::move(path)), shared_(shared) {}

  void fail(ErrorCode code, std::string message) const {
    if (!shared_.error) shared_.error = Error{code, std::move(message), kNoOffset, path_};
  }
  bool failed() const { return shared_.error.has_value(); }
  json& value() const { return value_; }
  bool has(const char* key) const { return value_.contains(key); }
  Cursor operator[](const char* key) const { return {value_[key], path_ + '/' + key, shared_}; }

  /// Calls `visit(element, i)` for each object of an array member, which may be absent.
  template <class Visit>
  void each(const char* key, Visit&& visit) const {
    if (failed() || !has(key)) return;
    const Cursor list = (*this)[key];
    if (!list.value_.is_array()) return list.fail(ErrorCode::corrupt, "is not an array");
    for (std::size_t i = 0; i < list.value_.size() && !failed(); ++i) {
      const Cursor element(list.value_[i], list.path_ + '/' + std::to_string(i), shared_);
      if (!element.value_.is_object()) return element.fail(ErrorCode::corrupt, "is not an object");
      visit(element, i);
    }
  }
  std::size_t length(const char* key) const {
    return has(key) && value_[key].is_array() ? value_[key].size() : 0;
  }
  bool has_object(const char* key) const {
    if (!has(key)) return false;
    if (value_[key].is_object()) return true;
    (*this)[key].fail(ErrorCode::corrupt, "is not an object");
    return false;
  }

  std::uint64_t whole(const char* key, std::uint64_t absent = 0) const {
    return has(key) ? (*this)[key].as_whole() : absent;
  }
  std::uint64_t required_whole(const char* key) const {
    if (!has(key)) fail(ErrorCode::corrupt, std::string("misses member ") + key);
    return whole(key);
  }
  /// An index below `size`, kNone when absent.
  Index reference(const char* key, std::size_t size) const {
    return has(key) ? (*this)[key].as_reference(size) : kNone;
  }
  Index as_reference(std::size_t size) const {
    const std::uint64_t i = as_whole();
    if (!failed() && i >= size) fail(ErrorCode::corrupt, "refers to nothing");
    return failed() ? 0 : static_cast<Index>(i);
  }
  std::vector<Index> references(const char* key, std::size_t size) const {
    std::vector<Index> out;
    if (failed() || !has(key)) return out;
    const Cursor list = (*this)[key];
    if (!list.value_.is_array()) list.fail(ErrorCode::corrupt, "is not an array");
    for (std::size_t i = 0; !failed() && i < list.value_.size(); ++i)
      out.push_back(
          Cursor(list.value_[i], list.path_ + '/' + std::to_string(i), shared_).as_reference(size));
    return out;
  }
  bool flag(const char* key) const {
    if (!has(key)) return false;
    const Cursor member = (*this)[key];
    if (!member.value_.is_boolean()) member.fail(ErrorCode::corrupt, "is not a boolean");
    return !failed() && member.value_.get<bool>();
  }
  std::string text(const char* key) const { return has(key) ? (*this)[key].as_text() : ""; }
  std::string as_text() const {
    if (!value_.is_string()) {
      fail(ErrorCode::corrupt, "is not a string");
      return {};
    }
    const auto& string = value_.get_ref<const std::string&>();
    if (string.size() > shared_.limits.string_bytes) {
      fail(ErrorCode::over_limit, "string is too long");
      return {};
    }
    return string;
  }
  /// Takes a string out of the document, however long: it may be a data URI.
  std::string take_uri(const char* key) const {
    if (!has(key)) return {};
    if (!value_[key].is_string()) {
      (*this)[key].fail(ErrorCode::corrupt, "is not a string");
      return {};
    }
    return std::move(value_[key].get_ref<std::string&>());
  }
  void number(const char* key, double& out) const {
    if (!has(key)) return;
    const Cursor member = (*this)[key];
    if (!member.value_.is_number()) return member.fail(ErrorCode::corrupt, "is not a number");
    out = member.value_.get<double>();
  }
  template <std::size_t n>
  bool numbers(const char* key, std::array<double, n>& out) const {
    if (!has(key)) return false;
    const Cursor list = (*this)[key];
    const auto is_number = [](const json& x) { return x.is_number(); };
    if (!list.value_.is_array() || list.value_.size() != n ||
        !std::ranges::all_of(list.value_, is_number)) {
      list.fail(ErrorCode::corrupt, "is not " + std::to_string(n) + " numbers");
      return false;
    }
    for (std::size_t i = 0; i < n; ++i) out[i] = list.value_[i].template get<double>();
    return true;
  }

 private:
  std::uint64_t as_whole() const {
    if (value_.is_number_unsigned()) return value_.get<std::uint64_t>();
    // JSON knows one kind of number: 3.0 is as whole as 3.
    const double number = value_.is_number_float() ? value_.get<double>() : -1;
    if (number >= 0 && number < 9e15 &&
        number == static_cast<double>(static_cast<std::uint64_t>(number)))
      return static_cast<std::uint64_t>(number);
    fail(ErrorCode::corrupt, "is not a whole number");
    return 0;
  }

  json& value_;
  std::string path_;
  Shared& shared_;
};

Result<json> parse_json(std::string_view text, std::uint64_t offset, std::uint32_t depth) {
  if (nests_deeper(text, depth)) return fail(ErrorCode::over_limit, "JSON nests too deep", offset);
  try {
    return json::parse(text);
  } catch (const json::parse_error& e) {
    const bool at_end = e.byte > text.size();
    return fail(at_end ? ErrorCode::truncated : ErrorCode::corrupt,
                at_end ? "ends inside the JSON" : "is not JSON",
                offset + std::min(e.byte == 0 ? 0 : e.byte - 1, text.size()));
  } catch (const json::exception&) {
    return fail(ErrorCode::corrupt, "JSON number out of range", offset);
  }
}

// ---- asset and extensions ----

/// Required extensions that leave geometry alone or that we understand.
bool is_known_extension(std::string_view name) {
  constexpr std::string_view kPrefixes[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                            "KHR_lights_",    "EXT_lights_",  "MSFT_texture_"};
  constexpr std::string_view kNames[] = {
      kQuantization,           "EXT_mesh_gpu_instancing", "EXT_mesh_features",
      "EXT_instance_features", "EXT_structural_metadata", "MSFT_lod",
      "KHR_xmp_json_ld",       "KHR_techniques_webgl",    "KHR_animation_pointer",
      "KHR_node_visibility",   "GOOGLE_texture_basis",    "CESIUM_RTC"};
  return std::ranges::any_of(kPrefixes, [&](auto p) { return name.starts_with(p); }) ||
         std::ranges::find(kNames, name) != std::end(kNames);
}

/// Extensions that restate geometry or speak of the order of its vertices in the file.
constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
constexpr std::string_view kMeshopt[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
constexpr std::string_view kOrderBound[] = {"EXT_mesh_manifold", "CESIUM_primitive_outline"};

void check_asset(const Cursor& root) {
  if (!root.has_object("asset"))
    return root.fail(ErrorCode::corrupt, "has no asset, so it is not glTF 2.0");
  const Cursor asset = root["asset"];
  const std::string version = asset.text("version"), least = asset.text("minVersion");
  if (version.empty()) return asset.fail(ErrorCode::corrupt, "names no version");
  if (!version.starts_with("2.")) asset.fail(ErrorCode::unsupported, "is not glTF 2");
  if (!least.empty() && least != "2.0")
    asset.fail(ErrorCode::unsupported, "needs a later glTF than 2.0");
}

void check_required_extensions(const Cursor& root) {
  if (!root.has("extensionsRequired")) return;
  const Cursor list = root["extensionsRequired"];
  if (!list.value().is_array()) return list.fail(ErrorCode::corrupt, "is not an array");
  for (const json& name : list.value()) {
    if (!name.is_string()) return list.fail(ErrorCode::corrupt, "names an extension by no string");
    const auto& text = name.get_ref<const std::string&>();
    if (!is_known_extension(text))
      list.fail(ErrorCode::unsupported, "required extension " + text.substr(0, 100));
  }
}

/// Removes an extension from one object; true when it was there.
bool remove_extension(json& object, std::string_view name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return false;
  if (extensions->erase(std::string(name)) == 0) return false;
  if (extensions->empty()) object.erase("extensions");
  return true;
}

bool remove_meshopt(json& object) {
  bool removed = false;
  for (const std::string_view name : kMeshopt) removed |= remove_extension(object, name);
  return removed;
}

void drop_order_bound(json& object, std::vector<std::string>& dropped) {
  for (const std::string_view name : kOrderBound)
    if (remove_extension(object, name) && std::ranges::find(dropped, name) == dropped.end())
      dropped.emplace_back(name);
}

/// Takes the names of extensions that are gone out of a list, and the one that the writer adds
/// when the types of the attributes ask for it.
void forget_extensions(json& root, const char* key) {
  const auto list = root.find(key);
  if (list == root.end() || !list->is_array()) return;
  json left = json::array();
  for (json& name : *list) {
    const bool removed = name == kQuantization || name == kDraco ||
                         std::ranges::find(kMeshopt, name) != std::end(kMeshopt) ||
                         std::ranges::find(kOrderBound, name) != std::end(kOrderBound);
    if (!removed) left.push_back(std::move(name));
  }
  if (left.empty())
    root.erase(list);
  else
    *list = std::move(left);
}

// ---- buffers, views, accessors ----

Buffer read_buffer(const Cursor& in) {
  Buffer out;
  out.has_uri = in.has("uri");
  out.bytes = in.required_whole("byteLength");
  out.uri = in.take_uri("uri");
  return out;
}

View read_view(const Cursor& in, std::size_t buffers) {
  View out;
  in.required_whole("buffer");
  out.buffer = in.reference("buffer", buffers);
  out.offset = in.whole("byteOffset");
  out.bytes = in.required_whole("byteLength");
  out.stride = in.whole("byteStride");
  out.compressed = remove_meshopt(in.value());
  return out;
}

ComponentType read_component_type(const Cursor& in) {
  switch (in.required_whole("componentType")) {
    case 5120:
      return ComponentType::i8;
    case 5121:
      return ComponentType::u8;
    case 5122:
      return ComponentType::i16;
    case 5123:
      return ComponentType::u16;
    case 5125:
      return ComponentType::u32;
    case 5126:
      return ComponentType::f32;
    default:
      in.fail(ErrorCode::corrupt, "unknown component type");
      return ComponentType::f32;
  }
}

void read_accessor_type(const Cursor& in, Accessor& out) {
  struct Type {
    std::string_view name;
    std::uint8_t components, rows;
  };
  constexpr Type kTypes[] = {{"SCALAR", 1, 0}, {"VEC2", 2, 0}, {"VEC3", 3, 0}, {"VEC4", 4, 0},
                             {"MAT2", 4, 2},   {"MAT3", 9, 3}, {"MAT4", 16, 4}};
  const std::string name = in.text("type");
  const auto type = std::ranges::find(kTypes, name, &Type::name);
  if (type == std::end(kTypes)) return in.fail(ErrorCode::corrupt, "unknown accessor type");
  out.components = type->components;
  out.rows = type->rows;
}

void read_sparse(const Cursor& in, std::size_t views, Accessor& out) {
  if (!in.has_object("indices") || !in.has_object("values"))
    return in.fail(ErrorCode::corrupt, "sparse accessor without indices or values");
  const Cursor indices = in["indices"], values = in["values"];
  indices.required_whole("bufferView");
  values.required_whole("bufferView");
  out.sparse.count = in.required_whole("count");
  out.sparse.index_type = read_component_type(indices);
  out.sparse.index_view = indices.reference("bufferView", views);
  out.sparse.index_offset = indices.whole("byteOffset");
  out.sparse.value_view = values.reference("bufferView", views);
  out.sparse.value_offset = values.whole("byteOffset");
  if (out.sparse.count > out.count) in.fail(ErrorCode::corrupt, "more sparse values than elements");
}

Accessor read_accessor(const Cursor& in, std::size_t views) {
  Accessor out;
  out.type = read_component_type(in);
  read_accessor_type(in, out);
  // glTF forbids the flag where it would mean nothing; it is no reason to refuse a file.
  out.normalized =
      in.flag("normalized") && out.type != ComponentType::f32 && out.type != ComponentType::u32;
  out.count = in.required_whole("count");
  out.view = in.reference("bufferView", views);
  out.offset = in.whole("byteOffset");
  if (in.has_object("sparse")) read_sparse(in["sparse"], views, out);
  return out;
}

// ---- meshes ----

void read_attributes(const Cursor& in, const std::string& prefix, std::size_t accessors,
                     Primitive& out) {
  for (auto& [name, accessor] : in.value().items())
    if (!in.failed())
      out.attributes.emplace_back(prefix + name, in[name.c_str()].as_reference(accessors));
}

Primitive read_primitive(const Cursor& in, const Document& document, std::size_t materials,
                         std::vector<std::string>& dropped) {
  Primitive out;
  const std::size_t accessors = document.accessors.size();
  if (!in.has_object("attributes")) {
    in.fail(ErrorCode::corrupt, "primitive without attributes");
    return out;
  }
  read_attributes(in["attributes"], "", accessors, out);
  in.each("targets", [&](const Cursor& target, std::size_t k) {
    read_attributes(target, "TARGET_" + std::to_string(k) + "/", accessors, out);
  });
  if (in.length("targets") > kMaxTargets) in.fail(ErrorCode::over_limit, "too many morph targets");
  out.targets = static_cast<Index>(in.length("targets"));
  out.indices = in.reference("indices", accessors);
  out.material = in.reference("material", materials);
  const std::uint64_t mode = in.whole("mode", 4);
  if (mode > 6) in.fail(ErrorCode::corrupt, "unknown primitive mode");
  out.mode = static_cast<Mode>(mode > 6 ? 0 : mode);
  out.compressed = remove_extension(in.value(), kDraco);
  drop_order_bound(in.value(), dropped);
  if (!out.has_position()) return out;
  for (const char* key : {"attributes", "targets", "indices", "material", "mode"})
    in.value().erase(key);
  return out;
}

GltfMesh read_mesh(const Cursor& in, const Document& document, std::size_t materials,
                   std::vector<std::string>& dropped) {
  GltfMesh out;
  out.name = in.text("name");
  if (!in.has("primitives")) in.fail(ErrorCode::corrupt, "mesh without primitives");
  in.each("primitives", [&](const Cursor& primitive, std::size_t) {
    out.primitives.push_back(read_primitive(primitive, document, materials, dropped));
  });
  drop_order_bound(in.value(), dropped);
  if (std::ranges::any_of(out.primitives, &Primitive::has_position)) in.value().erase("name");
  return out;
}

void check_targets(const Cursor& root, const std::vector<GltfMesh>& meshes) {
  std::uint64_t targets = 0;
  for (const GltfMesh& mesh : meshes)
    for (const Primitive& primitive : mesh.primitives) targets += primitive.targets;
  if (targets > kMaxTargets) root.fail(ErrorCode::over_limit, "too many morph targets");
}

// ---- scene ----

/// The plain source, else that of an extension for another image format.
Index read_texture_source(const Cursor& texture, std::size_t images) {
  if (texture.has("source") || !texture.has_object("extensions"))
    return texture.reference("source", images);
  const Cursor extensions = texture["extensions"];
  for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif"})
    if (extensions.has_object(name)) return extensions[name].reference("source", images);
  return kNone;
}

Material read_material(const Cursor& in, const std::vector<Index>& texture_image) {
  Material out;
  out.name = in.text("name");
  out.double_sided = in.flag("doubleSided");
  in.numbers("emissiveFactor", out.emissive);
  if (!in.has_object("pbrMetallicRoughness")) return out;
  const Cursor pbr = in["pbrMetallicRoughness"];
  pbr.numbers("baseColorFactor", out.base_color);
  pbr.number("metallicFactor", out.metallic);
  pbr.number("roughnessFactor", out.roughness);
  if (!pbr.has_object("baseColorTexture")) return out;
  const Cursor texture = pbr["baseColorTexture"];
  texture.required_whole("index");
  const Index i = texture.reference("index", texture_image.size());
  if (!in.failed()) out.base_color_image = texture_image[i];
  return out;
}

Image read_image(const Cursor& in, std::size_t views, Index& view) {
  Image out;
  out.name = in.text("name");
  out.mime_type = in.text("mimeType");
  view = in.reference("bufferView", views);
  if (in.has("uri") && view != kNone) in.fail(ErrorCode::corrupt, "image with URI and bufferView");
  out.uri = in.take_uri("uri");
  for (const char* key : {"name", "mimeType", "bufferView", "uri"}) in.value().erase(key);
  return out;
}

using Matrix = std::array<double, 16>;

Matrix matrix_of(const std::array<double, 3>& t, const std::array<double, 4>& q,
                 const std::array<double, 3>& s) {
  const auto [x, y, z, w] = q;
  return {s[0] * (1 - 2 * (y * y + z * z)),
          s[0] * 2 * (x * y + z * w),
          s[0] * 2 * (x * z - y * w),
          0,
          s[1] * 2 * (x * y - z * w),
          s[1] * (1 - 2 * (x * x + z * z)),
          s[1] * 2 * (y * z + x * w),
          0,
          s[2] * 2 * (x * z + y * w),
          s[2] * 2 * (y * z - x * w),
          s[2] * (1 - 2 * (x * x + y * y)),
          0,
          t[0],
          t[1],
          t[2],
          1};
}

Node read_node(const Cursor& in, std::size_t meshes) {
  Node out;
  out.name = in.text("name");
  const Index mesh = in.reference("mesh", meshes);
  if (mesh != kNone) out.meshes.push_back(mesh);
  if (in.numbers("matrix", out.matrix)) return out;
  std::array<double, 3> translation{0, 0, 0}, scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};
  const bool moved = in.numbers("translation", translation);
  const bool turned = in.numbers("rotation", rotation);
  if (in.numbers("scale", scale) || moved || turned)
    out.matrix = matrix_of(translation, rotation, scale);
  return out;
}

/// Brings parents before children, each subtree in one piece, roots and children in file order.
/// glTF wants a tree; files with several parents a node exist, and such a node then stands there
/// once a parent.
class NodeReader {
 public:
  NodeReader(const Cursor& root, std::size_t meshes, const Limits& limits)
      : root_(root),
        limits_(limits),
        children_(root.length("nodes")),
        state_(root.length("nodes")) {
    std::vector<bool> has_parent(children_.size());
    root.each("nodes", [&](const Cursor& in, std::size_t i) {
      nodes_.push_back(read_node(in, meshes));
      children_[i] = in.references("children", children_.size());
      for (const Index child : children_[i]) has_parent[child] = true;
    });
    for (Index i = 0; i < children_.size() && !root.failed(); ++i)
      if (!has_parent[i]) place_subtree(i);
    if (root.failed()) return;
    if (std::ranges::find(state_, State::unseen) != state_.end())
      root["nodes"].fail(ErrorCode::corrupt, "nodes form a cycle");
  }
  std::vector<Node> take() && { return std::move(placed_); }

 private:
  enum class State : std::uint8_t { unseen, on_path, left };
  struct Visit {
    Index node, place;
    std::size_t next_child = 0;
  };

  void place(Index i, Index parent, std::vector<Visit>& path) {
    if (state_[i] == State::on_path)
      return root_["nodes"].fail(ErrorCode::corrupt, "nodes form a cycle");
    if (placed_.size() >= limits_.meshes)
      return root_["nodes"].fail(ErrorCode::over_limit, "too many nodes");
    state_[i] = State::on_path;
    path.push_back({i, static_cast<Index>(placed_.size())});
    placed_.push_back(nodes_[i]);
    placed_.back().parent = parent;
  }
  void place_subtree(Index top) {
    std::vector<Visit> path;
    place(top, kNone, path);
    while (!path.empty() && !root_.failed()) {
      Visit& visit = path.back();
      if (visit.next_child == children_[visit.node].size()) {
        state_[visit.node] = State::left;
        path.pop_back();
      } else {
        const Index child = children_[visit.node][visit.next_child++];
        place(child, visit.place, path);
      }
    }
  }

  const Cursor& root_;
  const Limits& limits_;
  std::vector<Node> nodes_, placed_;
  std::vector<std::vector<Index>> children_;
  std::vector<State> state_;
};

void check_lengths(const Cursor& root, const Limits& limits) {
  for (const char* key : {"meshes", "materials", "images", "nodes", "textures"})
    if (root.length(key) > limits.meshes)
      root[key].fail(ErrorCode::over_limit, "too many elements");
}

}  // namespace

bool nests_deeper(std::string_view text, std::uint32_t limit) {
  std::uint32_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > limit) return true;
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return false;
}

Result<Document> parse(std::string_view text, std::uint64_t json_offset, const Limits& limits,
                       std::vector<std::string>& dropped) {
  Result<json> parsed = parse_json(text, json_offset, limits.xml_depth);
  if (!parsed) return tl::unexpected(std::move(parsed).error());
  if (!parsed->is_object()) return fail(ErrorCode::corrupt, "is not a JSON object", json_offset);
  Cursor::Shared shared{std::nullopt, limits};
  const Cursor root(*parsed, "", shared);

  Document out;
  check_asset(root);
  check_required_extensions(root);
  check_lengths(root, limits);
  root.each("buffers",
            [&](const Cursor& in, std::size_t) { out.buffers.push_back(read_buffer(in)); });
  root.each("bufferViews", [&](const Cursor& in, std::size_t) {
    out.views.push_back(read_view(in, out.buffers.size()));
  });
  root.each("accessors", [&](const Cursor& in, std::size_t) {
    out.accessors.push_back(read_accessor(in, out.views.size()));
  });
  root.each("images", [&](const Cursor& in, std::size_t) {
    out.images.push_back(read_image(in, out.views.size(), out.image_view.emplace_back()));
  });
  std::vector<Index> texture_image;
  root.each("textures", [&](const Cursor& in, std::size_t) {
    texture_image.push_back(read_texture_source(in, out.images.size()));
  });
  root.each("materials", [&](const Cursor& in, std::size_t) {
    out.materials.push_back(read_material(in, texture_image));
  });
  root.each("meshes", [&](const Cursor& in, std::size_t) {
    out.meshes.push_back(read_mesh(in, out, out.materials.size(), dropped));
  });
  check_targets(root, out.meshes);
  out.nodes = NodeReader(root, out.meshes.size(), limits).take();
  if (shared.error) return tl::unexpected(std::move(*shared.error));

  root.value().erase("buffers");
  forget_extensions(root.value(), "extensionsUsed");
  forget_extensions(root.value(), "extensionsRequired");
  const std::string skeleton = root.value().dump();
  *parsed = nullptr;
  if (Result<void> kept = keep_rest(out, skeleton); !kept) return tl::unexpected(kept.error());
  return out;
}

}  // namespace pstrips::inline formats::gltf
