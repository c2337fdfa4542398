#include "codecs/simplify/vertex_heap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace pstrip {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(VertexHeap, LeavesOutInfiniteKeys) {
  const float keys[] = {kInfinity, 2, kInfinity, 1};
  VertexHeap heap(keys);
  EXPECT_FALSE(heap.contains(0));
  EXPECT_EQ(heap.top(), 3u);
  EXPECT_EQ(heap.second_key(), 2);
  heap.remove(3);
  EXPECT_EQ(heap.top(), 1u);
  EXPECT_EQ(heap.second_key(), kInfinity);
  heap.remove(1);
  EXPECT_TRUE(heap.empty());
}

TEST(VertexHeap, AgreesWithAnOrderedSet) {
  std::mt19937 random(7);
  const auto key = [&] { return static_cast<float>(random() % 50); };  // many equal ones
  std::vector<float> keys(300);
  std::ranges::generate(keys, key);
  VertexHeap heap(keys);
  std::set<std::pair<float, Index>> set;
  for (Index v = 0; v < keys.size(); ++v) set.emplace(keys[v], v);
  int inserted = 0;
  while (!set.empty()) {
    ASSERT_FALSE(heap.empty());
    ASSERT_EQ(heap.top(), set.begin()->second);
    ASSERT_EQ(heap.second_key(), set.size() > 1 ? std::next(set.begin())->first : kInfinity);
    const Index v = static_cast<Index>(random() % keys.size());
    if (!heap.contains(v)) {
      if (inserted == 500) continue;  // or it would never be empty
      ++inserted;
      keys[v] = key();
      heap.insert(v, keys[v]);
      set.emplace(keys[v], v);
      continue;
    }
    set.erase({keys[v], v});
    if (random() % 3 != 0) {
      heap.remove(v);
    } else {
      keys[v] = key();
      heap.update(v, keys[v]);
      set.emplace(keys[v], v);
    }
  }
  EXPECT_TRUE(heap.empty());
}

}  // namespace
}  // namespace pstrip
