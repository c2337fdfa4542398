#include "formats/obj/names.h"

#include <gtest/gtest.h>

#include "formats/obj/obj.h"

namespace pstrips::obj {
namespace {

TEST(CompanionPath, NeverLeavesTheFolder) {
  const struct {
    std::string_view written;
    const char* path;  ///< null: refused
  } kRows[] = {
      {"a.mtl", "a.mtl"},
      {"./a.mtl", "a.mtl"},
      {"sub/a b.mtl", "sub/a b.mtl"},
      {"sub\\a.mtl", "sub/a.mtl"},
      {"a\\ b.mtl", "a b.mtl"},
      {"a//b.mtl", "a/b.mtl"},
      {"..a.mtl", "..a.mtl"},
      {"", nullptr},
      {".", nullptr},
      {"/a.mtl", nullptr},
      {"\\a.mtl", nullptr},
      {"../a.mtl", nullptr},
      {"sub/../../a.mtl", nullptr},
      {"sub\\..\\a.mtl", nullptr},
      {"C:\\a.mtl", nullptr},
      {"C:a.mtl", nullptr},
      {"file:a.mtl", nullptr},
      {std::string_view("a\0.mtl", 6), nullptr},
      {"a\nb.mtl", nullptr},
  };
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.written);
    const auto path = companion_path(row.written);
    EXPECT_EQ(path, row.path ? std::optional<std::string>(row.path) : std::nullopt);
  }
}

TEST(SplitMtllib, FindsNamesWithSpaces) {
  using Names = std::vector<std::string_view>;
  EXPECT_EQ(split_mtllib("a.mtl"), Names({"a.mtl"}));
  EXPECT_EQ(split_mtllib(" a.mtl  b.MTL "), Names({"a.mtl", "b.MTL"}));
  EXPECT_EQ(split_mtllib("box green.mtl box blue.mtl "), Names({"box green.mtl", "box blue.mtl"}));
  EXPECT_EQ(split_mtllib("x\\ y.mtl z"), Names({"x\\ y.mtl", "z"}));
  EXPECT_EQ(split_mtllib("a.mat b.mat"), Names({"a.mat b.mat"}));
  EXPECT_EQ(split_mtllib(""), Names());
}

TEST(CleanName, MakesUtf8WithoutControls) {
  EXPECT_EQ(clean_name("  a b\r"), "a b");
  EXPECT_EQ(clean_name("a\tb"), "a b");
  EXPECT_EQ(clean_name("gr\xc3\xbcn"), "gr\xc3\xbcn");
  EXPECT_EQ(clean_name("gr\xfcn"), "gr\xc3\xbcn");                    // Latin-1
  EXPECT_EQ(clean_name("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80");  // a surrogate is no UTF-8
  EXPECT_EQ(clean_name("\xc0\xaf"), "\xc3\x80\xc2\xaf");              // nor an overlong slash
  EXPECT_EQ(clean_group(" a \t b "), "a b");
}

TEST(GroupName, SurvivesAnyObjectAndGroup) {
  for (const std::string object : {"", "o", "o p", "a/b", "100%", "%2F", "/"})
    for (const std::string group : {"", "g", "g h", "a/b", "/", "%2F"}) {
      SCOPED_TRACE(object + "|" + group);
      const GroupName split = split_group_name(obj_group_name(object, group));
      EXPECT_EQ(split.object, object);
      EXPECT_EQ(split.group, group);
      EXPECT_EQ(split.instance, 1u);
      if (object.empty()) continue;
      const GroupName second = split_group_name(obj_group_name(object, group, 25));
      EXPECT_EQ(second.object, object);
      EXPECT_EQ(second.group, group);
      EXPECT_EQ(second.instance, 25u);
    }
  EXPECT_EQ(obj_group_name("", "g"), "g");
  EXPECT_EQ(obj_group_name("o", ""), "o/");
}

}  // namespace
}  // namespace pstrips::obj
