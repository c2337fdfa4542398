#include "cli/stripifier_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/option_groups.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/table.h"
#include "codecs/triangulate/triangulate.h"
#include "converters/files.h"

namespace pstrips::cli {
namespace {

using Json = nlohmann::ordered_json;

// One row of the table: an algorithm and what is special about this run of it.
struct Run {
  const NamedStripifier* algorithm;
  std::string variant;
  StripOptions options;
};

struct Row {
  std::string algorithm, variant;
  StripMetrics metrics;
  bool was_cut = false;  // by the time limit

  std::string note() const {
    return !metrics.fault.empty() ? metrics.fault : was_cut ? "cut by the time limit" : "";
  }
  double bytes_per_triangle() const {
    const std::uint64_t triangles = metrics.stats.triangles;
    return triangles == 0
               ? 0
               : static_cast<double>(metrics.peak_bytes) / static_cast<double>(triangles);
  }
};

struct Comparison {
  std::string file;
  std::uint64_t triangles = 0, wedges = 0;
  std::vector<Row> rows;
  bool has_memory = false;
};

std::string effort_name(std::uint32_t effort) {
  return effort == kEffortFast   ? "fast"
         : effort == kEffortHigh ? "high"
         : effort == kEffortMax  ? "max"
                                 : fmt::format("effort {}", effort);
}

// The quick run, and both goals with more effort.
void add_runs_of_best(const NamedStripifier& best, const StripOptions& given,
                      std::vector<Run>& runs) {
  StripOptions options = given;
  options.goal = StripGoal::indices;
  options.effort = kEffortFast;
  runs.push_back({&best, "fast", options});
  options.effort = given.effort == kEffortFast ? kEffortHigh : given.effort;
  runs.push_back({&best, effort_name(options.effort), options});
  options.goal = StripGoal::strips;
  runs.push_back({&best, effort_name(options.effort) + ", strips", options});
}

void add_runs(const NamedStripifier& algorithm, const StripOptions& given, std::vector<Run>& runs) {
  if (algorithm.name == "best") return add_runs_of_best(algorithm, given, runs);
  const auto add = [&](const char* variant, auto StripOptions::*option, auto value) {
    runs.push_back({&algorithm, variant, given});
    runs.back().options.*option = value;
  };
  if (algorithm.honors_goal) {
    add("indices", &StripOptions::goal, StripGoal::indices);
    add("strips", &StripOptions::goal, StripGoal::strips);
  } else if (algorithm.honors_weight) {
    add("topological", &StripOptions::weight, StripWeight::topological);
    add("axis", &StripOptions::weight, StripWeight::axis);
  } else {
    runs.push_back({&algorithm, "", given});
  }
}

std::vector<Run> runs_of(const ComparisonOptions& options) {
  std::vector<Run> runs;
  for (const auto& list : {stripifiers(), options.peers})
    for (const NamedStripifier& algorithm : list)
      if (options.algorithms.empty() ||
          std::ranges::find(options.algorithms, algorithm.name) != options.algorithms.end())
        add_runs(algorithm, options.strip_options, runs);
  return runs;
}

Row measure_once(const Model& model, const Run& run, const ComparisonOptions& options) {
  const auto was_cut = std::make_shared<std::atomic<bool>>(false);
  StripOptions strip_options = run.options;
  strip_options.stop = stop_after(options.time_limit, was_cut);
  Row out{.algorithm = std::string(run.algorithm->name), .variant = run.variant, .metrics = {}};
  out.metrics = measure_strips(model, *run.algorithm, strip_options, options.heap);
  out.was_cut = *was_cut;
  return out;
}

// Short runs are repeated: the first one pays for cold caches.
Row measure(const Model& model, const Run& run, const ComparisonOptions& options) {
  constexpr double kEnoughMilliseconds = 200;
  constexpr int kMaxRuns = 5;
  Row best = measure_once(model, run, options);
  double spent = best.metrics.milliseconds;
  for (int i = 1; i < kMaxRuns && spent < kEnoughMilliseconds; ++i) {
    const StripMetrics again = measure_once(model, run, options).metrics;
    spent += again.milliseconds;
    best.metrics.milliseconds = std::min(best.metrics.milliseconds, again.milliseconds);
    best.metrics.cpu_milliseconds = std::min(best.metrics.cpu_milliseconds, again.cpu_milliseconds);
  }
  return best;
}

std::string heading(const Comparison& c) {
  return fmt::format("{}: {} triangles, {} wedges", escaped(c.file), grouped(c.triangles),
                     grouped(c.wedges));
}

std::vector<std::string> text_cells(const Row& row, std::string name, bool has_memory) {
  const StripStats& s = row.metrics.stats;
  std::vector<std::string> cells{std::move(name),
                                 grouped(s.strips),
                                 grouped(s.singletons),
                                 grouped(s.swaps),
                                 fmt::format("{:.3f}", row.metrics.indices_per_triangle()),
                                 fmt::format("{:.3f}", s.acmr16),
                                 fmt::format("{:.1f}", row.metrics.milliseconds)};
  if (has_memory) cells.push_back(byte_size(row.metrics.peak_bytes));
  return cells;
}

// Narrow enough for a terminal: variants stand below their algorithm, notes below the table.
void print_text(std::ostream& out, const Comparison& c) {
  out << heading(c) << "\n";
  std::vector<std::string> header{"stripifier", "strips", "single", "swaps",
                                  "sent/T",     "ACMR",   "ms"};
  if (c.has_memory) header.emplace_back("peak");
  Table table(header);
  std::string above;
  for (const Row& row : c.rows) {
    const bool has_variant = !row.variant.empty();
    if (has_variant && row.algorithm != above) table.add({row.algorithm});
    above = row.algorithm;
    table.add(text_cells(row, has_variant ? "  " + row.variant : row.algorithm, c.has_memory));
  }
  table.print(out);
  for (const Row& row : c.rows)
    if (!row.note().empty())
      out << fmt::format("{}{}{}: {}\n", row.algorithm, row.variant.empty() ? "" : ", ",
                         row.variant, row.note());
}

std::vector<std::string> markdown_cells(const Row& row, bool has_memory) {
  const StripMetrics& m = row.metrics;
  const StripStats& s = m.stats;
  std::vector<std::string> cells{row.algorithm,
                                 row.variant,
                                 grouped(s.strips),
                                 grouped(s.singletons),
                                 grouped(s.swaps),
                                 grouped(s.entries),
                                 grouped(s.indices_sent),
                                 fmt::format("{:.3f}", m.indices_per_triangle()),
                                 fmt::format("{:.3f}", s.acmr16),
                                 fmt::format("{:.1f}", m.milliseconds)};
  if (has_memory) {
    cells.push_back(byte_size(m.peak_bytes));
    cells.push_back(fmt::format("{:.0f}", row.bytes_per_triangle()));
  }
  cells.push_back(row.note());
  return cells;
}

void print_markdown(std::ostream& out, const Comparison& c) {
  const auto line = [&](const std::vector<std::string>& row) {
    out << fmt::format("| {} |\n", fmt::join(row, " | "));
  };
  std::vector<std::string> header{"algorithm", "variant", "strips", "singletons", "swaps",
                                  "indices",   "sent",    "sent/T", "ACMR 16",    "ms"};
  if (c.has_memory) header.insert(header.end(), {"peak", "B/T"});
  const std::size_t numbers = header.size() - 2;
  header.emplace_back("remark");
  out << "### " << heading(c) << "\n\n";
  line(header);
  out << "|---|---|";
  for (std::size_t i = 0; i < numbers; ++i) out << "---:|";
  out << "---|\n";
  for (const Row& row : c.rows) line(markdown_cells(row, c.has_memory));
  out << "\n";
}

void print_csv_header(std::ostream& out, bool has_memory) {
  out << "file,algorithm,variant,triangles,strips,singletons,swaps,entries,indices_sent,"
         "indices_per_triangle,acmr16,"
      << (has_memory ? "peak_bytes," : "") << "milliseconds,remark\n";
}

void print_csv_rows(std::ostream& out, const Comparison& c) {
  for (const Row& row : c.rows) {
    const StripMetrics& m = row.metrics;
    const StripStats& s = m.stats;
    out << fmt::format("{},{},{},{},{},{},{},{},{},{:.6f},{:.6f},{}{:.3f},{}\n", csv_text(c.file),
                       row.algorithm, csv_text(row.variant), s.triangles, s.strips, s.singletons,
                       s.swaps, s.entries, s.indices_sent, m.indices_per_triangle(), s.acmr16,
                       c.has_memory ? fmt::format("{},", m.peak_bytes) : "", m.milliseconds,
                       csv_text(row.note()));
  }
}

Json json_of_row(const Row& row, bool has_memory) {
  const StripMetrics& m = row.metrics;
  Json json{{"algorithm", row.algorithm},
            {"variant", row.variant},
            {"triangles", m.stats.triangles},
            {"strips", m.stats.strips},
            {"singletons", m.stats.singletons},
            {"swaps", m.stats.swaps},
            {"entries", m.stats.entries},
            {"indices_sent", m.stats.indices_sent},
            {"indices_per_triangle", m.indices_per_triangle()},
            {"acmr16", m.stats.acmr16}};
  if (has_memory) json["peak_bytes"] = m.peak_bytes;
  json["milliseconds"] = m.milliseconds;
  json["cpu_milliseconds"] = m.cpu_milliseconds;
  json["remark"] = row.note();
  return json;
}

Json json_of_comparison(const Comparison& c) {
  Json rows = Json::array();
  for (const Row& row : c.rows) rows.push_back(json_of_row(row, c.has_memory));
  return {{"file", escaped(c.file)},
          {"triangles", c.triangles},
          {"wedges", c.wedges},
          {"algorithms", rows}};
}

// Prints what is found as soon as a model is done; JSON in one piece at the end.
class Printer {
 public:
  Printer(const ComparisonOptions& options, std::ostream& out)
      : format_(options.format), out_(out) {
    if (format_ == "csv") print_csv_header(out_, static_cast<bool>(options.heap));
  }
  void print(const Comparison& comparison) {
    if (format_ == "csv")
      print_csv_rows(out_, comparison);
    else if (format_ == "json")
      json_["models"].push_back(json_of_comparison(comparison));
    else if (format_ == "md")
      print_markdown(out_, comparison);
    else
      print_text(out_, comparison);
    out_.flush();
  }
  void finish() {
    if (format_ == "json") out_ << json_.dump(2) << "\n";
  }

