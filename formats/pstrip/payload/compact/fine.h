#pragma once

#include <cstdint>
#include <span>

#include "formats/pstrip/payload/compact/attribute_cells.h"

// For formats/pstrip/payload/compact: the payload of FINE, the bits below the cells. Vertices
// first, then each attribute, component by component, lowest bit first, without gaps.
// [spec/compact.md §8]

namespace pstrips::inline formats {

/// How the numbers of a mesh lie in cells.
struct MeshCells {
  PositionCells positions;
  std::vector<AttributeCells> attributes;  ///< one a wedge attribute
};

/// The cells that a mesh is written with: those of its grid; of attributes the coarsest that are
/// exact, else some of 12 bits. O(wedges)
MeshCells cells_of(const ProgressiveMesh& mesh);

/// Numbers that packets code of a wedge.
inline unsigned columns_of(const MeshCells& cells) {
  unsigned columns = 0;
  for (const AttributeCells& a : cells.attributes) columns += a.columns();
  return columns;
}

/// Nothing is below the cells: the mesh needs no FINE.
bool is_exact(const MeshCells& cells);

/// How many bytes the bits of a mesh take: of all its vertices and wedges. O(vertices + wedges).
std::uint64_t fine_bytes(const ProgressiveMesh& mesh, const MeshCells& cells);

/// out  of fine_bytes(), all zero
void write_fine(const ProgressiveMesh& mesh, const MeshCells& cells, std::span<std::byte> out);

/// Completes the numbers of a mesh of which packets brought the cells.
///
/// returns  false, and the mesh stays as it is: `bytes` is not as long as fine_bytes(), or does not
///          end in zeros
bool read_fine(ByteView bytes, const MeshCells& cells, ProgressiveMesh& mesh);

}  // namespace pstrips::inline formats
