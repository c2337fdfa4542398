#include "cli/conversion_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/report.h"
#include "cli/table.h"

namespace pstrips::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_list(const std::vector<std::string>& texts) {
  Json out = Json::array();
  for (const std::string& text : texts) out.push_back(escaped(text));
  return out;
}

}  // namespace

void print_lines(const Streams& io, const ConversionReport& report) {
  if (io.quiet) return;
  std::string kept;
  for (const auto& [kind, count] : report.kept)
    kept += fmt::format("{}{} ({})", kept.empty() ? "" : ", ", escaped(kind), grouped(count));
  if (!kept.empty()) io.err << "pstrips: " << escaped(report.output) << ": kept: " << kept << "\n";
  note(io, report.output, report.converted, "converted");
  note(io, report.output, report.dropped);
}

void print_json(std::ostream& out, const ConversionReport& report) {
  Json json{{"schema", "pstrips-convert-1"},
            {"input", escaped(report.input)},
            {"output", escaped(report.output)},
            {"kept", Json::array()},
            {"converted", json_list(report.converted)},
            {"dropped", json_list(report.dropped)},
            {"files", Json::array()}};
  for (const auto& [kind, count] : report.kept)
    json["kept"].push_back({{"kind", escaped(kind)}, {"count", count}});
  for (const auto& [path, bytes] : report.files)
    json["files"].push_back({{"path", escaped(path)}, {"bytes", bytes}});
  out << json.dump(2) << "\n";
}

}  // namespace pstrips::cli
