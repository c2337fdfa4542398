#pragma once

#include <span>
#include <string>
#include <vector>

#include "formats/ply/ply_header.h"

namespace pstrips::inline formats::ply {

inline constexpr std::string_view kWedgeVertex = "wedge_vertex";
/// The remark that makes a vertex property of that name ours. See write_ply.
inline constexpr std::string_view kWedgeRemark =
    "comment each row is a wedge, wedge_vertex is its vertex";

/// Which attribute component each property of vertices or faces holds.
struct Layout {
  enum class Role : std::uint8_t {
    attribute,     ///< `attributes[attribute]`, component `component`
    position,      ///< component `component` of POSITION
    wedge_vertex,  ///< the vertex of this row
    corners,       ///< the faces' index lists
    texcoord,      ///< the faces' lists of texture coordinates
    kept,          ///< a list we only keep
  };
  struct Place {
    Role role = Role::attribute;
    std::uint8_t component = 0;
    std::uint32_t attribute = 0;
  };
  std::vector<Place> places;          ///< one a property
  std::vector<Attribute> attributes;  ///< without data, in order of their first property
  bool has_position = false;
  ComponentType position_type = ComponentType::f32;

  bool has(Role role) const;
};

/// Reads the names. Both depend on the header alone, so that a writer can find out what a reader
/// will make of its words. Cost O(n log n).
Layout vertex_layout(const Element& vertex, bool faces_have_texcoords);
Layout face_layout(const Element& face);

/// Whether the faces' element has lists that may become TEXCOORD_0.
bool has_texcoord_list(const Element& face);

/// Properties for an attribute that no header names: the usual words where vertex_layout would
/// give the same attribute back from them, else NAME[0] NAME[1] ….
/// usual  false: the second form at any rate
std::vector<Property> properties_for(const Attribute& attribute, bool usual);

}  // namespace pstrips::inline formats::ply
