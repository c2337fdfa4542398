#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Utils/StripifierT.hh>

#include "core/strips.h"
#include "tests/bench/peers/adapters.h"

namespace pstrips::bench {

Strips openmesh_strips(const StripInput& input, const StripOptions&) {
  using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;
  ::omerr().disable();  // a line for every triangle that it leaves out
  HalfEdgeMesh mesh;
  for (Index w = 0; w < input.wedge_count; ++w) mesh.add_vertex({});
  for (std::size_t i = 0; i < input.triangles.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return OpenMesh::VertexHandle(static_cast<int>(input.triangles[i + k]));
    };
    mesh.add_face(at(0), at(1), at(2));
  }
  OpenMesh::StripifierT<HalfEdgeMesh> stripifier(mesh);
  stripifier.stripify();
  Strips strips;
  for (auto strip = stripifier.begin(); strip != stripifier.end(); ++strip) {
    if (!strips.empty()) strips.push_back(kRestart);
    for (const auto vertex : *strip) strips.push_back(static_cast<Index>(vertex));
  }
  return strips;
}

}  // namespace pstrips::bench
