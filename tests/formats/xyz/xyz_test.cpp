#include "formats/xyz/xyz.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pstrips {
namespace {

using Numbers = std::vector<double>;

struct Good {
  const char* name;
  const char* text;
  Numbers positions;
};

const Good kGood[] = {
    {"nothing", "", {}},
    {"a comment only", "# no points\n\n", {}},
    {"plain", "1 2 3\n4 5 6\n", {1, 2, 3, 4, 5, 6}},
    {"no line end at the end", "1 2 3\n4 5 6", {1, 2, 3, 4, 5, 6}},
    {"line ends of DOS", "1 2 3\r\n4 5 6\r\n", {1, 2, 3, 4, 5, 6}},
    {"line ends of old", "1 2 3\r4 5 6\r", {1, 2, 3, 4, 5, 6}},
    {"a mark of UTF-8",
     "\xef\xbb\xbf"
     "1 2 3\n",
     {1, 2, 3}},
    {"blanks and tabs", "\t1  2\t3 \n\n  \n4 5 6\n", {1, 2, 3, 4, 5, 6}},
    {"commas and semicolons", "1,2,3\n4; 5; 6\n", {1, 2, 3, 4, 5, 6}},
    {"comments", "# x y z\n1 2 3 # first\n#4 5 6\n7 8 9\n", {1, 2, 3, 7, 8, 9}},
    {"colours and names behind", "1 2 3 255 0 0 tree\n4 5 6 #\n", {1, 2, 3, 4, 5, 6}},
    {"a count", "2\n1 2 3\n4 5 6\n", {1, 2, 3, 4, 5, 6}},
    {"names of columns", "X,Y,Z,Intensity\n1,2,3,4\n", {1, 2, 3}},
    {"notations", "-1e3 +.5 0x 1\n1e-3 -.25 1E2\n", {1e-3, -.25, 100}},
    {"all digits", "637148.030 849062.47000000001 0.1\n", {637148.03, 849062.47000000001, .1}},
};

TEST(ReadXyz, TakesWhatProgramsWrite) {
  for (const Good& file : kGood) {
    SCOPED_TRACE(file.name);
    const auto model = read_xyz(as_bytes(file.text));
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->meshes.size(), 1u);
    EXPECT_EQ(find_inconsistency(model->meshes[0]), "");
    EXPECT_EQ(positions_as_double(model->meshes[0]), file.positions);
    EXPECT_EQ(model->meshes[0].face_count(), 0u);
  }
}

TEST(ReadXyz, KeepsWhatIsNotFinite) {
  const auto model = read_xyz(as_bytes("nan -inf INF\n"));
  ASSERT_TRUE(model);
  const Numbers positions = positions_as_double(model->meshes[0]);
  EXPECT_TRUE(std::isnan(positions[0]));
  EXPECT_EQ(positions[1], -HUGE_VAL);
  EXPECT_EQ(positions[2], HUGE_VAL);
}

struct Bad {
  const char* name;
  const char* text;
  ErrorCode code;
  std::uint64_t offset;
  const char* line;
};

const Bad kBad[] = {
    {"words", "what\nis this\n", ErrorCode::corrupt, 0, "line 1"},
    {"no three numbers", "# c\n1 2\n3 4\n", ErrorCode::corrupt, 4, "line 2"},
    {"two numbers among threes", "1 2 3\n4 5\n6 7 8\n", ErrorCode::corrupt, 6, "line 2"},
    {"a word among numbers", "1 2 3\n4 five 6\n", ErrorCode::corrupt, 6, "line 2"},
    {"cut", "1 2 3\n4 5", ErrorCode::truncated, 6, "line 2"},
    {"more than the limit", "1 2 3\n4 5 6\n7 8 9\n1 2 3\n", ErrorCode::over_limit, 18, "line 4"},
};

TEST(ReadXyz, SaysWhereItStops) {
  for (const Bad& file : kBad) {
    SCOPED_TRACE(file.name);
    const auto model = read_xyz(as_bytes(file.text), {.vertices = 3});
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, file.code);
    EXPECT_EQ(model.error().offset, file.offset);
    EXPECT_EQ(model.error().path, file.line);
  }
}

}  // namespace
}  // namespace pstrips
