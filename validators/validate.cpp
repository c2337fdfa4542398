#include "validators/validate.h"

#include <algorithm>

#include "formats/pstrip/xml/xml.h"
#include "validators/rules.h"

namespace pstrips::inline validators {
namespace {

void run_rules(Stage stage, const Document& doc, const ValidateOptions& options, Report& report) {
  for (const Rule& rule : rules()) {
    if (rule.stage != stage || std::ranges::find(options.ignore, rule.code) != options.ignore.end())
      continue;
    Rule applied = rule;
    if (options.warnings_as_errors && rule.severity == Severity::warning)
      applied.severity = Severity::error;
    Findings findings(doc, applied, report);
    rule.check(doc, findings);
  }
}

/// Whether every rule of the stage holds, ignored ones too: later steps stand on them.
bool holds(Stage stage, const Document& doc) {
  Report report;
  run_rules(stage, doc, {}, report);
  return report.errors() == 0;
}

}  // namespace

void Findings::add(const Where& where, std::string_view found) {
  reported_ = true;
  const Severity severity = rule_.severity;
  Finding finding{rule_.code, severity, rule_.clause, std::string(rule_.holds), kNoOffset, {}};
  if (!found.empty()) finding.message.append(" Found: ").append(found).append(".");
  if (!report_.full()) {  // locating costs, and the report would drop it
    Location location = doc_.locate(doc_, where);
    finding.offset = location.offset;
    finding.path = std::move(location.path);
  }
  report_.add(std::move(finding), rule_.verdict);
}

void replay_all(Document& doc) {
  doc.replays.clear();
  for (Index m = 0; m < doc.strips.bases.size(); ++m) {
    std::vector<Index> vsplits;
    for (const Index packet : doc.packets_of[m])
      vsplits.push_back(doc.strips.packets[packet].vsplits);
    Faults faults;
    doc.replays.push_back(replay(doc.strips.meshes[m], vsplits, faults));
    for (FaultAt fault : faults.list()) {
      fault.where.mesh = m;
      doc.faults.add(fault.fault, fault.where, std::move(fault.found));
    }
  }
  doc.depth = Depth::replayed;
}

Report validate(ByteView file, const ValidateOptions& options) {
  Report report(options.max_findings);
  Document doc =
      looks_like_xml(file) ? open_xml(file, options.limits) : open_binary(file, options.limits);
  run_rules(Stage::file, doc, options, report);
  if (doc.depth < Depth::model) return report;
  run_rules(Stage::base, doc, options, report);
  run_rules(Stage::model, doc, options, report);
  if (!holds(Stage::base, doc)) return report;
  replay_all(doc);
  run_rules(Stage::replay, doc, options, report);
  return report;
}

}  // namespace pstrips::inline validators
