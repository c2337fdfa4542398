#include "converters/losses.h"

#include <map>
#include <optional>

#include "formats/gltf/kept_kinds.h"

namespace pstrips::inline converters {
namespace {

/// The feature that a format needs for a kind; nothing for what writers judge for themselves.
std::optional<Feature> needed_for(const std::string& kind) {
  if (kind == "faces") return Feature::faces;
  if (kind == "lines") return Feature::lines;
  if (kind == "points") return Feature::points;
  if (kind == "materials") return Feature::materials;
  if (kind.starts_with("attribute ") || kind.starts_with("face attribute ")) return std::nullopt;
  if (kind == "morph targets") return Feature::attributes;
  if (kind == "extension KHR_texture_transform") return std::nullopt;  // part of a material
  if (kind == "meshes" || kind == "vertices" || kind == "images" || kind == "nodes")
    return std::nullopt;
  return Feature::asset;
}

const char* name_of(FaceKind kind) {
  switch (kind) {
    case FaceKind::lines:
      return "lines";
    case FaceKind::points:
      return "points";
    default:
      return "faces";
  }
}

/// "TARGET_3/POSITION" counts as a morph target once.
std::string kind_of(const Attribute& attribute) {
  const std::size_t slash = attribute.semantic.find('/');
  const bool is_target = attribute.semantic.starts_with("TARGET_") && slash != std::string::npos;
  return is_target ? "morph targets" : "attribute " + attribute.semantic;
}

void count_mesh(const Mesh& mesh, std::map<std::string, std::uint64_t>& counts) {
  counts["vertices"] += mesh.vertex_count();
  for (Index f = 0; f < mesh.face_count(); ++f)
    ++counts[name_of(mesh.groups[mesh.group_of(f)].kind)];
  std::string last_target;
  for (const Attribute& attribute : mesh.wedge_attributes) {
    const std::string kind = kind_of(attribute);
    if (kind != "morph targets") {
      ++counts[kind];
      continue;
    }
    const std::string target = attribute.semantic.substr(0, attribute.semantic.find('/'));
    if (target != last_target) ++counts[kind];
    last_target = target;
  }
  for (const Attribute& attribute : mesh.face_attributes)
    ++counts["face attribute " + attribute.semantic];
}

}  // namespace

std::vector<KindCount> kinds_of(const Model& model) {
  std::map<std::string, std::uint64_t> counts;
  counts["meshes"] = model.meshes.size();
  counts["materials"] = model.scene.materials.size();
  counts["images"] = model.scene.images.size();
  counts["nodes"] = model.scene.nodes.size();
  for (const Mesh& mesh : model.meshes) count_mesh(mesh, counts);
  for (const auto& [kind, count] : kept_kinds(model.scene)) counts[kind] += count;
  std::vector<KindCount> out;
  for (const auto& [kind, count] : counts)
    if (count > 0) out.push_back({kind, count});
  return out;
}

Arrivals arrivals(const Model& model, FileFormat target) {
  Arrivals out;
  for (KindCount& kind : kinds_of(model)) {
    const std::optional<Feature> needed = needed_for(kind.kind);
    // Writers say themselves what they do with geometry and materials.
    if (needed == Feature::asset && !holds(target, Feature::asset))
      out.dropped.push_back(std::move(kind));
    else if (!needed || holds(target, *needed))
      out.kept.push_back(std::move(kind));
  }
  return out;
}

}  // namespace pstrips::inline converters
