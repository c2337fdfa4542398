#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "formats/ply/ply_kept.h"
#include "formats/ply/ply_layout.h"
#include "formats/ply/ply_shape.h"

namespace pstrips::inline formats::ply {

/// Attributes that are to be written, found by name.
struct NamedAttributes {
  static constexpr std::size_t kNotFound = ~std::size_t{0};
  std::vector<const Attribute*> list;
  std::map<std::string_view, std::size_t> by_name;

  void add(const Attribute& attribute) {
    by_name.emplace(attribute.semantic, list.size());
    list.push_back(&attribute);
  }
  /// The one of the same format.
  std::size_t find(const Attribute& wanted) const {
    const auto found = by_name.find(wanted.semantic);
    const bool same = found != by_name.end() && list[found->second]->same_format(wanted);
    return same ? found->second : kNotFound;
  }
};

/// What a file says of a model before its rows: the kept header, changed to describe the mesh of
/// now, and where the attributes come from that it names.
struct Description {
  Description() = default;
  Description(const Description&) = delete;  // its parts point to each other
  Description& operator=(const Description&) = delete;

  Kept kept;  ///< its header is the one to write
  const Mesh* mesh = nullptr;
  Shape shape = Shape::vertices;
  Index rows = 0;  ///< of the vertex element
  bool has_faces = false, faces_have_texcoords = false;
  bool has_edges = false;               ///< set by whoever adds some; see add_edges()
  const Attribute* position = nullptr;  ///< the mesh's, or the one below
  Attribute scaled_position;            ///< in model units, of a normalized one
  std::optional<Attribute> texnumber;   ///< of the faces, where textures need numbers
  NamedAttributes wedge_attributes, face_attributes;
  std::vector<std::string> dropped;  ///< names of kept elements and lists that have no place

  /// Of the vertex or the face element.
  Layout layout_of(std::string_view element) const;
};

/// Describes a model of at most one mesh.
///
/// Preconditions: the mesh is consistent and has only polygons.
///
/// errors  bad_argument for kept data that do not parse, and attributes whose
///         names clash; unsupported for what ply has no words for
Result<void> describe(const Model& model, Encoding encoding, Description& out);

}  // namespace pstrips::inline formats::ply
