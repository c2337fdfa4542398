#pragma once

#include <string>
#include <vector>

#include "core/bytes.h"

namespace pstrips::test {

/// One file of tests/data/valid or tests/data/invalid.
struct CorpusFile {
  std::string name;  ///< "PS1001_signature.pstrip": the rule that it breaks comes first
  Bytes bytes;
};

/// Small files that break nothing, of both variants.
std::vector<CorpusFile> valid_corpus();

/// For each rule at least one file that breaks it and no other. Deterministic.
std::vector<CorpusFile> invalid_corpus();

/// What the validator says of the file: the verdict, then the findings with all their members.
std::string report_text(const CorpusFile& file);

/// spec/rules.md as the rules and the corpus make it.
std::string current_rules_page();

}  // namespace pstrips::test
