#include "cli/stripifier_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/strip_figures.h"
#include "codecs/triangulate/triangulate.h"
#include "converters/files.h"
#include "peers/peers.h"

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
  StripFigures figures;
};

std::string effort_name(std::uint32_t effort) {
  return effort == kEffortFast   ? "fast"
         : effort == kEffortHigh ? "high"
         : effort == kEffortMax  ? "max"
                                 : fmt::format("effort {}", effort);
}

void add_runs(const NamedStripifier& algorithm, const StripOptions& given, std::vector<Run>& runs) {
  const auto add = [&](std::string variant, auto&& change) {
    runs.push_back({&algorithm, std::move(variant), given});
    change(runs.back().options);
  };
  if (algorithm.name == "best") {
    const std::uint32_t effort = given.effort == kEffortFast ? kEffortHigh : given.effort;
    add("fast", [](StripOptions& o) {
      o.goal = StripGoal::indices;
      o.effort = kEffortFast;
    });
    for (const StripGoal goal : {StripGoal::indices, StripGoal::strips})
      add(effort_name(effort) + (goal == StripGoal::strips ? ", strips" : ""),
          [&](StripOptions& o) {
            o.goal = goal;
            o.effort = effort;
          });
  } else if (algorithm.honors_goal) {
    add("indices", [](StripOptions& o) { o.goal = StripGoal::indices; });
    add("strips", [](StripOptions& o) { o.goal = StripGoal::strips; });
  } else if (algorithm.honors_weight) {
    add("topological", [](StripOptions& o) { o.weight = StripWeight::topological; });
    add("axis", [](StripOptions& o) { o.weight = StripWeight::axis; });
  } else {
    add("", [](StripOptions&) {});
  }
}

std::vector<Run> runs_of(const ComparisonOptions& options) {
  std::vector<Run> runs;
  for (const auto& list : {stripifiers(), peer_stripifiers()})
    for (const NamedStripifier& algorithm : list)
      if (options.algorithms.empty() ||
          std::ranges::find(options.algorithms, algorithm.name) != options.algorithms.end())
        add_runs(algorithm, options.strip_options, runs);
  return runs;
}

StripFigures measure_once(Model& model, const Run& run, double time_limit) {
  const auto was_cut = std::make_shared<std::atomic<bool>>(false);
  StripOptions options = run.options;
  options.stop = stop_after(time_limit, was_cut);
  StripFigures out = measure_strips(model, *run.algorithm, options, false);
  if (*was_cut && out.remark.empty()) out.remark = "cut by the time limit";
  return out;
}

// Short runs are repeated: the first one pays for cold caches.
StripFigures measure(Model& model, const Run& run, double time_limit) {
  constexpr double kEnoughMilliseconds = 200;
  constexpr int kMaxRuns = 5;
  StripFigures best = measure_once(model, run, time_limit);
  double spent = best.milliseconds;
  for (int i = 1; i < kMaxRuns && spent < kEnoughMilliseconds; ++i) {
    const StripFigures again = measure_once(model, run, time_limit);
    spent += again.milliseconds;
    best.milliseconds = std::min(best.milliseconds, again.milliseconds);
    best.cpu_milliseconds = std::min(best.cpu_milliseconds, again.cpu_milliseconds);
  }
  return best;
}

const std::vector<std::string> kColumns = {"algorithm", "variant", "strips", "singletons", "swaps",
                                           "indices",   "sent",    "sent/T", "ACMR 16",    "peak",
                                           "B/T",       "ms",      "remark"};

std::vector<std::string> cells(const Row& row) {
  const StripFigures& f = row.figures;
  const StripStats& s = f.stats;
  const double bytes_per_triangle =
      s.triangles == 0 ? 0 : static_cast<double>(f.peak_bytes) / static_cast<double>(s.triangles);
  return {row.algorithm,
          row.variant,
          grouped(s.strips),
          grouped(s.singletons),
          grouped(s.swaps),
          grouped(s.entries),
          grouped(s.indices_sent),
          fmt::format("{:.3f}", f.indices_per_triangle()),
          fmt::format("{:.3f}", s.acmr16),
          byte_size(f.peak_bytes),
          fmt::format("{:.0f}", bytes_per_triangle),
          fmt::format("{:.1f}", f.milliseconds),
          f.remark};
}

struct Comparison {
  std::string file;
  std::uint64_t triangles = 0, wedges = 0;
  std::vector<Row> rows;
};

std::string heading(const Comparison& c) {
  return fmt::format("{}: {} triangles, {} wedges", escaped(c.file), grouped(c.triangles),
                     grouped(c.wedges));
}

