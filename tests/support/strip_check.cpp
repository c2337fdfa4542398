#include "tests/support/strip_check.h"

#include <cmath>

namespace pstrip::test {

StripMesh strip_mesh(const Mesh& mesh) {
  StripMesh out;
  out.wedge_count = mesh.wedge_count();
  const std::vector<double> vertices = positions_as_double(mesh);
  for (Index w = 0; w < out.wedge_count; ++w)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = vertices[std::size_t{3} * mesh.vertex_of(w) + k];
      out.positions.push_back(std::isfinite(x) ? x : 0);
    }
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

}  // namespace pstrip::test
