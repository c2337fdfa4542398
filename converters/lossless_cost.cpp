#include "converters/lossless_cost.h"

#include "formats/pstrip/payload/compact/fine.h"

namespace pstrips::inline converters {

std::uint64_t bytes_below_cells(const ProgressiveStrips& strips) {
  std::uint64_t bytes = 0;
  if (strips.profile != Profile::compact) return bytes;
  for (const ProgressiveMesh& mesh : strips.meshes) {
    const MeshCells cells = cells_of(mesh);
    if (!is_exact(cells)) bytes += fine_bytes(mesh, cells);
  }
  return bytes;
}

}  // namespace pstrips::inline converters
