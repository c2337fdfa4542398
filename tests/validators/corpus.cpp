#include "tests/validators/corpus.h"

#include <algorithm>

#include "tests/validators/edits.h"
#include "tests/validators/samples.h"
#include "validators/rules.h"
#include "validators/validate.h"

namespace pstrips::test {

std::vector<CorpusFile> valid_corpus() {
  struct Sample {
    const char* name;
    ProgressiveStrips strips;
  };
  const Sample samples[] = {{"roof", roof()},
                            {"symbols", symbols()},
                            {"faces", numbered_faces()},
                            {"seam", seam()},
                            {"scene", scene()},
                            {"growing", growing()},
                            {"compact", compact()},
                            {"batches", batches()},
                            {"small", small()},
                            {"welded", welded()},
                            {"directions", directions()},
                            {"empty", empty()},
                            {"empty_mesh", empty_mesh()}};
  std::vector<CorpusFile> out;
  for (const Sample& sample : samples) {
    out.push_back({std::string(sample.name) + ".pstrip", written(sample.strips)});
    out.push_back({std::string(sample.name) + ".pstripx", write_xml(sample.strips)});
  }
  return out;
}

std::vector<CorpusFile> invalid_corpus() {
  std::vector<CorpusFile> out;
  for (const std::span<const Case> cases : {kContainerCases, kModelCases, kXmlCases, kCompactCases})
    for (const Case& c : cases) out.push_back({c.name, c.make()});
  return out;
}

std::string report_text(const CorpusFile& file) {
  const Report report = validate(file.bytes);
  std::string out(name_of(report.verdict()));
  out.push_back('\n');
  for (const Finding& finding : report.findings()) {
    const bool located = finding.offset != kNoOffset;
    out.append("\n").append(finding.code).append(" ").append(name_of(finding.severity));
    out.append(" ").append(finding.clause).append("\n");
    out.append("byte ").append(located ? std::to_string(finding.offset) : "unknown");
    out.append(finding.path.empty() ? "" : ": ").append(finding.path).append("\n");
    out.append(finding.message).append("\n");
  }
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
