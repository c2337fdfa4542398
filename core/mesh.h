#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes.h"

namespace pstrips::inline core {

using Index = std::uint32_t;
inline constexpr Index kNone = 0xffff'ffff;

/// The largest number of vertices, wedges, corners or faces of one mesh; the values above it are
/// kNone, the restart marker and the symbols of the offset encoding. [spec/strips.md §2]
inline constexpr Index kMaxCount = 0xffff'ff00;

enum class ComponentType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

constexpr std::size_t size_of(ComponentType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}
/// "i8" … "f64", as in the XML variant.
std::string_view name_of(ComponentType type);

/// One attribute as data: what it means, how an element looks, and all elements, packed without
/// gaps, little-endian, bit for bit as they were read (NaN payloads and -0 included).
struct Attribute {
  /// glTF's names where they fit (POSITION, NORMAL, TANGENT, TEXCOORD_n, COLOR_n, JOINTS_n,
  /// WEIGHTS_n), the source's own name otherwise; unique within its list.
  std::string semantic;
  ComponentType type = ComponentType::f32;
  std::uint8_t count = 1;   ///< components an element, 1 to 255
  bool normalized = false;  ///< integers stand for [0, 1] or [-1, 1], as in glTF
  Bytes data;

  std::size_t element_bytes() const { return size_of(type) * count; }
  std::size_t elements() const { return data.size() / element_bytes(); }
  ByteView element(std::size_t i) const {
    return ByteView(data).subspan(i * element_bytes(), element_bytes());
  }
  /// The same without data.
  Attribute format() const { return {semantic, type, count, normalized, {}}; }
  /// Same semantic, type, count and normalization; data aside.
  bool same_format(const Attribute& other) const;
  friend bool operator==(const Attribute&, const Attribute&) = default;
};

/// Component c of element i as a number; normalized integers are scaled. [glTF §3.6.2.2]
double component(const Attribute& attribute, std::size_t i, std::size_t c);

/// Stores a number as component c of element i: the nearest that the type has, ties to even; NaN
/// becomes 0 in integers. What component() returned is stored as it was, except the smallest
/// normalized integer: it means -1, and the one above it is stored.
void set_component(Attribute& attribute, std::size_t i, std::size_t c, double value);

enum class FaceKind : std::uint8_t {
  polygons,  ///< closed loops; three corners are a triangle
  lines,     ///< open polylines
  points,    ///< one corner each
};

/// A set of faces with one material; strips never cross from one group into another. A glTF
/// primitive is a group, so is each object/group/material combination of an OBJ file.
struct Group {
  std::string name;
  Index material = kNone;  ///< into Scene::materials
  FaceKind kind = FaceKind::polygons;
  friend bool operator==(const Group&, const Group&) = default;
};

/// A polygon mesh on any complex: vertices (position, topological identity), wedges (a vertex and
/// one tuple of attributes), faces (loops of wedges). [Hoppe98 §2, Skabek11 §2.1]
///
/// Every vertex has at least one wedge. Faces may be degenerate, doubled, non-manifold; vertices
/// and wedges may be unused. Three lists are empty in their most common form, see each; use the
/// functions below instead of the lists where the form does not matter.
struct Mesh {
  std::string name;
  Attribute position{.semantic = "POSITION", .type = ComponentType::f32, .count = 3, .data = {}};
  std::vector<Index> wedge_vertex;          ///< a vertex for each wedge; empty: wedge i is vertex i
  std::vector<Attribute> wedge_attributes;  ///< each has one element a wedge
  std::vector<Index> corners;               ///< wedges, all faces one after the other
  /// First corner of each face and one past the end; empty: triangles.
  std::vector<Index> face_first;
  std::vector<Index> face_group;  ///< a group for each face; empty: all faces are in group 0
  std::vector<Attribute> face_attributes;  ///< each with one element a face
  std::vector<Group> groups;               ///< not empty

  Index vertex_count() const { return static_cast<Index>(position.elements()); }
  Index wedge_count() const {
    return wedge_vertex.empty() ? vertex_count() : static_cast<Index>(wedge_vertex.size());
  }
  Index face_count() const {
    return face_first.empty() ? static_cast<Index>(corners.size() / 3)
                              : static_cast<Index>(face_first.size() - 1);
  }
  Index vertex_of(Index wedge) const { return wedge_vertex.empty() ? wedge : wedge_vertex[wedge]; }
  Index group_of(Index face) const { return face_group.empty() ? 0 : face_group[face]; }
  std::span<const Index> face(Index i) const {
    const std::size_t first = face_first.empty() ? std::size_t{3} * i : face_first[i];
    const std::size_t end = face_first.empty() ? first + 3 : face_first[i + 1];
    return std::span(corners).subspan(first, end - first);
  }

  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// Brings the three optional lists into their shortest form. Readers call it last.
void canonicalize(Mesh& mesh);

/// The first rule of Mesh that a mesh breaks, as a phrase; empty when it breaks none. Tests call
/// it, and converters that take meshes from outside. Cost O(size).
std::string find_inconsistency(const Mesh& mesh);

/// Positions as doubles, three a vertex; missing components are 0.
std::vector<double> positions_as_double(const Mesh& mesh);

}  // namespace pstrips::inline core
