#include "converters/merge.h"

#include <algorithm>

namespace pstrips::inline converters {
namespace {

const Attribute* same_in(const Mesh& mesh, const Attribute& wanted) {
  for (const Attribute& a : mesh.wedge_attributes)
    if (a.same_format(wanted)) return &a;
  return nullptr;
}

}  // namespace

Model merge_meshes(const Model& model, std::vector<std::string>& notes) {
  Model out;
  out.scene = model.scene;
  out.scene.foreign.clear();  // it refers to the meshes as they were
  Mesh& all = out.meshes.emplace_back();
  if (model.meshes.empty()) {
    all.groups.resize(1);
    return out;
  }
  const Mesh& first = model.meshes.front();
  const bool mixed = std::ranges::any_of(
      model.meshes, [&](const Mesh& m) { return !m.position.same_format(first.position); });
  all.position = {"POSITION",
                  mixed ? ComponentType::f64 : first.position.type,
                  mixed ? std::uint8_t{3} : first.position.count,
                  !mixed && first.position.normalized,
                  {}};
  for (const Mesh& m : model.meshes)
    for (const Attribute& a : m.wedge_attributes) {
      const bool everywhere =
          std::ranges::all_of(model.meshes, [&](const Mesh& other) { return same_in(other, a); });
      if (everywhere && !same_in(all, a)) all.wedge_attributes.push_back(a.format());
      const std::string note = a.semantic + ": not in all meshes in the same format";
      if (!everywhere && std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
  if (std::ranges::any_of(model.meshes, [](const Mesh& m) { return !m.face_attributes.empty(); }))
    notes.push_back("face attributes of several meshes");

  all.face_first.push_back(0);
  for (const Mesh& m : model.meshes) {
    const Index vertices = all.vertex_count(), wedges = static_cast<Index>(all.wedge_vertex.size());
    const Index groups = static_cast<Index>(all.groups.size());
    for (Index w = 0; w < m.wedge_count(); ++w)
      all.wedge_vertex.push_back(vertices + m.vertex_of(w));
    if (mixed) {
      const std::vector<double> positions = positions_as_double(m);
      const ByteView bytes = std::as_bytes(std::span(positions));
      all.position.data.insert(all.position.data.end(), bytes.begin(), bytes.end());
    } else {
      all.position.data.insert(all.position.data.end(), m.position.data.begin(),
                               m.position.data.end());
    }
    for (Attribute& a : all.wedge_attributes) {
      const Bytes& data = same_in(m, a)->data;
      a.data.insert(a.data.end(), data.begin(), data.end());
    }
    for (Index f = 0; f < m.face_count(); ++f) {
      for (const Index w : m.face(f)) all.corners.push_back(wedges + w);
      all.face_first.push_back(static_cast<Index>(all.corners.size()));
      all.face_group.push_back(groups + m.group_of(f));
    }
    all.groups.insert(all.groups.end(), m.groups.begin(), m.groups.end());
  }
  canonicalize(all);
  return out;
}

}  // namespace pstrips::inline converters
