#include "codecs/weld/weld.h"

#include <span>

#include "codecs/weld/places.h"
#include "core/equal_elements.h"
#include "core/gather.h"

namespace pstrips::inline codecs {
namespace {

// Wedges that a polygon has.
std::vector<bool> wedges_of_polygons(const Mesh& mesh) {
  std::vector<bool> out(mesh.wedge_count(), false);
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (mesh.groups[mesh.group_of(f)].kind == FaceKind::polygons)
      for (const Index wedge : mesh.face(f)) out[wedge] = true;
  return out;
}

// For each vertex the first one of polygons at its place.
std::vector<Index> first_vertices(const Mesh& mesh, const std::vector<bool>& used,
                                  double distance) {
  std::vector<bool> of_polygon(mesh.vertex_count(), false);
  for (Index w = 0; w < used.size(); ++w)
    if (used[w]) of_polygon[mesh.vertex_of(w)] = true;
  std::vector<Index> rows;
  for (Index v = 0; v < of_polygon.size(); ++v)
    if (of_polygon[v]) rows.push_back(v);
  const std::vector<Index> first = places(gather(mesh.position, rows), distance);
  std::vector<Index> out(mesh.vertex_count());
  for (Index v = 0; v < out.size(); ++v) out[v] = v;
  for (std::size_t i = 0; i < rows.size(); ++i) out[rows[i]] = rows[first[i]];
  return out;
}

// For each wedge the first one of polygons with the same bytes at the same vertex.
std::vector<Index> first_wedges(const Mesh& mesh, const std::vector<bool>& used,
                                std::span<const Index> first_vertex) {
  std::size_t row_bytes = sizeof(Index);
  for (const Attribute& a : mesh.wedge_attributes) row_bytes += a.element_bytes();
  std::vector<Index> rows;
  Bytes table;
  const auto append = [&](ByteView bytes) {
    table.insert(table.end(), bytes.begin(), bytes.end());
  };
  for (Index w = 0; w < used.size(); ++w) {
    if (!used[w]) continue;
    rows.push_back(w);
    append(std::as_bytes(first_vertex.subspan(mesh.vertex_of(w), 1)));
    for (const Attribute& a : mesh.wedge_attributes) append(a.element(w));
  }
  const std::vector<Index> first = first_equals(table, row_bytes, 1);
  std::vector<Index> out(mesh.wedge_count());
  for (Index w = 0; w < out.size(); ++w) out[w] = w;
  for (std::size_t i = 0; i < rows.size(); ++i) out[rows[i]] = rows[first[i]];
  return out;
}

// Numbers sets by their first elements, which come before the others.
void number_sets(std::vector<Index>& first, std::vector<Index>& from) {
  for (Index i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      first[i] = static_cast<Index>(from.size());
      from.push_back(i);
    } else {
      first[i] = first[first[i]];
    }
  }
}

}  // namespace

std::optional<Welds> find_welds(const Mesh& mesh, double distance) {
  const std::vector<bool> used = wedges_of_polygons(mesh);
  Welds out;
  out.vertex = first_vertices(mesh, used, distance);
  out.wedge = first_wedges(mesh, used, out.vertex);
  number_sets(out.vertex, out.vertex_from);
  number_sets(out.wedge, out.wedge_from);
  if (out.wedge_from.size() == out.wedge.size() && out.vertex_from.size() == out.vertex.size())
    return std::nullopt;
  return out;
}

Mesh weld(const Mesh& mesh, const Welds& welds) {
  Mesh out;
  out.name = mesh.name;
  out.position = gather(mesh.position, welds.vertex_from);
  out.wedge_vertex.reserve(welds.wedge_from.size());
  for (const Index wedge : welds.wedge_from)
    out.wedge_vertex.push_back(welds.vertex[mesh.vertex_of(wedge)]);
  for (const Attribute& a : mesh.wedge_attributes)
    out.wedge_attributes.push_back(gather(a, welds.wedge_from));
  out.corners.reserve(mesh.corners.size());
  for (const Index wedge : mesh.corners) out.corners.push_back(welds.wedge[wedge]);
  out.face_first = mesh.face_first;
  out.face_group = mesh.face_group;
  out.face_attributes = mesh.face_attributes;
  out.groups = mesh.groups;
  canonicalize(out);
  return out;
}

}  // namespace pstrips::inline codecs
