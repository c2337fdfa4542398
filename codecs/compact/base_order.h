#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// A numbering of triangles and vertices in which neighbours are near each other.
struct BaseOrder {
  std::vector<Index> triangle;     ///< the old number of each new one
  std::vector<std::uint8_t> turn;  ///< which of its old corners comes first
  std::vector<Index> vertex;       ///< the old number of each new one
};

/// Goes from triangle to triangle breadth first: from each, across the edges that start at its
/// second, third and first corner, to all triangles there that were not reached before. Each starts
/// with the corners of the edge by which it was reached; where no edge leads on, the first triangle
/// that is left comes next. Vertices are numbered as corners come to them, those of no triangle
/// last, ascending.
///
/// triangles  3 distinct vertices each; any complex
/// cost       O(n log n); the same order on every machine
BaseOrder base_order(std::span<const Index> triangles, Index vertices);

}  // namespace pstrips::inline codecs
