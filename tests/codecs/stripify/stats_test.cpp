#include "codecs/stripify/stats.h"

#include <gtest/gtest.h>

#include "core/strips.h"

namespace pstrips {
namespace {

constexpr Index kR = kRestart;

TEST(StripStats, CountsByHand) {
  // A lone triangle, two triangles, three around vertex 1 with one swap.
  const std::vector<Index> strips{0, 1, 2, kR, 3, 4, 5, 6, kR, 0, 1, 2, 1, 3, 4};
  const StripStats stats = strip_stats(strips);
  EXPECT_EQ(stats.triangles, 6u);
  EXPECT_EQ(stats.strips, 3u);
  EXPECT_EQ(stats.singletons, 1u);
  EXPECT_EQ(stats.swaps, 1u);
  EXPECT_EQ(stats.entries, 13u);
  EXPECT_EQ(stats.indices_sent, 15u);
  EXPECT_DOUBLE_EQ(stats.acmr16, 7.0 / 6);
}

TEST(StripStats, OfNothingIsZero) {
  EXPECT_EQ(strip_stats({}).strips, 0u);
  EXPECT_EQ(strip_stats({}).acmr16, 0);
}

TEST(CacheMisses, TheFirstInIsTheFirstOut) {
  // 0 is used again but leaves the cache of three when 3 comes; then 1 leaves.
  const std::vector<Index> strips{0, 1, 2, 0, 3, 0, 1};
  EXPECT_DOUBLE_EQ(cache_misses_per_triangle(strips, 3), 6.0 / 4);
  EXPECT_DOUBLE_EQ(cache_misses_per_triangle(strips, 16), 4.0 / 4);
}

}  // namespace
}  // namespace pstrips
