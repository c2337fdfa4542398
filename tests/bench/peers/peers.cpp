#include "tests/bench/peers/peers.h"

#include "tests/bench/peers/adapters.h"

namespace pstrips::bench {
namespace {

constexpr NamedStripifier kPeers[] = {
#ifdef PSTRIPS_MESHOPTIMIZER
    {.name = "meshoptimizer",
     .source = "meshopt_optimizeVertexCacheStrip, meshopt_stripify",
     .run = meshoptimizer_strips},
#endif
#ifdef PSTRIPS_OPENMESH
    {.name = "OpenMesh", .source = "OpenMesh::StripifierT", .run = openmesh_strips},
#endif
#ifdef PSTRIPS_VTK
    {.name = "VTK", .source = "vtkStripper", .run = vtk_strips},
#endif
    {},  // there may be none
};

}  // namespace

std::span<const NamedStripifier> peer_stripifiers() {
  return std::span(kPeers).first(std::size(kPeers) - 1);
}

}  // namespace pstrips::bench
