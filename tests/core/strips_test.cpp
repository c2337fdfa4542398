#include "core/strips.h"

#include <gtest/gtest.h>

#include <array>

namespace pstrips {
namespace {

constexpr Index kR = kRestart, kM2 = kSameAsMinus2, kM1 = kSameAsMinus1, kP1 = kSameAsPlus1,
                kP2 = kSameAsPlus2;
using Map = std::vector<Index>;
using Triangles = std::vector<std::array<Index, 3>>;

Triangles triangles_of(const Map& map) {
  Triangles out;
  for_each_triangle(
      map, [](Index w) { return w; },
      [&](Index a, Index b, Index c) {
        out.push_back({a, b, c});
      });
  return out;
}

TEST(Symbols, DistancesComeBack) {
  for (const int d : {-2, -1, 1, 2}) {
    EXPECT_EQ(distance_of(symbol_of(d)), d);
    EXPECT_TRUE(is_symbol(symbol_of(d)));
    EXPECT_FALSE(is_wedge(symbol_of(d)));
  }
  EXPECT_FALSE(is_symbol(kR));
  EXPECT_TRUE(is_wedge(kMaxCount));
}

TEST(Resolve, FollowsChainsBothWays) {
  EXPECT_EQ(resolve(Map{4, kM1, 5, kM2, kR, kP2, kP1, 6, kM1}).value(),
            (Map{4, 4, 5, 4, kR, 6, 6, 6, 6}));
}

struct BadMap {
  const char* name;
  Map map;
};
const BadMap kBadMaps[] = {
    {"before the start", {kM1, 1}},      {"past the end", {1, kP1}},
    {"two past the end", {1, kP2, 1}},   {"onto a restart", {1, kP1, kR, 2}},
    {"over a restart", {1, kP2, kR, 2}}, {"back over a restart", {1, kR, kM2}},
    {"a cycle of two", {kP1, kM1}},      {"a cycle of three", {1, kP2, kM1, kM1}},
};

TEST(Resolve, RefusesChainsWithoutAWedgeInTheStrip) {
  for (const BadMap& bad : kBadMaps) {
    SCOPED_TRACE(bad.name);
    const auto resolved = resolve(bad.map);
    ASSERT_FALSE(resolved);
    EXPECT_EQ(resolved.error().code, ErrorCode::corrupt);
    EXPECT_LT(resolved.error().offset, bad.map.size());
  }
}

TEST(Resolve, LongChainsCostLinearTime) {
  Map map(1'000'000, kP1);
  map.back() = 7;
  EXPECT_EQ(resolve(map).value(), Map(map.size(), 7));
}

TEST(ForEachTriangle, AlternatesWindingAndSkipsDegenerates) {
  EXPECT_EQ(triangles_of({0, 1, 2, 3}), (Triangles{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(triangles_of({0, 1, 2, 1, 3}), (Triangles{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(triangles_of({0, 0, 1, 2}), (Triangles{{1, 0, 2}}));
}

TEST(ForEachTriangle, StartsEachStripAfresh) {
  EXPECT_EQ(triangles_of({0, 1, 2, kR, 3, 4, 5}), (Triangles{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(triangles_of({0, 1, 2, 3, kR, 3, 4, 5}), (Triangles{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}));
  EXPECT_EQ(triangles_of({kR, kR, 0, kR, 0, 1, kR, 0, 1, 2, kR}), (Triangles{{0, 1, 2}}));
  EXPECT_EQ(triangles_of({}), Triangles{});
}

}  // namespace
}  // namespace pstrips
