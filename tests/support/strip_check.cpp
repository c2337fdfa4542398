#include "tests/support/strip_check.h"

#include <algorithm>
#include <cmath>

namespace pstrips::test {

namespace {

// Three a wedge; what is not finite is 0.
std::vector<double> finite_positions(const Mesh& mesh) {
  const std::vector<double> vertices = positions_as_double(mesh);
  std::vector<double> out;
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = vertices[std::size_t{3} * mesh.vertex_of(w) + k];
      out.push_back(std::isfinite(x) ? x : 0);
    }
  return out;
}

}  // namespace

StripMesh strip_mesh(const Mesh& mesh) {
  StripMesh out;
  out.wedge_count = mesh.wedge_count();
  out.positions = finite_positions(mesh);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() != 3) continue;
    const Index a = mesh.vertex_of(face[0]), b = mesh.vertex_of(face[1]),
                c = mesh.vertex_of(face[2]);
    if (a == b || b == c || a == c) continue;
    out.triangles.insert(out.triangles.end(), face.begin(), face.end());
    out.group.push_back(mesh.group_of(f));
  }
  return out;
}

PolygonMesh polygon_mesh(const Mesh& mesh) {
  PolygonMesh out;
  out.wedge_count = mesh.wedge_count();
  out.positions = finite_positions(mesh);
  std::vector<Index> vertices;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() < 3 || mesh.groups[mesh.group_of(f)].kind != FaceKind::polygons) continue;
    vertices.clear();
    for (const Index w : face) vertices.push_back(mesh.vertex_of(w));
    std::ranges::sort(vertices);
    if (std::ranges::adjacent_find(vertices) != vertices.end()) continue;
    out.corners.insert(out.corners.end(), face.begin(), face.end());
    out.face_first.push_back(static_cast<Index>(out.corners.size()));
    out.group.push_back(mesh.group_of(f));
  }
  return out;
}

}  // namespace pstrips::test
