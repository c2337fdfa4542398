#include "validators/validate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "core/file.h"
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
  std::optional<Error> unreadable;

  bool valid() const { return !unreadable && report.verdict() == Verdict::valid; }
  std::string_view verdict() const { return unreadable ? "unreadable" : name_of(report.verdict()); }
};

std::string place_of(const Finding& finding) {
  std::string out;
  if (finding.offset != kNoOffset) out = fmt::format("byte {}", finding.offset);
  if (!finding.path.empty()) out += (out.empty() ? "" : ", ") + escaped(finding.path);
  return out;
}

void print_text(const Streams& io, const Judged& judged) {
  const auto paint = [&](std::string_view text, bool good) {
    return io.color ? fmt::format("\033[{}m{}\033[0m", good ? 32 : 31, text) : std::string(text);
  };
  io.out << escaped(judged.file) << ": " << paint(judged.verdict(), judged.valid());
  if (judged.unreadable) {
    io.out << "\n";
    return;
  }
  const Report& report = judged.report;
  if (report.errors() + report.warnings() > 0)
    io.out << fmt::format(", {} error{}, {} warning{}", report.errors(),
                          report.errors() == 1 ? "" : "s", report.warnings(),
                          report.warnings() == 1 ? "" : "s");
  io.out << "\n";
  for (const Finding& finding : report.findings()) {
    const std::string place = place_of(finding);
    io.out << fmt::format("  {} {} [{}] {}{}\n", finding.code, name_of(finding.severity),
                          finding.clause, escaped(finding.message),
                          place.empty() ? "" : " (at " + place + ")");
  }
  if (report.dropped() > 0) io.out << fmt::format("  and {} more\n", report.dropped());
}

void print_json(std::ostream& out, const std::vector<Judged>& all) {
  Json json;
  json["schema"] = "pstrips-validate-1";
  json["valid"] = std::ranges::all_of(all, &Judged::valid);
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
    for (const Finding& f : judged.report.findings()) {
      Json issue{{"file", file},
                 {"code", f.code},
                 {"severity", name_of(f.severity)},
                 {"clause", f.clause},
                 {"message", escaped(f.message)},
                 {"offset", nullptr},
                 {"path", escaped(f.path)}};
      if (f.offset != kNoOffset) issue["offset"] = f.offset;
      json["issues"].push_back(std::move(issue));
    }
  }
  out << json.dump(2) << "\n";
}

ExitCode explain_rule(const std::string& code, const Streams& io) {
  const std::string text = explain(code);
  if (text.empty())
    return complain(io, {ErrorCode::bad_argument, "there is no rule of that code: " + code});
  io.out << text;
  if (!text.ends_with('\n')) io.out << "\n";
  return kOk;
}

ExitCode exit_code(const Judged& judged, const Streams& io) {
  if (judged.unreadable) return complain(io, *judged.unreadable, judged.file);
  switch (judged.report.verdict()) {
    case Verdict::valid:
      return kOk;
    case Verdict::unsupported:
      return kUnsupported;
    default:
      return kInvalidFile;
  }
}

ExitCode run(const Options& options, const Streams& io) {
  if (!options.explain.empty()) return explain_rule(options.explain, io);
  if (options.inputs.empty()) return complain(io, {ErrorCode::bad_argument, "no file to validate"});
  ValidateOptions validate_options = options.validate;
  validate_options.limits = options.limits.limits;
  for (const std::string& code : validate_options.ignore)
    if (!find_rule(code))
      return complain(io, {ErrorCode::bad_argument, "there is no rule of that code: " + code});
  std::vector<Judged> all;
  for (const std::string& input : options.inputs) {
    const auto file = read_file(input, options.limits.limits.memory_bytes);
    if (file)
      all.push_back({input, validate(file->view(), validate_options), {}});
    else
      all.push_back({input, Report(), file.error()});
    if (!options.format.json()) print_text(io, all.back());
  }
  if (options.format.json()) print_json(io.out, all);
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
  app->add_option("--max-issues", options->validate.max_findings,
                  "Print at most so many issues a file")
      ->capture_default_str();
  app->add_option("--ignore", options->validate.ignore, "Codes of rules that are not asked")
      ->delimiter(',');
  app->add_flag("--warnings-as-errors", options->validate.warnings_as_errors,
                "Warnings make a file invalid");
  app->add_option("--explain", options->explain, "Explain the rule of a code, and nothing else");
  options->format.add_to(*app, {"text", "json"});
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
