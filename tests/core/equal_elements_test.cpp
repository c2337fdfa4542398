#include "core/equal_elements.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace pstrips {
namespace {

std::vector<Index> expected(const std::string& table, std::size_t size) {
  std::map<std::string, Index> seen;
  std::vector<Index> out;
  for (std::size_t i = 0; i < table.size() / size; ++i)
    out.push_back(
        seen.try_emplace(table.substr(i * size, size), static_cast<Index>(i)).first->second);
  return out;
}

TEST(FirstEquals, IsTheFirstOneOfEachKind) {
  EXPECT_EQ(first_equals(as_bytes("abcabxabc"), 3, 1), (std::vector<Index>{0, 1, 0}));
  EXPECT_EQ(first_equals(as_bytes(""), 3, 1), std::vector<Index>{});
}

RC_GTEST_PROP(FirstEquals, AgreesWithAMapForAnyNumberOfThreads, ()) {
  const std::size_t size = *rc::gen::inRange<std::size_t>(1, 10);
  const std::size_t count = *rc::gen::inRange<std::size_t>(0, 400);
  const auto table = *rc::gen::container<std::string>(size * count, rc::gen::inRange('a', 'c'));
  for (const unsigned threads : {1u, 3u})
    RC_ASSERT(first_equals(as_bytes(table), size, threads) == expected(table, size));
}

// Enough for several runs of each kind of work.
TEST(FirstEquals, SharesALongTableAmongThreads) {
  std::string table;
  for (std::size_t i = 0; i < 300'000; ++i) table += std::to_string(100'000 + i * i % 90'001);
  EXPECT_EQ(first_equals(as_bytes(table), 6, 1), expected(table, 6));
  EXPECT_EQ(first_equals(as_bytes(table), 6, 4), expected(table, 6));
}

}  // namespace
}  // namespace pstrips
