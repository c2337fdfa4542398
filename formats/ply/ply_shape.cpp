#include "formats/ply/ply_shape.h"

#include <algorithm>
#include <cstring>

#include "formats/ply/ply_header.h"

namespace pstrips::inline formats::ply {
namespace {

bool wedges_agree(const Mesh& mesh, const Attribute& attribute, std::span<const Index> first) {
  const std::size_t bytes = attribute.element_bytes();
  const std::byte* const data = attribute.data.data();
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    if (std::memcmp(data + w * bytes, data + first[mesh.vertex_of(w)] * bytes, bytes) != 0)
      return false;
  return true;
}

/// Whether a reader finds all texture coordinates at the corners: a wedge without a corner must be
/// the only one of its vertex, and zero.
bool corners_tell_texcoords(const Mesh& mesh, const Attribute& texcoord) {
  std::vector<bool> has_corner(mesh.wedge_count());
  for (const Index w : mesh.corners) has_corner[w] = true;
  std::vector<Index> wedges(mesh.vertex_count());
  for (Index w = 0; w < mesh.wedge_count(); ++w) ++wedges[mesh.vertex_of(w)];
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    if (!has_corner[w] &&
        (wedges[mesh.vertex_of(w)] != 1 ||
         std::ranges::any_of(texcoord.element(w), [](std::byte b) { return b != std::byte{0}; })))
      return false;
  return true;
}

}  // namespace

bool is_texcoord(const Attribute& attribute) {
  return attribute.semantic == "TEXCOORD_0" && attribute.count == 2 && !is_integer(attribute.type);
}

std::vector<Index> first_wedges(const Mesh& mesh) {
  std::vector<Index> out(mesh.vertex_count(), kNone);
  for (Index w = mesh.wedge_count(); w-- > 0;) out[mesh.vertex_of(w)] = w;
  return out;
}

Shape choose_shape(const Mesh& mesh, bool has_faces, bool had_texcoords) {
  const std::vector<Index> first = first_wedges(mesh);
  const Attribute* texcoord = nullptr;
  bool others_agree = true, all_agree = true;
  for (const Attribute& attribute : mesh.wedge_attributes) {
    if (is_texcoord(attribute)) texcoord = &attribute;
    if (mesh.wedge_vertex.empty() || wedges_agree(mesh, attribute, first)) continue;
    all_agree = false;
    others_agree &= is_texcoord(attribute);
  }
  if (all_agree && !had_texcoords) return Shape::vertices;
  if (others_agree && texcoord != nullptr && has_faces && corners_tell_texcoords(mesh, *texcoord))
    return Shape::vertices_texcoords;
  return all_agree ? Shape::vertices : Shape::wedges;
}

}  // namespace pstrips::inline formats::ply
