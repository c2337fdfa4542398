#include "core/gather.h"

#include <gtest/gtest.h>

#include <vector>

namespace pstrips {
namespace {

TEST(Gather, TakesRowsInAnyOrderAndMoreThanOnce) {
  for (const std::size_t size : {1, 3, 4, 8, 12, 16}) {
    SCOPED_TRACE(size);
    Bytes table;
    for (std::size_t i = 0; i < 5 * size; ++i) table.push_back(static_cast<std::byte>(i));
    const std::vector<Index> rows{4, 0, 0, 2};
    const Bytes out = gather(table, size, rows);
    ASSERT_EQ(out.size(), rows.size() * size);
    for (std::size_t i = 0; i < out.size(); ++i)
      EXPECT_EQ(out[i], table[rows[i / size] * size + i % size]);
    EXPECT_TRUE(gather(table, size, {}).empty());
  }
}

TEST(Gather, KeepsAnAttributesFormat) {
  const Attribute colour{"COLOR_0", ComponentType::u8, 3, true, Bytes(9, std::byte{7})};
  const Attribute out = gather(colour, std::vector<Index>{1});
  EXPECT_TRUE(out.same_format(colour));
  EXPECT_EQ(out.data, Bytes(3, std::byte{7}));
  EXPECT_EQ(colour.format(), (Attribute{"COLOR_0", ComponentType::u8, 3, true, {}}));
}

}  // namespace
}  // namespace pstrips
