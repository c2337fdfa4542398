#include "formats/ply/ply_edges.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/gather.h"
#include "formats/ply/ply_edit.h"
#include "formats/ply/ply_numbers.h"

namespace pstrips::inline formats::ply {
namespace {

constexpr std::array<std::string_view, 2> kEnds = {"vertex1", "vertex2"};

// The rows that a column names; empty when one is not there.
std::vector<Index> rows_named(const KeptColumn& column, ComponentType type, std::uint64_t rows) {
  std::vector<Index> out;
  out.reserve(column.rows);
  const bool all = visit_type(type, [&](auto zero) {
    using T = decltype(zero);
    for (std::uint64_t i = 0; i < column.rows; ++i) {
      const double value = static_cast<double>(load<T>(column.data.values.data() + i * sizeof(T)));
      if (!(value >= 0 && value < static_cast<double>(rows))) return false;
      out.push_back(static_cast<Index>(value));
    }
    return true;
  });
  if (!all) out.clear();
  return out;
}

bool is_polygon(const Mesh& mesh, Index face) {
  return mesh.groups[mesh.group_of(face)].kind == FaceKind::polygons;
}

// Calls visit(from, to) with wedges.
template <class Visit>
void for_each_edge(const Mesh& mesh, Visit&& visit) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.groups[mesh.group_of(f)].kind != FaceKind::lines) continue;
    const auto line = mesh.face(f);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) visit(line[k], line[k + 1]);
  }
}

// Gives the mesh its optional lists of faces.
void write_out_faces(Mesh& mesh) {
  const Index faces = mesh.face_count();
  if (mesh.face_first.empty())
    for (Index f = 0; f <= faces; ++f) mesh.face_first.push_back(3 * f);
  if (mesh.face_group.empty()) mesh.face_group.assign(faces, 0);
}

}  // namespace

bool is_edge_list(const Element& element) {
  if (element.name != "edge" || element.properties.size() != kEnds.size()) return false;
  return std::ranges::all_of(kEnds, [&](std::string_view end) {
    const Property* const property = element.find(end);
    return property != nullptr && !property->is_list() && is_integer(property->type);
  });
}

void read_edges(Kept& kept, bool rows_are_wedges, Mesh& mesh) {
  Element* const element = kept.header.find("edge");
  if (element == nullptr || !is_edge_list(*element) || element->count == 0) return;
  const Index rows = rows_are_wedges ? mesh.wedge_count() : mesh.vertex_count();
  std::array<std::vector<Index>, 2> ends;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const Property& property = *element->find(kEnds[k]);
    ends[k] = rows_named(kept.columns[property.kept], property.type, rows);
    if (ends[k].empty()) return;
  }
  write_out_faces(mesh);
  const std::vector<Index> first =
      rows_are_wedges || mesh.wedge_vertex.empty() ? std::vector<Index>() : first_wedges(mesh);
  for (std::size_t i = 0; i < ends[0].size(); ++i) {
    for (const auto& end : ends) mesh.corners.push_back(first.empty() ? end[i] : first[end[i]]);
    mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
    mesh.face_group.push_back(static_cast<Index>(mesh.groups.size()));
  }
  mesh.groups.push_back({"", kNone, FaceKind::lines});
  for (Attribute& a : mesh.face_attributes)
    a.data.resize(a.element_bytes() * (mesh.face_first.size() - 1));
  for (Property& property : element->properties) {
    kept.columns[property.kept] = {};
    property.kept = Property::kNotKept;
  }
  element->count = 0;
  canonicalize(mesh);
}

bool has_lines_or_points(const Mesh& mesh) {
  if (std::ranges::all_of(mesh.groups, [](const Group& g) { return g.kind == FaceKind::polygons; }))
    return false;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (!is_polygon(mesh, f)) return true;
  return false;
}

Mesh polygons_of(const Mesh& mesh) {
  Mesh out = mesh;
  out.corners.clear();
  out.face_first.assign(1, 0);
  out.face_group.clear();
  std::vector<Index> kept;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!is_polygon(mesh, f)) continue;
    kept.push_back(f);
    out.corners.insert(out.corners.end(), mesh.face(f).begin(), mesh.face(f).end());
    out.face_first.push_back(static_cast<Index>(out.corners.size()));
    out.face_group.push_back(mesh.group_of(f));
  }
  for (Attribute& a : out.face_attributes) a = gather(a, kept);
  canonicalize(out);
  return out;
}

void add_edges(const Mesh& mesh, Description& description) {
  std::array<std::vector<Index>, 2> ends;
  const auto row_of = [&](Index wedge) {
    return description.shape == Shape::wedges ? wedge : mesh.vertex_of(wedge);
  };
  for_each_edge(mesh, [&](Index from, Index to) {
    ends[0].push_back(row_of(from));
    ends[1].push_back(row_of(to));
  });
  if (ends[0].empty()) return;
  auto& elements = description.kept.header.elements;
  if (description.kept.header.find("edge") == nullptr) {
    Element& edge = elements.emplace_back();
    edge.name = "edge";
    for (const std::string_view end : kEnds)
      edge.properties.push_back(scalar_property(std::string(end), ComponentType::i32));
  }
  Element& edge = *description.kept.header.find("edge");
  edge.count = ends[0].size();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    Property& property = *edge.find(kEnds[k]);
    const Index last = description.rows - 1;
    if (!fits(property.type, last))
      set_type(property, fits(ComponentType::i32, last) ? ComponentType::i32 : ComponentType::u32);
    property.kept = description.kept.columns.size();
    KeptColumn& column = description.kept.columns.emplace_back();
    column.rows = edge.count;
    visit_type(property.type, [&](auto zero) {
      using T = decltype(zero);
      column.data.values.resize(edge.count * sizeof(T));
      for (std::size_t i = 0; i < edge.count; ++i)
        store(column.data.values.data() + i * sizeof(T), static_cast<T>(ends[k][i]));
    });
  }
}

}  // namespace pstrips::inline formats::ply
