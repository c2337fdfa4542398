// The corpus in tests/data: each file breaks its rule and no other, each rule has a file.

#include "tests/validators/corpus.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/support/paths.h"
#include "tests/validators/finding_text.h"
#include "validators/rules.h"
#include "validators/validate.h"

namespace pstrips {
namespace {

using test::CorpusFile;

Bytes read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const ByteView bytes = as_bytes(text);
  return Bytes(bytes.begin(), bytes.end());
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename());
  return names;
}

void expect_files(const char* folder, const std::vector<CorpusFile>& files) {
  const std::filesystem::path path = test::data_dir() / folder;
  std::set<std::string> names;
  for (const CorpusFile& file : files) {
    names.insert(file.name);
    EXPECT_TRUE(read(path / file.name) == file.bytes)
        << file.name << ": run validators.make_corpus";
  }
  EXPECT_EQ(names_in(path), names);
  EXPECT_EQ(names.size(), files.size());
}

TEST(Corpus, FilesAreThoseThatTheCodeMakes) {
  expect_files("valid", test::valid_corpus());
  expect_files("invalid", test::invalid_corpus());
}

TEST(Corpus, ValidFilesBreakNothing) {
  for (const CorpusFile& file : test::valid_corpus()) {
    SCOPED_TRACE(file.name);
    const Report report = validate(file.bytes);
    EXPECT_EQ(report.verdict(), Verdict::valid);
    EXPECT_EQ(report.findings(), std::vector<Finding>{});
  }
}

TEST(Corpus, InvalidFilesBreakTheirRuleAndNoOther) {
  for (const CorpusFile& file : test::invalid_corpus()) {
    SCOPED_TRACE(file.name);
    const std::string code = file.name.substr(0, 6);
    const Rule* const rule = find_rule(code);
    ASSERT_NE(rule, nullptr);
    const Report report = validate(file.bytes);
    ASSERT_FALSE(report.findings().empty());
    for (const Finding& finding : report.findings())
      EXPECT_EQ(finding.code, code) << ::testing::PrintToString(finding);
    EXPECT_EQ(report.verdict(),
              rule->severity == Severity::warning ? Verdict::valid : rule->verdict);
  }
}

TEST(Corpus, EachRuleHasAFile) {
  const std::set<std::string> names = names_in(test::data_dir() / "invalid");
  for (const Rule& rule : rules()) {
    const auto found = names.lower_bound(std::string(rule.code));
    EXPECT_TRUE(found != names.end() && found->starts_with(rule.code)) << rule.code;
  }
}

TEST(Corpus, FilesAreSmall) {
  for (const CorpusFile& file : test::invalid_corpus()) {
    // Two files need many records or many attributes.
    const bool large = file.name.starts_with("PS0003") || file.name.starts_with("PS2006");
    EXPECT_LT(file.bytes.size(), large ? 20000u : 3500u) << file.name;
  }
}

// A finding's code, place and message are promises to whoever repairs the file.
TEST(Corpus, ReportsAreTheGoldenOnes) {
  const std::filesystem::path folder = test::data_dir() / "reports";
  std::set<std::string> names;
  for (const CorpusFile& file : test::invalid_corpus()) {
    names.insert(file.name + ".txt");
    EXPECT_EQ(as_text(read(folder / (file.name + ".txt"))), test::report_text(file))
        << file.name << ": run validators.make_corpus and review what changes";
  }
  EXPECT_EQ(names_in(folder), names);
}

}  // namespace
}  // namespace pstrips
