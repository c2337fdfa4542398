#include "tests/support/shown.h"

#include <algorithm>

namespace pstrips::test {

using Shown = std::multiset<std::array<Index, 3>>;

namespace {

void add(std::array<Index, 3> triangle, Shown& shown) {
  std::ranges::rotate(triangle, std::ranges::min_element(triangle));
  shown.insert(triangle);
}

}  // namespace

Shown triangles_of(std::span<const Index> strips, const Level& level) {
  Shown out;
  for_each_triangle(
      strips, [&](Index w) { return level.vertex_of(w); },
      [&](Index a, Index b, Index c) {
        add({a, b, c}, out);
      });
  return out;
}

Shown triangles_of(const Level& level) {
  Shown out;
  for_each_triangle(level.view(), [&](Index a, Index b, Index c, Index) { add({a, b, c}, out); });
  return out;
}

}  // namespace pstrips::test
