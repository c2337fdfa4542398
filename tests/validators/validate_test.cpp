#include "validators/validate.h"

#include <gtest/gtest.h>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/xml/xml.h"
#include "tests/support/paths.h"
#include "tests/support/progressive.h"
#include "tests/validators/edits.h"
#include "tests/validators/finding_text.h"
#include "tests/validators/samples.h"

namespace pstrips {
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

TEST(Validate, TakesTheCompactProfileInBothVariants) {
  const ProgressiveStrips strips = test::compact();
  const Bytes binary = write_binary(strips).value(), xml = write_xml(strips);
  EXPECT_EQ(validate(binary).findings(), std::vector<Finding>{});
  EXPECT_EQ(validate(xml).findings(), std::vector<Finding>{});
  EXPECT_EQ(read_binary(binary).value(), strips);
  EXPECT_EQ(write_binary(read_xml(xml).value()).value(), binary);
}

TEST(Validate, TellsFourAnswersApart) {
  const Bytes whole = test::written(test::roof());
  const auto verdict_of = [](const Bytes& bytes) { return validate(bytes).verdict(); };
  EXPECT_EQ(verdict_of(whole), Verdict::valid);
  EXPECT_EQ(verdict_of(Bytes(whole.begin(), whole.end() - 1)), Verdict::truncated);
  Bytes corrupt = whole;
  corrupt.back() ^= std::byte{1};
  EXPECT_EQ(verdict_of(corrupt), Verdict::invalid);
  EXPECT_EQ(verdict_of(test::recut(test::roof(),
                                   [](test::ChunkFile& f) { f.put("PSHD", 4, std::uint8_t{2}); })),
            Verdict::unsupported);
  ValidateOptions small;
  small.limits.vertices = 6;
  EXPECT_EQ(validate(whole, small).verdict(), Verdict::over_limit);
  EXPECT_EQ(verdict_of({}), Verdict::truncated);
}

TEST(Validate, ATruncatedFileThatIsAlsoCorruptIsInvalid) {
  Bytes bytes = test::edited_mesh(test::roof(), [](ProgressiveMesh& m) { m.map_offsets[0] = 5; });
  bytes.resize(bytes.size() - 8);
  const Report report = validate(bytes);
  EXPECT_EQ(report.verdict(), Verdict::invalid);
  ASSERT_EQ(report.findings().size(), 2u);
  EXPECT_EQ(report.findings()[0].code, "PS0001");
  EXPECT_EQ(report.findings()[1].code, "PS4011");
}

TEST(Validate, SaysWhereInBothVariants) {
  // The third record writes an entry of another vertex.
  ProgressiveStrips strips = test::roof();
  strips.meshes[0].map_offsets[2] = 0;
  const Bytes binary = test::written(strips);
  const Report in_binary = validate(binary);
  ASSERT_EQ(in_binary.findings().size(), 1u);
  const Finding& finding = in_binary.findings()[0];
  EXPECT_EQ(finding.code, "PS4014");
  EXPECT_EQ(finding.clause, "V-014");
  EXPECT_EQ(finding.path, "PCKT 1, vsplit 1, map offset");
  std::uint32_t map_offset = 1;
  std::memcpy(&map_offset, binary.data() + finding.offset, sizeof map_offset);
  EXPECT_EQ(map_offset, 0u);

  const Bytes xml = test::reworded(test::roof(), "map_offsets=\"8\"", "map_offsets=\"0\"");
  const Report in_xml = validate(xml);
  ASSERT_EQ(in_xml.findings().size(), 1u);
  EXPECT_EQ(in_xml.findings()[0].code, "PS4014");
  EXPECT_EQ(in_xml.findings()[0].path, "line 22, /pstrips/packet[1]/vsplit[1]");
  EXPECT_NE(as_text(xml).substr(in_xml.findings()[0].offset).find("<vsplit"), std::string::npos);
}

TEST(Validate, KeepsNoMoreFindingsThanAsked) {
  const Bytes bytes = test::edited_mesh(test::roof(), [](ProgressiveMesh& m) {
    for (Index& entry : m.base_map) entry = 77;
  });
  EXPECT_EQ(validate(bytes).findings().size(), 9u);
  ValidateOptions options;
  options.max_findings = 2;
  const Report report = validate(bytes, options);
  EXPECT_EQ(report.findings().size(), 2u);
  EXPECT_EQ(report.verdict(), Verdict::invalid);
  options.max_findings = 0;
  EXPECT_EQ(validate(bytes, options).verdict(), Verdict::invalid);
}

TEST(Validate, IgnoresAndSharpensRules) {
  const Bytes warned = test::edited_mesh(test::roof(), [](ProgressiveMesh& m) { m.name = "\xff"; });
  EXPECT_EQ(validate(warned).verdict(), Verdict::valid);
  EXPECT_EQ(validate(warned).warnings(), 1u);
  ValidateOptions options;
  options.warnings_as_errors = true;
  EXPECT_EQ(validate(warned, options).verdict(), Verdict::invalid);
  options.ignore = {"PS1008"};
  EXPECT_TRUE(validate(warned, options).findings().empty());

  const Bytes crossed =
      test::edited_mesh(test::roof(), [](ProgressiveMesh& m) { m.base_map[0] = 77; });
  options.ignore = {"PS3001"};  // what stands on the rule is still not asked
  EXPECT_TRUE(validate(crossed, options).findings().empty());
}

TEST(Validate, StopsFilesThatAreMadeToCost) {
  // The records would change 10^7 values; the file has 10^5.
  const Bytes bytes = test::written(test::chained(100'000, 100));
  EXPECT_EQ(validate(bytes).verdict(), Verdict::over_limit);
}

}  // namespace
}  // namespace pstrips
