#include "codecs/stripify/stripify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/strip_figures.h"
#include "cli/stripifier_table.h"

namespace pstrip::cli {
namespace {

struct Options {
  std::vector<std::string> files;  // the input and perhaps an output; to compare: inputs
  std::string algorithm;           // to compare: a list; empty: best, or all
  bool compare = false;
  StripOptionsGroup stripping;
  FormatOption format;
  TargetOption target;
  LimitOptions limits;

  const std::string& input() const { return files[0]; }
  std::string output() const { return files.size() > 1 ? files[1] : std::string(); }
  std::string algorithm_or_best() const { return algorithm.empty() ? "best" : algorithm; }
};

void print_text(std::ostream& out, const StripFigures& f, const Options& options) {
  const StripStats& s = f.stats;
  Table table({"", ""});
  table.add({"triangles", grouped(s.triangles)});
  table.add({"strips", grouped(s.strips)});
  table.add({"of one triangle", grouped(s.singletons)});
  table.add({"swaps", grouped(s.swaps)});
  table.add({"indices sent", grouped(s.indices_sent)});
  table.add({"a triangle", fmt::format("{:.3f}", f.indices_per_triangle())});
  table.add({"ACMR, FIFO 16", fmt::format("{:.3f}", s.acmr16)});
  table.add({"milliseconds", fmt::format("{:.1f}", f.milliseconds)});
  out << escaped(options.input()) << ": " << options.algorithm_or_best() << "\n";
  table.print(out);
}

void print_json(std::ostream& out, const StripFigures& f, const Error* error,
                const Options& options) {
  using Json = nlohmann::ordered_json;
  const StripStats& s = f.stats;
  Json json;
  json["schema"] = "pstrips-stripify-1";
  json["file"] = escaped(options.input());
  json["error"] = error ? json_of<Json>(*error) : Json();
  json["algorithm"] = options.algorithm_or_best();
  json["triangles"] = s.triangles;
  json["strips"] = s.strips;
  json["singletons"] = s.singletons;
  json["swaps"] = s.swaps;
  json["entries"] = s.entries;
  json["indices_sent"] = s.indices_sent;
  json["acmr16"] = s.acmr16;
  json["milliseconds"] = f.milliseconds;
  out << json.dump(2) << "\n";
}

Result<Model> open_model(const Options& options) {
  auto file = load(options.input(),
                   {.limits = options.limits.limits, .allow_prefix = false, .text_options = {}});
  if (!file) return tl::unexpected(file.error());
  return std::move(*file).model();
}

ExitCode compare(const Options& options, const StripOptions& strip_options, const Streams& io) {
  return compare_stripifiers({.models = options.files,
                              .algorithms = split_list(options.algorithm),
                              .strip_options = strip_options,
                              .time_limit = options.stripping.time_limit,
                              .format = options.format.format,
                              .limits = options.limits.limits},
                             io);
}

ExitCode run(const Options& options, const Streams& io) {
  const auto strip_options = options.stripping.get();
  if (!strip_options) return complain(io, strip_options.error());
  if (options.compare) return compare(options, *strip_options, io);
  const NamedStripifier* algorithm = find_stripifier(options.algorithm_or_best());
  if (!algorithm)
    return complain(
        io, {ErrorCode::bad_argument,
             "--algorithm takes one of those that --help lists, or several with --compare"});
  if (options.files.size() > 2 || options.format.csv() || options.format.md())
    return complain(io, {ErrorCode::bad_argument, "several models, csv and md are for --compare"});
  auto opened = open_model(options);
  if (!opened) {
    if (options.format.json()) print_json(io.out, {}, &opened.error(), options);
    return complain(io, opened.error(), options.input());
  }
  Model model = std::move(opened).value();
  const std::string output = options.output();
  const StripFigures figures = measure_strips(model, *algorithm, *strip_options, !output.empty());
  if (!figures.remark.empty())
    return complain(io, {ErrorCode::corrupt, options.algorithm_or_best() + " " + figures.remark});
  options.stripping.note_time_limit(io);
  if (!output.empty()) {
    const auto target = options.target.format_for(output);
    if (!target) return complain(io, target.error());
    if (is_progressive(*target))
      return complain(io, {ErrorCode::bad_argument, "use convert for progressive formats"}, output);
    const auto saved = save(model, output, *target, {.ascii = false, .strips = true});
    if (!saved) return complain(io, saved.error(), output);
    note(io, output, saved->notes);
  }
  // Figures are the result; with the mesh on standard output they would be in its way.
  std::ostream& out = output == "-" ? io.err : io.out;
  if (options.format.json())
    print_json(out, figures, nullptr, options);
  else
    print_text(out, figures, options);
  return kOk;
}

}  // namespace

Command add_stripify(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("stripify", "Cut a mesh into triangle strips and show the figures");
  std::string names;
  for (const NamedStripifier& stripifier : stripifiers())
    names += (names.empty() ? "" : ", ") + std::string(stripifier.name);
  app->add_option("files", options->files,
                  "Model or progressive file, - for standard input; then a file for the triangles "
                  "in strip order (glTF holds them as strips)")
      ->required();
  app->add_flag("--compare", options->compare,
                "A table of all algorithms, and of other libraries' that are installed; all files "
                "are inputs");
  app->add_option(
         "--algorithm,--stripifier", options->algorithm,
         "One of " + names + " (default best); with --compare any number, parted by commas")
      ->type_name("NAME");
  options->stripping.add_to(*app);
  options->target.add_to(*app);
  options->format.add_to(*app, {"text", "json", "csv", "md"});
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrip::cli
