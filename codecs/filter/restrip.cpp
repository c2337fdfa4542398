#include "codecs/filter/restrip.h"

#include <algorithm>

#include "codecs/stripify/best.h"

namespace pstrips::inline codecs {

DisplayStrips restrip(std::span<const Index> strips, std::span<const Index> wedge_vertex) {
  std::vector<Index> triangles;
  triangles.reserve(3 * strips.size());
  Index wedges = 0;
  for_each_triangle(
      strips, [&](Index w) { return wedge_vertex.empty() ? w : wedge_vertex[w]; },
      [&](Index a, Index b, Index c) {
        triangles.insert(triangles.end(), {a, b, c});
        wedges = std::max({wedges, a + 1, b + 1, c + 1});
      });
  const StripInput input{triangles, {}, wedges};
  return best_strips(input, {.effort = 0});
}

}  // namespace pstrips::inline codecs
