#include "core/group_by.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pstrips {
namespace {

TEST(GroupBy, ListsNumbersByKeyInTheirOrder) {
  const std::vector<Index> key{2, 0, 2, 4, 0};
  const Grouped<Index> grouped = group_by(5, key.size(), [&](Index i) { return key[i]; });
  EXPECT_EQ(grouped.keys(), 5u);
  EXPECT_EQ(grouped.first, (std::vector<Index>{0, 2, 2, 4, 4, 5}));
  EXPECT_EQ(grouped.elements, (std::vector<Index>{1, 4, 0, 2, 3}));
  EXPECT_TRUE(grouped[1].empty());
  EXPECT_EQ(grouped[2].front(), 0u);
  EXPECT_EQ(grouped[2].back(), 2u);
}

TEST(GroupBy, TakesNoElementsAndNoKeys) {
  const auto unused = [](Index) -> Index { return 0; };
  EXPECT_EQ(group_by(2, 0, unused).first, (std::vector<Index>{0, 0, 0}));
  EXPECT_EQ(group_by(0, 0, unused).keys(), 0u);
  EXPECT_EQ(Grouped<Index>{}.keys(), 0u);
}

TEST(GroupEach, MakesEachElementOnce) {
  int made = 0;
  const Grouped<std::string> grouped = group_each<std::string>(2, [&](auto&& visit) {
    for (const char* word : {"b", "a", "bb"})
      visit(word[0] == 'a' ? 0u : 1u, [&] { return ++made, std::string(word); });
  });
  EXPECT_EQ(made, 3);
  EXPECT_EQ(grouped.elements, (std::vector<std::string>{"a", "b", "bb"}));
}

RC_GTEST_PROP(GroupBy, IsAStableSort, (const std::vector<std::uint8_t>& keys)) {
  std::vector<Index> sorted(keys.size());
  for (Index i = 0; i < sorted.size(); ++i) sorted[i] = i;
  std::ranges::stable_sort(sorted, {}, [&](Index i) { return keys[i]; });
  const Grouped<Index> grouped = group_by(256, keys.size(), [&](Index i) { return keys[i]; });
  RC_ASSERT(grouped.elements == sorted);
  for (std::size_t k = 0; k < 256; ++k)
    for (const Index i : grouped[k]) RC_ASSERT(keys[i] == k);
}

}  // namespace
}  // namespace pstrips
