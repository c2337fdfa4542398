// The table of rules against the specification.

#include "validators/rules.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/paths.h"
#include "tests/validators/corpus.h"

namespace pstrips {
namespace {

std::string page(const std::string& name) {
  std::ifstream in(test::data_dir() / "../../spec" / name);
  EXPECT_TRUE(in) << name;
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Clause {
  std::string page;
  bool binds_files = false;  ///< or, under D, decoders
};

/// Clauses by identifier: "- [M-001] The numbers … MUST …". A clause goes on in indented lines.
std::map<std::string, Clause> clauses() {
  constexpr std::string_view kStart = "- [";
  constexpr std::size_t kIdBytes = 5;
  std::map<std::string, Clause> out;
  for (const char* name :
       {"model.md", "strips.md", "vsplit.md", "container.md", "xml.md", "compact.md"}) {
    std::istringstream lines(page(name));
    Clause* current = nullptr;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(kStart) && line.size() > kStart.size() + kIdBytes &&
          line[kStart.size() + kIdBytes] == ']') {
        const auto [at, is_new] = out.emplace(line.substr(kStart.size(), kIdBytes), Clause{name});
        EXPECT_TRUE(is_new) << at->first << " twice";
        current = &at->second;
      } else if (!line.starts_with("  ")) {
        current = nullptr;
      }
      if (current != nullptr && line.find("MUST") != std::string::npos) current->binds_files = true;
    }
  }
  EXPECT_GT(out.size(), 100u);
  return out;
}

std::vector<std::string> clauses_of(const Rule& rule) {
  std::istringstream words(std::string(rule.clause) + " " + std::string(rule.also));
  return {std::istream_iterator<std::string>(words), {}};
}

TEST(Rules, NameClausesOfTheSpecification) {
  const std::map<std::string, Clause> all = clauses();
  for (const Rule& rule : rules())
    for (const std::string& id : clauses_of(rule))
      EXPECT_TRUE(all.contains(id)) << rule.code << " " << id;
}

TEST(Rules, NameThePageOfTheirClause) {
  const std::map<std::string, Clause> all = clauses();
  for (const Rule& rule : rules())
    EXPECT_EQ(page_of(rule), "spec/" + all.at(std::string(rule.clause)).page) << rule.code;
}

TEST(Rules, CoverEveryClauseThatBindsFiles) {
  std::set<std::string> covered;
  for (const Rule& rule : rules())
    for (const std::string& id : clauses_of(rule)) covered.insert(id);
  for (const auto& [id, clause] : clauses())
    EXPECT_TRUE(id[0] == 'D' || !clause.binds_files || covered.contains(id))
        << id << " of " << clause.page;
}

TEST(Rules, CodesEndLikeTheirClauses) {
  for (const Rule& rule : rules()) {
    EXPECT_EQ(rule.code.size(), 6u);
    const bool of_files = rule.clause[0] != 'D';
    EXPECT_TRUE(!of_files || rule.code.substr(3) == rule.clause.substr(2)) << rule.code;
  }
}

TEST(Rules, SentencesAreSentences) {
  for (const Rule& rule : rules()) {
    EXPECT_TRUE(rule.holds.ends_with('.')) << rule.code;
    EXPECT_NE(rule.check, nullptr);
    EXPECT_EQ(find_rule(rule.code), &rule);
    EXPECT_NE(explain(rule.code).find(rule.holds), std::string::npos);
  }
  EXPECT_EQ(find_rule("PS9999"), nullptr);
  EXPECT_EQ(explain("nonsense"), "");
}

TEST(Rules, PageIsThatOfTheTable) {
  EXPECT_EQ(page("rules.md"), test::current_rules_page()) << "run validators.make_corpus";
}

}  // namespace
}  // namespace pstrips
