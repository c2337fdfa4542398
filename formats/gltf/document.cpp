#include "formats/gltf/document.h"

#include <algorithm>
#include <array>

#include "formats/gltf/container.h"
#include "formats/gltf/extensions/extension.h"
#include "formats/gltf/json_cursor.h"
#include "formats/gltf/materials.h"
#include "formats/gltf/nodes.h"
#include "formats/gltf/unknown_extensions.h"

namespace pstrips::inline formats::gltf {
namespace {

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

/// glTF 1.0 lists by name what glTF 2.0 lists by number, and need not say its version.
bool is_first_version(const Cursor& root) {
  const bool says_another =
      root.has("asset") && root["asset"].value().is_object() && root["asset"].has("version");
  return !says_another &&
         std::ranges::any_of(
             std::array{"meshes", "accessors", "bufferViews"},
             [&](const char* key) { return root.has(key) && root[key].value().is_object(); });
}

void check_asset(const Cursor& root) {
  if (is_first_version(root)) return root.fail(ErrorCode::unsupported, "glTF 1.0");
  if (!root.has_object("asset"))
    return root.fail(ErrorCode::corrupt, "has no asset, so it is not glTF 2.0");
  const Cursor asset = root["asset"];
  const std::string version = asset.text("version"), least = asset.text("minVersion");
  if (version.empty()) return asset.fail(ErrorCode::corrupt, "names no version");
  if (version.starts_with("1.")) return asset.fail(ErrorCode::unsupported, "glTF 1.0");
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
    const Extension* extension = find_extension(text);
    if (!extension || !extension->may_be_required)
      list.fail(ErrorCode::unsupported, "required extension " + text.substr(0, 100));
  }
}

template <class Element>
void read_extension(const Cursor& object, const Extension& extension, Element& element) {
  if constexpr (std::is_same_v<Element, View>)
    if (extension.read_view) extension.read_view(object, element);
  if constexpr (std::is_same_v<Element, Primitive>)
    if (extension.read_primitive) extension.read_primitive(object, element);
}

std::string phrase_of_dropped(const Extension& extension) {
  return "extension " + std::string(extension.name) + ", which speaks of the order of vertices";
}

/// Has the table read the extensions of a view, a primitive or a mesh, and takes those out that are
/// not kept.
template <class Element>
void read_extensions(const Cursor& in, Element& element, std::vector<std::string>& dropped) {
  const auto extensions = in.value().find("extensions");
  if (extensions == in.value().end() || !extensions->is_object()) return;
  const std::size_t before = extensions->size();
  for (const Extension* extension : gltf::extensions()) {
    const auto at = extensions->find(extension->name);
    if (at == extensions->end()) continue;
    if (at->is_object()) read_extension(in["extensions"][extension->name], *extension, element);
    if (extension->fate == Fate::kept) continue;
    extensions->erase(at);
    if (extension->fate == Fate::dropped &&
        std::ranges::find(dropped, phrase_of_dropped(*extension)) == dropped.end())
      dropped.push_back(phrase_of_dropped(*extension));
  }
  if (extensions->empty() && before > 0) in.value().erase("extensions");
}

/// Takes the names of extensions that are not kept out of a list.
void remove_names(json& root, const char* key) {
  const auto list = root.find(key);
  if (list == root.end() || !list->is_array()) return;
  json left = json::array();
  for (json& name : *list) {
    const Extension* extension =
        name.is_string() ? find_extension(name.get_ref<const std::string&>()) : nullptr;
    if (!extension || extension->fate == Fate::kept) left.push_back(std::move(name));
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

View read_view(const Cursor& in, std::size_t buffers, std::vector<std::string>& dropped) {
  View out;
  in.required_whole("buffer");
  out.buffer = in.reference("buffer", buffers);
  out.offset = in.whole("byteOffset");
  out.bytes = in.required_whole("byteLength");
  out.stride = in.whole("byteStride");
  read_extensions(in, out, dropped);
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
  read_extensions(in, out, dropped);
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
  read_extensions(in, out, dropped);
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
  for (const Extension* extension : gltf::extensions())
    if (extension->holds_texture_source && extensions.has_object(extension->name))
      return extensions[extension->name].reference("source", images);
  return kNone;
}

Image read_image(const Cursor& in, std::size_t views, Index& view) {
  Image out;
  out.name = in.text("name");
  out.mime_type = in.text("mimeType");
  view = in.reference("bufferView", views);
  if (in.has("uri") && view != kNone) in.fail(ErrorCode::corrupt, "image with URI and bufferView");
  out.uri = in.take_uri("uri");
  for (const char* key : {"name", "mimeType", "bufferView", "uri"}) in.value().erase(key);
  if (out.uri.empty() || is_data_uri(out.uri)) return out;
  in.value()["uri"] = out.uri;  // it comes back as it was written
  out.uri = percent_decode(out.uri);
  return out;
}

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
    out.views.push_back(read_view(in, out.buffers.size(), dropped));
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
  out.nodes = read_nodes(root, out.meshes.size(), limits);
  if (shared.error) return tl::unexpected(std::move(*shared.error));

  root.value().erase("buffers");
  remove_names(root.value(), "extensionsUsed");
  remove_names(root.value(), "extensionsRequired");
  for (const std::string& name :
       drop_unknown_references(root.value(), std::max(out.accessors.size(), out.views.size())))
    dropped.push_back("extension " + name + ", which may refer to what is renumbered");
  const std::string skeleton = root.value().dump();
  *parsed = nullptr;
  if (Result<void> kept = keep_rest(out, skeleton); !kept) return tl::unexpected(kept.error());
  return out;
}

}  // namespace pstrips::inline formats::gltf
