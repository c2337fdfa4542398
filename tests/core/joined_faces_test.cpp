#include "core/joined_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/edge_pairs.h"

namespace pstrips {
namespace {

// A hexagon 0 to 5 cut in a zigzag, and a triangle beside it over the edge from 2 to 3.
const std::vector<Index> kHexagon = {0, 1, 5, 1, 2, 5, 2, 4, 5, 2, 3, 4, 3, 2, 6};

TEST(EdgePairs, AreOfOneGroupAndRunEitherWay) {
  const std::vector<Index> pairs = pair_half_edges(kHexagon, {}, 7);
  ASSERT_EQ(pairs.size(), kHexagon.size());
  EXPECT_EQ(pairs[1], 5u);   // 1 5
  EXPECT_EQ(pairs[4], 8u);   // 2 5
  EXPECT_EQ(pairs[9], 12u);  // 2 3
  EXPECT_EQ(pairs[0], kNone);
  const std::vector<Index> group = {0, 0, 1, 1, 1};
  EXPECT_EQ(pair_half_edges(kHexagon, group, 7)[4], kNone);
  // Three triangles at an edge: the first two are a pair; those that run one way are none.
  EXPECT_EQ(pair_half_edges(std::vector<Index>{0, 1, 2, 1, 0, 3, 1, 0, 4}, {}, 5),
            (std::vector<Index>{3, kNone, kNone, 0, kNone, kNone, kNone, kNone, kNone}));
}

TEST(JoinedFaces, GiveAPolygonBackWhereverItStarts) {
  const std::vector<Index> pairs = pair_half_edges(kHexagon, {}, 7);
  const std::vector<Index> triangles = {0, 1, 2, 3};
  std::vector<Index> corners = {0, 1, 2, 3, 4, 5};
  for (Index turn = 0; turn < 6; ++turn) {
    JoinedFaces joined(pairs);
    EXPECT_EQ(joined.join_turned(triangles, corners, kHexagon), turn);
    const FaceTable table = joined.faces(kHexagon, {});
    EXPECT_EQ(table.first, (std::vector<Index>{0, 6}));
    EXPECT_EQ(table.corners, (std::vector<Index>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(table.replaced, triangles);
    EXPECT_EQ(JoinedFaces(pairs).join_polygon(triangles, corners, kHexagon), turn == 0);
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST(JoinedFaces, LeaveOutWhatIsNoPolygonOfItsTriangles) {
  const std::vector<Index> pairs = pair_half_edges(kHexagon, {}, 7);
  const struct {
    std::vector<Index> triangles, corners;
  } kRows[] = {{{0, 1}, {0, 1, 5, 2}},  // another way round
               {{0, 2}, {0, 1, 5, 2}},  // not beside each other
               {{0, 1}, {0, 1, 2}},     // too few corners
               {{0}, {0, 1, 5}}};       // one triangle
  for (const auto& row : kRows) {
    JoinedFaces joined(pairs);
    EXPECT_EQ(joined.join_turned(row.triangles, row.corners, kHexagon), kNone);
    EXPECT_TRUE(joined.faces(kHexagon, {}).first.empty());
  }
  // Around a vertex: as many joins as triangles.
  const std::vector<Index> fan = {0, 1, 2, 0, 2, 3, 0, 3, 1};
  const std::vector<Index> of_fan = pair_half_edges(fan, {}, 4);
  JoinedFaces joined(of_fan);
  EXPECT_EQ(joined.join_turned(std::vector<Index>{0, 1, 2}, std::vector<Index>{1, 2, 3, 1, 2}, fan),
            kNone);
}

}  // namespace
}  // namespace pstrips
