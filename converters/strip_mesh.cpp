#include "converters/strip_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/group_by.h"

namespace pstrips::inline converters {
namespace {

// The faces of one group, with wedge numbers of its own, so that a stripifier's arrays are as large
// as the group and not as the mesh.
class GroupFaces {
 public:
  explicit GroupFaces(const Mesh& mesh, bool with_positions)
      : mesh_(mesh), local_(mesh.wedge_count(), kNone) {
    if (with_positions) vertex_positions_ = positions_as_double(mesh);
  }

  void clear() {
    for (const Index wedge : global_) local_[wedge] = kNone;
    global_.clear();
    corners_.clear();
    positions_.clear();
    step_cost_.clear();
    face_first_.assign(1, 0);
  }

  void add(std::span<const Index> face) {
    for (const Index wedge : face) corners_.push_back(number(wedge));
    face_first_.push_back(static_cast<Index>(corners_.size()));
  }

  void add_step_cost(std::span<const std::uint8_t> cost) {
    step_cost_.insert(step_cost_.end(), cost.begin(), cost.end());
  }

  StripInput triangles() const {
    return {.triangles = corners_,
            .group = {},
            .wedge_count = static_cast<Index>(global_.size()),
            .positions = positions_,
            .step_cost = step_cost_};
  }
  PolygonInput polygons() const {
    return {.corners = corners_,
            .face_first = face_first_,
            .group = {},
            .wedge_count = static_cast<Index>(global_.size()),
            .positions = positions_};
  }
  Index global(Index wedge) const { return global_[wedge]; }

 private:
  Index number(Index wedge) {
    if (local_[wedge] != kNone) return local_[wedge];
    local_[wedge] = static_cast<Index>(global_.size());
    global_.push_back(wedge);
    if (!vertex_positions_.empty())
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = vertex_positions_[std::size_t{3} * mesh_.vertex_of(wedge) + k];
        positions_.push_back(std::isfinite(x) ? x : 0);
      }
    return local_[wedge];
  }

  const Mesh& mesh_;
  std::vector<double> vertex_positions_, positions_;
  std::vector<std::uint8_t> step_cost_;
  std::vector<Index> local_, global_, corners_, face_first_{0};
};

// Calls fill(element, faces) for the elements of a group and run(faces) for its strips.
template <class Fill, class Run>
StripMap strip_groups(const Grouped<Index>& elements, GroupFaces& faces, Fill&& fill, Run&& run) {
  const std::size_t groups = elements.keys();
  StripMap out;
  out.group_entries.assign(groups, 0);
  for (std::size_t g = 0; g < groups; ++g) {
    faces.clear();
    for (const Index i : elements[g]) fill(i, faces);
    const Strips strips = run(faces);
    if (strips.empty()) continue;
    if (!out.entries.empty()) {  // behind the last group that has strips
      out.entries.push_back(kRestart);
      const auto before = std::find_if(out.group_entries.rbegin(), out.group_entries.rend(),
                                       [](Index entries) { return entries != 0; });
      ++*before;
    }
    for (const Index entry : strips)
      out.entries.push_back(entry == kRestart ? kRestart : faces.global(entry));
    out.group_entries[g] = static_cast<Index>(strips.size());
  }
  return out;
}

// `vertices` is scratch.
bool meets_no_vertex_twice(const Mesh& mesh, std::span<const Index> face,
                           std::vector<Index>& vertices) {
  vertices.clear();
  for (const Index wedge : face) vertices.push_back(mesh.vertex_of(wedge));
  std::ranges::sort(vertices);
  return std::ranges::adjacent_find(vertices) == vertices.end();
}

}  // namespace

StripMap strip_mesh(const Mesh& mesh, const Triangulation& triangles,
                    const NamedStripifier& stripifier, const StripOptions& options,
                    std::span<const std::uint8_t> step_cost) {
  GroupFaces faces(mesh, stripifier.uses_positions);
  const Grouped<Index> by_group = group_by(mesh.groups.size(), triangles.face.size(), [&](Index t) {
    return mesh.group_of(triangles.face[t]);
  });
  return strip_groups(
      by_group, faces,
      [&](Index t, GroupFaces& out) {
        out.add(std::span(triangles.corners).subspan(std::size_t{3} * t, 3));
        if (!step_cost.empty()) out.add_step_cost(step_cost.subspan(std::size_t{3} * t, 3));
      },
      [&](const GroupFaces& group) { return stripifier.run(group.triangles(), options); });
}

StrippableFaces strippable_faces(const Mesh& mesh) {
  const Triangulation triangles = triangulate(mesh);
  StrippableFaces out;
  const auto add = [&](std::span<const Index> face, Index group) {
    out.corners.insert(out.corners.end(), face.begin(), face.end());
    out.face_first.push_back(static_cast<Index>(out.corners.size()));
    out.group.push_back(group);
  };
  std::vector<Index> scratch;
  std::size_t t = 0;  // the triangles of each face follow each other
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const bool whole = face.size() >= 3 && meets_no_vertex_twice(mesh, face, scratch);
    if (whole) add(face, mesh.group_of(f));
    for (; t < triangles.face.size() && triangles.face[t] == f; ++t)
      if (!whole) add(std::span(triangles.corners).subspan(3 * t, 3), mesh.group_of(f));
  }
  return out;
}

StripMap strip_faces(const Mesh& mesh, const NamedStripifier& stripifier,
                     const StripOptions& options) {
  if (!stripifier.run_polygons || mesh.face_first.empty())
    return strip_mesh(mesh, triangulate(mesh), stripifier, options);
  const StrippableFaces all = strippable_faces(mesh);
  GroupFaces faces(mesh, true);
  const Grouped<Index> by_group =
      group_by(mesh.groups.size(), all.group.size(), [&](Index f) { return all.group[f]; });
  return strip_groups(
      by_group, faces,
      [&](Index f, GroupFaces& out) {
        out.add(std::span(all.corners)
                    .subspan(all.face_first[f], all.face_first[f + 1] - all.face_first[f]));
      },
      [&](const GroupFaces& group) { return stripifier.run_polygons(group.polygons(), options); });
}

}  // namespace pstrips::inline converters