void print_text(std::ostream& out, const Comparison& c) {
  out << heading(c) << "\n";
  Table table(kColumns);
  for (const Row& row : c.rows) table.add(cells(row));
  table.print(out);
}

void print_markdown(std::ostream& out, const Comparison& c) {
  out << "### " << heading(c) << "\n\n";
  const auto line = [&](const std::vector<std::string>& row) {
    out << fmt::format("| {} |\n", fmt::join(row, " | "));
  };
  line(kColumns);
  out << "|---|---|" << std::string("---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
      << "---|\n";
  for (const Row& row : c.rows) line(cells(row));
  out << "\n";
}

// Every text field is ours but the name of the file.
std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : escaped(text)) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void print_csv_rows(std::ostream& out, const Comparison& c) {
  for (const Row& row : c.rows) {
    const StripFigures& f = row.figures;
    const StripStats& s = f.stats;
    out << fmt::format("{},{},{},{},{},{},{},{},{},{:.6f},{:.6f},{},{:.3f},{}\n", csv_text(c.file),
                       row.algorithm, csv_text(row.variant), s.triangles, s.strips, s.singletons,
                       s.swaps, s.entries, s.indices_sent, f.indices_per_triangle(), s.acmr16,
                       f.peak_bytes, f.milliseconds, csv_text(f.remark));
  }
}

Json json_of_comparison(const Comparison& c) {
  Json rows = Json::array();
  for (const Row& row : c.rows) {
    const StripFigures& f = row.figures;
    rows.push_back({{"algorithm", row.algorithm},
                    {"variant", row.variant},
                    {"triangles", f.stats.triangles},
                    {"strips", f.stats.strips},
                    {"singletons", f.stats.singletons},
                    {"swaps", f.stats.swaps},
                    {"entries", f.stats.entries},
                    {"indices_sent", f.stats.indices_sent},
                    {"indices_per_triangle", f.indices_per_triangle()},
                    {"acmr16", f.stats.acmr16},
                    {"peak_bytes", f.peak_bytes},
                    {"milliseconds", f.milliseconds},
                    {"cpu_milliseconds", f.cpu_milliseconds},
                    {"remark", f.remark}});
  }
  return {{"file", escaped(c.file)},
          {"triangles", c.triangles},
          {"wedges", c.wedges},
          {"algorithms", rows}};
}

}  // namespace

ExitCode compare_stripifiers(const ComparisonOptions& options, const Streams& io) {
  const std::vector<Run> runs = runs_of(options);
  for (const std::string& name : options.algorithms)
    if (std::ranges::none_of(runs, [&](const Run& run) { return run.algorithm->name == name; }))
      return complain(io, {ErrorCode::bad_argument, "--algorithm: there is no " + name});
  ProgressBar bar(io);
  const Progress progress = bar.callback();
  ExitCode worst = kOk;
  Json json{{"schema", "pstrips-stripify-compare-1"}, {"models", Json::array()}};
  if (options.format == "csv")
    io.out << "file,algorithm,variant,triangles,strips,singletons,swaps,entries,indices_sent,"
              "indices_per_triangle,acmr16,peak_bytes,milliseconds,remark\n";
  std::size_t done = 0;
  for (const std::string& path : options.models) {
    auto file = load(path, {.limits = options.limits, .allow_prefix = false, .text_options = {}});
    auto model = file ? std::move(*file).model() : tl::unexpected(file.error());
    if (!model) {
      const ExitCode code = complain(io, model.error(), path);
      if (worst == kOk) worst = code;
      done += runs.size();
      continue;
    }
    Comparison comparison{.file = path, .triangles = 0, .wedges = 0, .rows = {}};
    for (const Mesh& mesh : model->meshes) {
      comparison.triangles += triangulate(mesh).face.size();
      comparison.wedges += mesh.wedge_count();
    }
    for (const Run& run : runs) {
      const double part =
          static_cast<double>(done++) / static_cast<double>(runs.size() * options.models.size());
      if (progress && !progress(fmt::format("{} {}", escaped(path), run.algorithm->name), part))
        return complain(io, {ErrorCode::interrupted, "interrupted"});
      comparison.rows.push_back({std::string(run.algorithm->name), run.variant,
                                 measure(*model, run, options.time_limit)});
    }
    if (options.format == "csv")
      print_csv_rows(io.out, comparison);
    else if (options.format == "json")
      json["models"].push_back(json_of_comparison(comparison));
    else if (options.format == "md")
      print_markdown(io.out, comparison);
    else
      print_text(io.out, comparison);
    io.out.flush();
  }
  if (options.format == "json") io.out << json.dump(2) << "\n";
  return worst;
}

}  // namespace pstrips::cli
