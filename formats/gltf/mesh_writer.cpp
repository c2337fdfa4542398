#include "formats/gltf/mesh_writer.h"

#include <algorithm>

#include "formats/gltf/extensions/extension.h"
#include "formats/gltf/finite.h"
#include "formats/gltf/fit.h"
#include "formats/gltf/local_origin.h"
#include "formats/gltf/mend.h"

namespace pstrips::inline formats::gltf {
namespace {

/// What reads as a primitive without faces: valid glTF as far as there is any.
IndexList without_faces(const Mesh& mesh, FaceKind kind) {
  if (kind == FaceKind::lines)
    return {Mode::line_strip, std::vector<Index>(mesh.wedge_count() > 0 ? 1 : 0)};
  if (kind == FaceKind::points) return {Mode::points, {}};
  return {Mode::strip, std::vector<Index>(mesh.wedge_count() > 0 ? 3 : 0)};
}

}  // namespace

MeshWriter::MeshWriter(const Model& model, const GltfWriteOptions& options,
                       const std::vector<PrimitiveMap::Layout>* layouts, AssetBuffer& buffer,
                       Notes& notes)
    : model_(model), options_(options), layouts_(layouts), buffer_(buffer), notes_(notes) {
  for (const Mesh& mesh : model.meshes) finite_.push_back(without_endless_vertices(mesh, notes));
  if (!layouts) origin_ = find_local_origin(model);
  if (origin_)
    notes.converted.emplace_back(
        "large coordinates, counted from an origin in the translation of a node");
}

/// The members that all primitives of a mesh have in common.
json MeshWriter::attributes_of(std::size_t m) {
  FitOptions fit;
  if (layouts_) fit = {true, (*layouts_)[m].targets, &(*layouts_)[m].mat2};
  if (origin_) fit.origin = *origin_;
  fit.turns_texcoords = model_.scene.texture_origin != TextureOrigin::upper_left;
  std::vector<Fitted> attributes = fit_attributes(mesh(m), fit, notes_);
  mend_values(mesh(m), fit.from_gltf, attributes, notes_);
  sets_ = close_gaps(attributes, notes_);
  json out = {{"attributes", json::object()}};
  std::vector<json> targets(fit.targets, json::object());
  bool has_targets = false;
  for (const Fitted& fitted : attributes) {
    const std::size_t accessor = buffer_.add_attribute(fitted);
    note_extensions(fitted);
    if (fitted.target == kNone) {
      out["attributes"][fitted.name] = accessor;
      continue;
    }
    has_targets = true;
    if (fitted.target >= targets.size()) targets.resize(fitted.target + 1, json::object());
    targets[fitted.target][fitted.name] = accessor;
  }
  if (has_targets) out["targets"] = std::move(targets);
  return out;
}

void MeshWriter::note_extensions(const Fitted& attribute) {
  for (const Extension* extension : gltf::extensions())
    if (extension->writes_attribute && extension->writes_attribute(attribute))
      extensions_.insert(extension->name);
}

void MeshWriter::set_material(json& primitive, const Group& group, json& materials) {
  if (group.material >= model_.scene.materials.size()) return;
  primitive["material"] = group.material;
  const json& wanted = materials[group.material];
  if (fits_sets(wanted, sets_)) return;
  const auto [at, is_new] = other_materials_.try_emplace({group.material, sets_}, materials.size());
  primitive["material"] = at->second;
  if (!is_new) return;
  std::uint64_t without = 0;
  json other = on_sets(wanted, sets_, without);
  if (without > 0)
    notes_.dropped.push_back("textures of material " + model_.scene.materials[group.material].name +
                             " where a mesh has no coordinates for them (" +
                             std::to_string(without) + ")");
  materials.push_back(std::move(other));
}

json MeshWriter::primitive(const json& attributes, const IndexList& list, const Group& group,
                           json& materials) {
  json out = attributes;
  out["indices"] = buffer_.add_indices(list.indices);
  if (list.mode != Mode::triangles) out["mode"] = static_cast<int>(list.mode);
  set_material(out, group, materials);
  return out;
}

/// Vertices alone are a cloud of points.
json MeshWriter::points(const json& attributes, const Group& group, json& materials) {
  json out = attributes;
  out["mode"] = static_cast<int>(Mode::points);
  set_material(out, group, materials);
  return out;
}

void MeshWriter::note_face_data(const Mesh& mesh) {
  for (const Attribute& attribute : mesh.face_attributes)
    notes_.dropped.push_back("face attribute " + attribute.semantic);
  if (std::ranges::any_of(mesh.groups, [](const Group& g) { return !g.name.empty(); }))
    notes_.dropped.push_back("group names of mesh " + mesh.name);
}

std::vector<std::vector<json>> MeshWriter::primitives(std::size_t m, json& materials) {
  const Mesh& mesh = this->mesh(m);
  note_face_data(mesh);
  const json attributes = attributes_of(m);
  auto lists = index_lists(mesh, options_, notes_.dropped);
  std::vector<std::vector<json>> out(lists.size());
  bool is_empty = true;
  for (std::size_t g = 0; g < lists.size(); ++g) {
    if (lists[g].empty() && layouts_) lists[g].push_back(without_faces(mesh, mesh.groups[g].kind));
    for (const IndexList& list : lists[g])
      out[g].push_back(primitive(attributes, list, mesh.groups[g], materials));
    is_empty &= out[g].empty();
  }
  if (is_empty) out.front().push_back(points(attributes, mesh.groups.front(), materials));
  return out;
}

}  // namespace pstrips::inline formats::gltf
