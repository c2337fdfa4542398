#pragma once

#include "codecs/collapse.h"
#include "core/mesh.h"
#include "core/progressive_strips.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline converters {

inline constexpr unsigned kMinPositionBits = 8, kMaxPositionBits = 24;

/// The grid of the meshes of a file in the compact profile.
///
/// bits    kMinPositionBits to kMaxPositionBits: points on which positions are to be put, 2^bits of
///         them along the longest side of a box around all meshes. 0: cells for positions that stay
///         as they are, small enough that levels show no steps
/// errors  unsupported: with bits, positions that are no floats, or not finite
Result<PositionGrid> position_grid(const Model& model, unsigned bits);

/// That of positions of an integer type, which stay as they are: cells of a power of two where they
/// have more than 23 bits.
PositionGrid integer_grid(const Attribute& position);

/// Moves each vertex to the point of the grid next to it. Positions become f32.
///
/// grid     of bits, for floats
/// returns  the largest distance that one has moved, model units
double move_to_grid(Mesh& mesh, const PositionGrid& grid);

/// Places the kept vertex of each collapse in the middle between the two, rounded down to the grid
/// or to cells: what the compact profile takes for optimal placement. [spec/compact.md §3]
void place_in_the_middle(const Mesh& mesh, const PositionGrid& grid, CollapseSequence& sequence);

}  // namespace pstrips::inline converters
