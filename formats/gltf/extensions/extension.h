#pragma once

#include <span>
#include <string_view>

#include "core/scene.h"
#include "formats/gltf/document.h"
#include "formats/gltf/fit.h"
#include "formats/gltf/json_cursor.h"

namespace pstrips::inline formats::gltf {

/// What becomes of an extension's JSON when a file is read.
enum class Fate : std::uint8_t {
  kept,     ///< comes back as it was; its references follow what they name
  held,     ///< goes: the model holds what it says, and the writer says it again where it must
  dropped,  ///< goes, and the reader says so: it speaks of the order of vertices in the file
};

/// What a number in an extension's JSON refers to. Nodes, meshes, materials, textures and images
/// keep their numbers; accessors and views get new ones.
enum class Reference : std::uint8_t { none, accessor, view };

/// An extension of glTF, all that this folder knows of it. A null function is nothing to do.
struct Extension {
  std::string_view name;
  Fate fate = Fate::kept;
  /// Whether a file may require it: it leaves geometry alone, or its geometry is read.
  bool may_be_required = false;

  /// Reads its object in a view or a primitive.
  void (*read_view)(const Cursor& object, View& view) = nullptr;
  void (*read_primitive)(const Cursor& object, Primitive& primitive) = nullptr;
  /// Its object in a texture has the image as "source".
  bool holds_texture_source = false;
  /// What the member `key` of an object under `parent` refers to, where it does not follow the
  /// convention. `parent` is empty for members of the extension's own object.
  Reference (*reference)(std::string_view parent, std::string_view key) = nullptr;

  /// Whether the writer says an attribute with it, which a reader then has to know.
  bool (*writes_attribute)(const Fitted& attribute) = nullptr;
  /// Whether the writer's textures name the image by it.
  bool (*writes_image)(const Image& image) = nullptr;
};

/// The row of that name, else the one that stands for its beginning; null for what is not known.
const Extension* find_extension(std::string_view name);

/// Those that the reader or the writer does something for; where several hold the same, the first
/// counts.
std::span<const Extension* const> extensions();

/// By most extensions: "accessor", "bufferView" and "...BufferView".
Reference conventional_reference(std::string_view key);

// One file each in this folder; the table that lists them is extension.cpp.
extern const Extension kDracoCompression;
extern const Extension kExtMeshopt, kKhrMeshopt;
extern const Extension kMeshQuantization;
extern const Extension kMeshGpuInstancing;
extern const Extension kStructuralMetadata;
extern const Extension kTextureBasisu, kTextureWebp, kTextureAvif;
extern const Extension kMeshManifold, kEdgeVisibility, kPrimitiveOutline;

}  // namespace pstrips::inline formats::gltf
