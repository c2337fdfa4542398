#include "tests/support/shown.h"

#include <algorithm>

namespace pstrips::test {

std::multiset<std::array<Index, 3>> triangles_of(std::span<const Index> map, const Level& level) {
  std::multiset<std::array<Index, 3>> out;
  for_each_triangle(
      map, [&](Index w) { return level.vertex_of(w); },
      [&](Index a, Index b, Index c) {
        std::array t{a, b, c};
        std::ranges::rotate(t, std::ranges::min_element(t));
        out.insert(t);
      });
  return out;
}

}  // namespace pstrips::test
