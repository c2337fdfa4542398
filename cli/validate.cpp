#include "validators/validate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/number_options.h"
#include "cli/option_groups.h"
#include "cli/report.h"
#include "converters/files.h"
#include "core/file.h"
#include "formats/pstrip/xml/xml.h"
#include "validators/rules.h"

namespace pstrips::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::vector<std::string> inputs;
  std::string explain;
  ValidateOptions validate;
  FormatOption format;
  LimitOptions limits;
};

// A file's report, or why there is none.
struct Judged {
  std::string file;
  Report report;
  std::optional<Error> refusal;
  bool is_covered = true;  // by the specification that the validator checks

  bool valid() const { return !refusal && report.verdict() == Verdict::valid; }
  std::string_view verdict() const {
    if (!is_covered) return "not covered";
    return refusal ? "unreadable" : name_of(report.verdict());
  }
};

std::string place_of(const Finding& finding) {
  std::string out;
  if (finding.offset != kNoOffset) out = fmt::format("byte {}", finding.offset);
  if (!finding.path.empty()) out += (out.empty() ? "" : ", ") + escaped(finding.path);
  return out;
}

std::string counts_of(const Report& report) {
  if (report.errors() + report.warnings() == 0) return {};
  return fmt::format(", {} error{}, {} warning{}", report.errors(), report.errors() == 1 ? "" : "s",
                     report.warnings(), report.warnings() == 1 ? "" : "s");
}

void print_text(const Streams& io, const Judged& judged, const std::vector<std::string>& ignored) {
  const auto paint = [&](std::string_view text, bool good) {
    return io.color ? fmt::format("\033[{}m{}\033[0m", good ? 32 : 31, text) : std::string(text);
  };
  io.out << escaped(judged.file) << ": " << paint(judged.verdict(), judged.valid());
  if (judged.refusal) {
    io.out << "\n";
    return;
  }
  const Report& report = judged.report;
  io.out << counts_of(report);
  if (!ignored.empty()) io.out << fmt::format(" ({} ignored)", fmt::join(ignored, ", "));
  io.out << "\n";
  for (const Finding& finding : report.findings()) {
    const std::string place = place_of(finding);
    io.out << fmt::format("  {} {} [{}] {}{}\n", finding.code, name_of(finding.severity),
                          finding.clause, escaped(finding.message),
                          place.empty() ? "" : " (at " + place + ")");
  }
  if (report.dropped() > 0) io.out << fmt::format("  and {} more\n", report.dropped());
}

Json json_of_finding(const std::string& file, const Finding& f) {
  Json issue{{"file", file},
             {"code", f.code},
             {"severity", name_of(f.severity)},
             {"clause", f.clause},
             {"message", escaped(f.message)},
             {"offset", nullptr},
             {"path", escaped(f.path)}};
  if (f.offset != kNoOffset) issue["offset"] = f.offset;
  return issue;
}

void print_json(std::ostream& out, const std::vector<Judged>& all,
                const std::vector<std::string>& ignored) {
  Json json;
  json["schema"] = "pstrips-validate-1";
  json["valid"] = std::ranges::all_of(all, &Judged::valid);
  json["ignored"] = ignored;
  json["files"] = Json::array();
  json["issues"] = Json::array();
  for (const Judged& judged : all) {
    const std::string file = escaped(judged.file);
    json["files"].push_back({{"file", file},
                             {"valid", judged.valid()},
                             {"verdict", judged.verdict()},
                             {"errors", judged.report.errors()},
                             {"warnings", judged.report.warnings()},
                             {"dropped", judged.report.dropped()}});
    for (const Finding& finding : judged.report.findings())
      json["issues"].push_back(json_of_finding(file, finding));
  }
  out << json.dump(2) << "\n";
}

ExitCode explain_rule(const std::string& code, const Streams& io) {
  const std::string text = explain(code);
  if (text.empty())
    return report(io, {ErrorCode::bad_argument, "there is no rule of that code: " + code});
  io.out << text;
  if (!text.ends_with('\n')) io.out << "\n";
  return kOk;
}

ExitCode exit_code(const Judged& judged, const Streams& io) {
  if (judged.refusal) return report(io, *judged.refusal, judged.file);
  switch (judged.report.verdict()) {
    case Verdict::valid:
      return kOk;
    case Verdict::unsupported:
      return kUnsupported;
    default:
      return kInvalidFile;
  }
}

std::string covered_formats() {
  std::vector<std::string_view> names;
  for (const FileFormatRow& row : file_formats())
    if (row.is_validated) names.push_back(row.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

// A format that has no rules: known by what the file holds or, failing that, by its name.
std::optional<FileFormat> uncovered_format(ByteView bytes, const std::string& path) {
  const auto format = detect_format(bytes, path);
  if (!format || row_of(*format).is_validated) return {};
  return looks_like_xml(bytes) ? std::nullopt : format;
}

Judged judge(const std::string& path, const ValidateOptions& options) {
  const auto file = read_file(path, options.limits.memory_bytes);
  Judged out{.file = path, .report = Report(), .refusal = {}};
  if (!file) {
    out.refusal = file.error();
  } else if (const auto other = uncovered_format(file->view(), path)) {
    out.is_covered = false;
    out.refusal = Error{ErrorCode::unsupported, fmt::format("the validator covers {}, not {}",
                                                            covered_formats(), name_of(*other))};
  } else {
    out.report = validate(file->view(), options);
  }
  return out;
}

ExitCode run(const Options& options, const Streams& io) {
  if (!options.explain.empty()) return explain_rule(options.explain, io);
  if (options.inputs.empty()) return report(io, {ErrorCode::bad_argument, "no file to validate"});
  ValidateOptions validate_options = options.validate;
  validate_options.limits = options.limits.limits;
  for (const std::string& code : validate_options.ignore)
    if (!find_rule(code))
      return report(io, {ErrorCode::bad_argument, "there is no rule of that code: " + code});
  std::vector<Judged> all;
  for (const std::string& input : options.inputs) {
    all.push_back(judge(input, validate_options));
    if (!options.format.json()) print_text(io, all.back(), validate_options.ignore);
  }
  if (options.format.json()) print_json(io.out, all, validate_options.ignore);
  ExitCode worst = kOk;  // the first file that is not valid decides
  for (const Judged& judged : all) {
    const ExitCode code = exit_code(judged, io);
    if (worst == kOk) worst = code;
  }
  return worst;
}

}  // namespace

Command add_validate(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("validate", "Check progressive files against the specification");
  app->add_option("files", options->inputs, "Progressive files; - is standard input");
  takes_count(app->add_option("--max-issues", options->validate.max_findings,
                              "Print at most so many issues a file")
                  ->capture_default_str());
  app->add_option("--ignore", options->validate.ignore,
                  "Codes of rules to leave out; may be repeated")

      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("CODE,...");
  app->add_flag("--warnings-as-errors", options->validate.warnings_as_errors,
                "Warnings make a file invalid");
  app->add_option("--explain", options->explain, "Explain the rule of a code, and nothing else")
      ->type_name("CODE");
  options->format.add_to(*app, {"text", "json"});
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
