#include "tests/validators/corpus.h"

#include <algorithm>

#include "tests/validators/edits.h"
#include "tests/validators/samples.h"
#include "validators/rules.h"

namespace pstrips::test {

std::vector<CorpusFile> valid_corpus() {
  struct Sample {
    const char* name;
    ProgressiveStrips strips;
  };
  const Sample samples[] = {
      {"roof", roof()},   {"symbols", symbols()}, {"faces", numbered_faces()}, {"seam", seam()},
      {"scene", scene()}, {"empty", empty()},     {"empty_mesh", empty_mesh()}};
  std::vector<CorpusFile> out;
  for (const Sample& sample : samples) {
    out.push_back({std::string(sample.name) + ".pstrip", written(sample.strips)});
    out.push_back({std::string(sample.name) + ".pstripx", write_xml(sample.strips)});
  }
  return out;
}

std::vector<CorpusFile> invalid_corpus() {
  std::vector<CorpusFile> out;
  for (const std::span<const Case> cases : {kContainerCases, kModelCases, kXmlCases})
    for (const Case& c : cases) out.push_back({c.name, c.make()});
  return out;
}

std::string current_rules_page() {
  const std::vector<CorpusFile> files = invalid_corpus();
  return rules_page([&](const Rule& rule) {
    const auto found = std::ranges::find_if(
        files, [&](const CorpusFile& file) { return file.name.starts_with(rule.code); });
    return found == files.end() ? std::string() : found->name;
  });
}

}  // namespace pstrips::test
