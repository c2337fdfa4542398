#include "formats/obj/plan.h"

#include <algorithm>

namespace pstrips::inline formats::obj {
namespace {

/// OBJ has colours and weights on vertices only.
void keep_if_of_vertex(const Mesh& mesh, const MeshPlan& plan, const Attribute*& attribute,
                       std::set<std::string>& dropped) {
  if (!attribute) return;
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    if (!std::ranges::equal(attribute->element(w),
                            attribute->element(plan.vertex_wedge[mesh.vertex_of(w)]))) {
      dropped.insert(attribute->semantic);
      attribute = nullptr;
      return;
    }
}

void report_unused(const Mesh& mesh, const MeshPlan& plan, std::set<std::string>& dropped) {
  const auto is_zero = [](std::byte b) { return b == std::byte{0}; };
  for (const Attribute* a : {plan.normal, plan.texcoord})
    for (Index w = 0; a && w < mesh.wedge_count(); ++w)
      if (!plan.used[w] && !std::ranges::all_of(a->element(w), is_zero))
        dropped.insert(a->semantic + " of wedges without a face");
}

void report_vertex_values(const Mesh& mesh, const MeshPlan& plan, std::set<std::string>& dropped) {
  if (mesh.position.count > 3) dropped.insert("POSITION beyond xyz");
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index w = plan.vertex_wedge[v];
    if (plan.color && plan.weight && plan.has(w, kHasColor) && plan.has(w, kHasWeight))
      dropped.emplace(kObjWeight);
  }
  const bool has_tuples = plan.normal || plan.texcoord;
  if (has_tuples && std::ranges::find(plan.used, false) != plan.used.end())
    report_unused(mesh, plan, dropped);
}

}  // namespace

MeshPlan plan_mesh(const Mesh& mesh, bool alone, std::set<std::string>& dropped) {
  MeshPlan plan;
  for (const Attribute& a : mesh.wedge_attributes) {
    if (a.semantic == "NORMAL" && a.count == 3)
      plan.normal = &a;
    else if (a.semantic == "TEXCOORD_0")
      plan.texcoord = &a;
    else if (a.semantic == "COLOR_0" && (a.count == 3 || a.count == 4))
      plan.color = &a;
    else if (a.semantic == kObjTexW && a.count == 1)
      plan.texw = &a;
    else if (a.semantic == kObjWeight && a.count == 1)
      plan.weight = &a;
    else if (a.semantic == kObjPresent && a.count == 1 && a.type == ComponentType::u8)
      plan.present = &a;
    else
      dropped.insert(a.semantic);
  }
  for (const Attribute& a : mesh.face_attributes) {
    if (a.semantic == kObjSmoothing && a.count == 1 && a.type == ComponentType::u32)
      plan.smoothing = &a;
    else
      dropped.insert(a.semantic);
  }
  if (plan.texw && (!plan.texcoord || plan.texcoord->count > 2)) {
    dropped.emplace(kObjTexW);
    plan.texw = nullptr;
  }
  plan.used.assign(mesh.wedge_count(), false);
  for (const Index w : mesh.corners) plan.used[w] = true;
  plan.cloud = alone && mesh.corners.empty() && mesh.wedge_count() == mesh.vertex_count() &&
               mesh.wedge_vertex.empty();
  if (plan.cloud) plan.used.assign(mesh.wedge_count(), true);
  plan.vertex_wedge.assign(mesh.vertex_count(), 0);
  for (Index w = mesh.wedge_count(); w-- > 0;) plan.vertex_wedge[mesh.vertex_of(w)] = w;
  keep_if_of_vertex(mesh, plan, plan.color, dropped);
  keep_if_of_vertex(mesh, plan, plan.weight, dropped);
  report_vertex_values(mesh, plan, dropped);
  return plan;
}

}  // namespace pstrips::inline formats::obj
