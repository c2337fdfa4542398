#include "formats/pstrip/binary.h"

#include <gtest/gtest.h>

#include "formats/pstrip/check.h"
#include "formats/pstrip/chunks.h"
#include "tests/support/progressive.h"

namespace pstrip {
namespace {

using test::ProgressiveOptions;
using test::random_progressive;
using test::random_progressive_of_any_kind;

TEST(Binary, ReadsWhatItWrote) {
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const ProgressiveStrips strips = random_progressive_of_any_kind(seed);
    const Result<void> holds = check(strips);
    ASSERT_TRUE(holds) << holds.error().message << holds.error().path;
    const Bytes file = write_binary(strips).value();
    const Result<ProgressiveStrips> again = read_binary(file);
    ASSERT_TRUE(again) << again.error().message << " at " << again.error().offset;
    EXPECT_EQ(*again, strips);
  }
}

}  // namespace
}  // namespace pstrip
