// The main function of the test programs. `--source core/mesh_test` runs the tests of one file.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace {

/// A filter of the tests that stand in tests/<source>.cpp; empty if there are none.
std::string tests_in(std::string_view source) {
  const std::string ending = "tests/" + std::string(source) + ".cpp";
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (std::string_view(test.file()).ends_with(ending))
        filter += std::string(suite.name()) + '.' + test.name() + ':';
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc == 1) return RUN_ALL_TESTS();
  if (argc != 3 || std::string_view(argv[1]) != "--source") {
    std::fprintf(stderr, "usage: %s [--source FOLDER/NAME_test] [--gtest_…]\n", argv[0]);
    return 1;
  }
  const std::string filter = tests_in(argv[2]);
  if (filter.empty()) {
    std::fprintf(stderr, "no tests in %s\n", argv[2]);
    return 1;
  }
  testing::GTEST_FLAG(filter) = filter;
  return RUN_ALL_TESTS();
}
