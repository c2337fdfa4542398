#include "formats/pstrip/text/losses.h"

namespace pstrips::inline formats {
namespace {

void note_scene(const ProgressiveStrips& strips, Losses& losses) {
  const Scene& scene = strips.scene;
  losses.add(strips.meshes.size() > 1, "that there are several meshes: they are joined");
  losses.add(!scene.nodes.empty(), "scene nodes");
  losses.add(!scene.materials.empty(), "materials");
  losses.add(!scene.images.empty(), "images");
  losses.add(!scene.foreign.empty(), "what the source format keeps for itself");
  losses.add(!strips.unknown.empty(), "chunks that nobody knows");
}

void note_attributes(const ProgressiveMesh& mesh, bool textured, Losses& losses) {
  losses.add(mesh.position.count > 3, "position components past the third");
  losses.add(mesh.position.count < 3, "that positions have fewer than three components");
  losses.add(mesh.position.normalized, "normalization of positions");
  losses.add(mesh.position.semantic != "POSITION", "the semantic " + mesh.position.semantic);
  const Attribute* texture = textured ? texture_of(mesh) : nullptr;
  for (const Attribute& a : mesh.wedge_attributes)
    losses.add(&a != texture, "attribute " + a.semantic);
  if (texture != nullptr) {
    losses.add(texture->count != 2, "that TEXCOORD_0 has not two components");
    losses.add(texture->normalized, "normalization of TEXCOORD_0");
  }
  for (const Attribute& a : mesh.face_attribute_formats)
    losses.add(true, "face attribute " + a.semantic);
}

void note_faces(const ProgressiveStrips& strips, Losses& losses) {
  std::uint64_t polygons = 0, lines = 0, points = 0, degenerate = 0;
  for (const ProgressiveMesh& mesh : strips.meshes)
    for (Index f = 0; f < mesh.faces.count(); ++f) {
      const FaceKind kind = mesh.groups[mesh.faces.group[f]].kind;
      const bool shown = mesh.faces.replaced_first[f] != mesh.faces.replaced_first[f + 1];
      lines += kind == FaceKind::lines;
      points += kind == FaceKind::points;
      polygons += kind == FaceKind::polygons && shown;
      degenerate += kind == FaceKind::polygons && !shown;
    }
  losses.count(polygons, " polygons: their triangles are written");
  losses.count(lines, " lines");
  losses.count(points, " points");
  losses.count(degenerate, " degenerate faces");
}

void note_meshes(const ProgressiveStrips& strips, bool textured, Losses& losses) {
  for (const ProgressiveMesh& mesh : strips.meshes) {
    losses.add(!mesh.name.empty(), "names of meshes");
    losses.add(mesh.groups.size() > 1, "groups");
    losses.add(std::ranges::any_of(mesh.groups, [](const Group& g) { return !g.name.empty(); }),
               "names of groups");
    losses.add(std::ranges::any_of(mesh.groups, [](const Group& g) { return g.material != kNone; }),
               "which group has which material");
    note_attributes(mesh, textured, losses);
    losses.add(!mesh.welding.empty(), "which vertices were welded");
    losses.add(mesh.order != OriginalOrder{}, "original order");
    losses.add(!mesh.digest.empty(), "digest");
  }
}

}  // namespace

const Attribute* texture_of(const ProgressiveMesh& mesh) {
  const auto found = std::ranges::find(mesh.wedge_attributes, "TEXCOORD_0", &Attribute::semantic);
  return found == mesh.wedge_attributes.end() ? nullptr : &*found;
}

Losses losses_of(const ProgressiveStrips& strips, bool textured) {
  Losses losses;
  losses.add(true, "triangle strips, packets and errors of levels");
  note_scene(strips, losses);
  note_meshes(strips, textured, losses);
  note_faces(strips, losses);
  return losses;
}

}  // namespace pstrips::inline formats
