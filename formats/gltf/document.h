#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats::gltf {

// What a glTF file says in JSON, as plain structs. Every index is kNone or in range; offsets and
// lengths are as the file wrote them and not yet compared with the bytes.

struct Buffer {
  std::string uri;
  bool has_uri = false;
  std::uint64_t bytes = 0;
};

struct View {
  Index buffer = 0;
  std::uint64_t offset = 0, bytes = 0;
  std::uint64_t stride = 0;  ///< 0: packed

  /// How meshopt compression stores it beside.
  struct Compressed {
    Index buffer = 0;
    std::uint64_t offset = 0, bytes = 0;
    std::uint64_t stride = 0, count = 0;
    std::string mode, filter;
  };
  std::optional<Compressed> compressed;
};

struct Accessor {
  ComponentType type = ComponentType::f32;
  std::uint8_t components = 1;
  std::uint8_t rows = 0;  ///< of a matrix, else 0
  bool normalized = false;
  std::uint64_t count = 0;
  Index view = kNone;  ///< kNone: zeros
  std::uint64_t offset = 0;
  struct Sparse {
    std::uint64_t count = 0;
    ComponentType index_type = ComponentType::u8;
    Index index_view = kNone, value_view = kNone;
    std::uint64_t index_offset = 0, value_offset = 0;
  } sparse;

  /// Columns of matrices start at multiples of four bytes. [glTF 2.0 §3.6.2.4]
  std::size_t column_bytes() const { return rows * size_of(type); }
  std::size_t padded_column_bytes() const { return (column_bytes() + 3) / 4 * 4; }
  std::size_t element_bytes() const {
    return rows == 0 ? size_of(type) * components : components / rows * padded_column_bytes();
  }
  bool is_matrix() const { return rows != 0; }
};

inline constexpr Index kMaxTargets = 1 << 20;  ///< morph targets, all meshes together; ours

enum class Mode : std::uint8_t { points, lines, line_loop, line_strip, triangles, strip, fan };

struct Primitive {
  std::vector<std::pair<std::string, Index>> attributes;  ///< name and accessor, targets after
  Index targets = 0;
  Index indices = kNone;
  Index material = kNone;
  Mode mode = Mode::triangles;

  /// How Draco compression stores it beside.
  struct Compressed {
    Index view = 0;
    std::vector<std::pair<std::string, std::uint32_t>> attributes;  ///< name and Draco's id
  };
  std::optional<Compressed> compressed;

  /// glTF lets viewers skip a primitive without positions; it stays in Document::rest as it is.
  bool has_position() const {
    for (const auto& [name, accessor] : attributes)
      if (name == "POSITION") return true;
    return false;
  }
};

struct GltfMesh {
  std::string name;
  std::vector<Primitive> primitives;
};

/// A range of the buffers that is not geometry, and where it goes in the kept buffer.
struct Kept {
  bool is_accessor = true;
  Index source = 0;  ///< accessor or view
  std::uint64_t offset = 0, bytes = 0;
};

struct Document {
  std::vector<Buffer> buffers;
  std::vector<View> views;
  std::vector<Accessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<Material> materials;
  std::vector<Image> images;      ///< data URIs still stand in `uri`
  std::vector<Index> image_view;  ///< one each, kNone: none
  std::vector<Node> nodes;        ///< `meshes` names glTF meshes
  /// The JSON without what stands above, its references renumbered to the ranges kept below.
  std::string rest;
  std::vector<Kept> kept;
  std::uint64_t kept_bytes = 0;
};

/// Whether brackets nest deeper than `limit`: JSON parsers do not recurse, what walks their result
/// does.
bool nests_deeper(std::string_view json, std::uint32_t limit);

/// Parses and checks the JSON of a glTF 2.0 file.
///
/// dropped  extensions that are left out, by name
/// errors   as read_gltf says; offsets count from `json_offset`, other paths are JSON pointers
/// cost     O(size)
Result<Document> parse(std::string_view json, std::uint64_t json_offset, const Limits& limits,
                       std::vector<std::string>& dropped);

/// Fills `kept`, `kept_bytes` and `rest` from `skeleton`: the JSON whose accessors and views are
/// still numbered as in the file. [keep.cpp]
Result<void> keep_rest(Document& document, std::string_view skeleton);

inline constexpr std::string_view kRestKey = "gltf/json";  ///< Document::rest
inline constexpr std::string_view kBinKey = "gltf/bin";    ///< the bytes of Document::kept
inline constexpr std::string_view kPrimitivesKey = "gltf/primitives";  ///< [primitives.h]
inline constexpr std::string_view kChunksKey = "gltf/chunks";          ///< Container::other_chunks

}  // namespace pstrips::inline formats::gltf