 private:
  std::string format_;
  std::ostream& out_;
  Json json_{{"schema", "pstrips-stripify-compare-1"}, {"models", Json::array()}};
};

Comparison start_comparison(const std::string& path, const Model& model, bool has_memory) {
  Comparison out{.file = path, .rows = {}, .has_memory = has_memory};
  for (const Mesh& mesh : model.meshes) {
    out.triangles += triangulate(mesh).face.size();
    out.wedges += mesh.wedge_count();
  }
  return out;
}

Result<Model> open_model(const std::string& path, const Limits& limits) {
  auto file = load(path, {.limits = limits, .allow_prefix = false, .text_options = {}});
  if (!file) return tl::unexpected(file.error());
  return std::move(*file).model();
}

}  // namespace

ExitCode compare_stripifiers(const ComparisonOptions& options, const Streams& io) {
  const std::vector<Run> runs = runs_of(options);
  for (const std::string& name : options.algorithms)
    if (std::ranges::none_of(runs, [&](const Run& run) { return run.algorithm->name == name; }))
      return report(io, {ErrorCode::bad_argument, "--algorithm: there is no " + name});
  Printer printer(options, io.out);
  ProgressBar bar(io);
  const auto all = static_cast<double>(runs.size() * options.models.size());
  std::size_t done = 0;
  ExitCode worst = kOk;
  for (const std::string& path : options.models) {
    auto model = open_model(path, options.limits);
    if (!model) {
      bar.clear();
      const ExitCode code = report(io, model.error(), path);
      if (worst == kOk) worst = code;
      done += runs.size();
      continue;
    }
    Comparison comparison = start_comparison(path, *model, static_cast<bool>(options.heap));
    for (const Run& run : runs) {
      bar.show(fmt::format("{} {}", run.algorithm->name, run.variant),
               static_cast<double>(done++) / all);
      comparison.rows.push_back(measure(*model, run, options));
    }
    bar.clear();
    printer.print(comparison);
  }
  printer.finish();
  return worst;
}

}  // namespace pstrips::cli
