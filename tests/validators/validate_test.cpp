#include "validators/validate.h"

#include <gtest/gtest.h>

#include "formats/pstrip/binary.h"
#include "formats/pstrip/xml.h"
#include "tests/support/progressive.h"
#include "validators/rules.h"

namespace pstrip {

void PrintTo(const Finding& finding, std::ostream* out) {
  *out << finding.code << " at " << finding.offset << " (" << finding.path
       << "): " << finding.message;
}

namespace {

using test::random_progressive_of_any_kind;

TEST(Validate, TakesEveryGeneratedFile) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const ProgressiveStrips strips = random_progressive_of_any_kind(seed);
    EXPECT_EQ(validate(write_binary(strips).value()).findings(), std::vector<Finding>{});
    EXPECT_EQ(validate(write_xml(strips)).findings(), std::vector<Finding>{});
  }
}

}  // namespace
}  // namespace pstrip
