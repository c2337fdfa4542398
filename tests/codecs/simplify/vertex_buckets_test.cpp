#include "codecs/simplify/vertex_buckets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace pstrips {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(VertexBuckets, LeavesOutInfiniteKeys) {
  const float keys[] = {kInfinity, 2, kInfinity, 1};
  VertexBuckets queue(keys);
  EXPECT_EQ(queue.pop(), 3u);
  EXPECT_GE(queue.limit(), 1);
  EXPECT_LT(queue.limit(), 1.1f);
  EXPECT_EQ(queue.ahead(1), kNone);
  EXPECT_EQ(queue.pop(), 1u);
  EXPECT_EQ(queue.pop(), kNone);
  EXPECT_EQ(queue.pop(), kNone);
}

TEST(VertexBuckets, TakesKeysOfAnySize) {
  const float keys[] = {std::numeric_limits<float>::max(), 0,
                        std::numeric_limits<float>::denorm_min(), 1e-30f};
  VertexBuckets queue(keys);
  for (const Index expected : {1u, 2u, 3u, 0u}) {
    EXPECT_EQ(queue.pop(), expected);
    EXPECT_GE(queue.limit(), keys[expected]);
  }
}

TEST(VertexBuckets, WorksAStepThroughByIndexAndTellsWhatComes) {
  const float keys[] = {1.01f, 1, 3, 1.02f, 1};
  VertexBuckets queue(keys);
  EXPECT_EQ(queue.pop(), 0u);
  EXPECT_EQ(queue.ahead(1), 1u);
  EXPECT_EQ(queue.ahead(3), 4u);
  EXPECT_EQ(queue.ahead(4), kNone);
  queue.remove(3);
  queue.put(2, 0.5f);  // below the step: joins it
  EXPECT_EQ(queue.pop(), 1u);
  queue.put(1, 1);
  EXPECT_EQ(queue.pop(), 4u);
  EXPECT_EQ(queue.pop(), 2u);
  EXPECT_EQ(queue.pop(), 1u);
  EXPECT_EQ(queue.pop(), kNone);
}

// Beside a plain list of keys: each vertex that comes is in, none that is left is in a lower step.
TEST(VertexBuckets, KeepsTheOrderOfSteps) {
  std::mt19937 random(7);
  const auto key = [&] { return static_cast<float>(1 + random() % 1000); };
  std::vector<float> keys(300);
  std::ranges::generate(keys, key);
  VertexBuckets queue(keys);
  float step = 0;
  int popped = 0;
  for (Index v; (v = queue.pop()) != kNone; ++popped) {
    ASSERT_LT(keys[v], kInfinity);
    ASSERT_LE(keys[v], queue.limit());
    ASSERT_GE(queue.limit(), step);
    step = queue.limit();
    for (const float k : keys) ASSERT_GT(k, step / 1.1f);
    keys[v] = kInfinity;
    if (popped > 2000) continue;  // or it might never be empty
    const Index x = static_cast<Index>(random() % keys.size());
    if (random() % 4 == 0) {
      keys[x] = kInfinity;
      queue.remove(x);
    } else {
      keys[x] = std::max(key(), step / 1.05f);
      queue.put(x, keys[x]);
    }
  }
  EXPECT_TRUE(std::ranges::all_of(keys, [](float k) { return k == kInfinity; }));
  EXPECT_GT(popped, 400);
}

}  // namespace
}  // namespace pstrips
