#pragma once

#include <vector>

#include "codecs/stripify/check.h"
#include "core/mesh.h"

namespace pstrips::test {

using pstrips::find_strip_fault;

/// The triangles of a mesh that strips can show, and their groups.
struct StripMesh {
  std::vector<Index> triangles, group;
  Index wedge_count = 0;
  std::vector<double> positions = {};  ///< 3 a wedge
  StripInput input() const { return {triangles, group, wedge_count, positions}; }
};

/// The triangular faces with three distinct vertices, with their groups.
StripMesh strip_mesh(const Mesh& mesh);

/// The polygons of a mesh that strips can show, and their groups.
struct PolygonMesh {
  std::vector<Index> corners, face_first{0}, group;
  Index wedge_count = 0;
  std::vector<double> positions = {};  ///< 3 a wedge
  PolygonInput input() const { return {corners, face_first, group, wedge_count, positions}; }
};

/// The faces of three and more corners, all at different vertices, with their groups.
PolygonMesh polygon_mesh(const Mesh& mesh);

}  // namespace pstrips::test
