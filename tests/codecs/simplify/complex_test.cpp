#include "codecs/simplify/complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pstrips {
namespace {

// The triangles around vertex 0 of a flat fan, as pairs of next and previous.
Complex fan(const std::vector<std::pair<Index, Index>>& corners) {
  std::vector<double> positions(60);
  for (std::size_t i = 3; i < positions.size(); i += 3) {
    positions[i] = static_cast<double>(i);
    positions[i + 1] = static_cast<double>(i * i);
  }
  std::vector<Index> triangles;
  for (const auto& [next, previous] : corners)
    triangles.insert(triangles.end(), {0, next, previous});
  return Complex(positions, {}, triangles);
}

bool is_regular(const std::vector<std::pair<Index, Index>>& corners) {
  Complex complex = fan(corners);
  Star star;
  complex.gather_regular(0, star);
  return star.is_regular();
}

TEST(Star, IsRegularWhereEachEdgeHasTwoTrianglesOfOppositeDirection) {
  EXPECT_TRUE(is_regular({{1, 2}, {2, 3}, {3, 1}}));
  EXPECT_TRUE(is_regular({{3, 1}, {1, 2}, {4, 5}, {2, 3}, {5, 4}}));  // two fans
  EXPECT_FALSE(is_regular({{1, 2}, {2, 3}}));                         // open
  EXPECT_FALSE(is_regular({{1, 2}, {2, 3}, {1, 3}}));                 // one turned
  EXPECT_FALSE(is_regular({{1, 2}, {2, 1}, {1, 2}, {2, 1}}));         // four on an edge
  EXPECT_FALSE(is_regular({{1, 1 + 3}, {1, 5}, {5, 1}}));
  std::vector<std::pair<Index, Index>> large;
  for (Index i = 1; i < 18; ++i) large.push_back({i, i % 17 + 1});
  EXPECT_FALSE(is_regular(large));  // not told apart
}

TEST(Star, MeasuresItsTriangles) {
  const double positions[] = {0, 0, 0, 2, 0, 0, 0, 2, 0, -2, 0, 0, 0, 0, 2, 8, 8, 8};
  const Index triangles[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 0, 1, 3};  // the last is a line
  Complex complex(positions, {}, triangles);
  Star star;
  complex.gather(0, star);
  ASSERT_EQ(star.corners.size(), 5u);
  const Quadric sum = star.measure();
  const double unit = 2 * complex.scale[0] * complex.scale[1];  // of 2 model units
  const auto area = static_cast<float>(unit * unit / 2);
  EXPECT_FLOAT_EQ(sum.weight, 4 * area);
  EXPECT_FLOAT_EQ(sum.zz, 2 * area);
  EXPECT_FLOAT_EQ(sum.yy, 2 * area);
  EXPECT_EQ(sum.xx, 0);
  EXPECT_EQ(star.normal(0).z, 1);
  EXPECT_EQ(star.normal(2).y, 1);
  EXPECT_EQ(star.normal(4).x * star.normal(4).x + star.normal(4).y + star.normal(4).z, 0);
  EXPECT_EQ(star.edges.size(), 4u);
  EXPECT_EQ(star.open_edges, 2u);  // to 1 and 3: three triangles
}

}  // namespace
}  // namespace pstrips
