#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "validators/document.h"
#include "validators/report.h"

namespace pstrips::inline validators {

/// What has to be there, and sound, before a rule can be run.
enum class Stage : std::uint8_t {
  file,    ///< nothing: the rule is about how the file comes apart
  base,    ///< the model; the replay stands on these rules
  model,   ///< the model
  replay,  ///< every level of every mesh
};

struct Rule;

/// Where a check says that its rule does not hold.
class Findings {
 public:
  Findings(const Document& doc, const Rule& rule, Report& report)
      : doc_(doc), rule_(rule), report_(report) {}

  /// found  what stands there instead, as the end of a sentence; may be empty
  void add(const Where& where, std::string_view found = {});
  /// This rule has reported and the report keeps no more: a check over a long list may stop.
  bool full() const { return reported_ && report_.full(); }

 private:
  const Document& doc_;
  const Rule& rule_;
  Report& report_;
  bool reported_ = false;
};

/// One thing that the specification demands of a file.
struct Rule {
  std::string_view code;  ///< "PSnnnn": stable for ever, never reused
  Severity severity = Severity::error;
  std::string_view clause;  ///< identifier of the clause in spec/, without brackets
  Stage stage = Stage::file;
  std::string_view holds;  ///< what a valid file satisfies, as one sentence
  void (*check)(const Document&, Findings&) = nullptr;
  Verdict verdict = Verdict::invalid;  ///< on a file that breaks nothing worse
  std::string_view also = {};          ///< another clause that demands the same
};

/// All rules, codes ascending.
std::span<const Rule> rules();

/// The rule of that code, or null.
const Rule* find_rule(std::string_view code);

/// The page of the rule's clause, "spec/model.md".
std::string page_of(const Rule& rule);

/// The code in sentences for people: what holds, the severity, the clause and what a decoder does.
/// Empty when there is no such code.
std::string explain(std::string_view code);

/// The table as a page of the specification, spec/rules.md.
///
/// example_of  names a file that breaks the rule and no other
std::string rules_page(const std::function<std::string(const Rule&)>& example_of);

}  // namespace pstrips::inline validators
