#include "codecs/stripify/stripify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/strip_figures.h"
#include "cli/stripifier_table.h"
#include "cli/stripify_tetra.h"
#include "codecs/stripify/delaunay.h"
#include "converters/capacity.h"

namespace pstrips::cli {
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
  std::string algorithm_or_best() const { return algorithm.empty() ? "best" : algorithm; }
  std::string output() const { return files.size() > 1 ? files[1] : std::string(); }
};

// Those of --algorithm for each kind of input.
struct Algorithm {
  const NamedStripifier* triangles = nullptr;
  const NamedPointStripifier* points = nullptr;
  bool tetrahedra = false;

  explicit Algorithm(std::string_view name)
      : triangles(find_stripifier(name)),
        points(find_point_stripifier(name)),
        tetrahedra(name == kTetraStripifier || name == "best") {}
  bool is_any() const { return triangles || points || tetrahedra; }
};

bool has_faces(const Model& model) {
  return std::ranges::any_of(model.meshes, [](const Mesh& m) { return m.face_count() > 0; });
}
bool has_points(const Model& model) {
  return std::ranges::any_of(model.meshes, [](const Mesh& m) { return m.vertex_count() > 0; });
}
bool has_too_many_points(const Model& model) {
  return std::ranges::any_of(model.meshes,
                             [](const Mesh& m) { return m.wedge_count() > kMaxDelaunayPoints; });
}

void print_text(std::ostream& out, const StripFigures& f, const std::string& algorithm,
                const Options& options) {
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
  out << escaped(options.input()) << ": " << algorithm << "\n";
  table.print(out);
}

void print_json(std::ostream& out, const StripFigures& f, const Error* error,
                const std::string& algorithm, const Options& options) {
  using Json = nlohmann::ordered_json;
  const StripStats& s = f.stats;
  Json json;
  json["schema"] = "pstrips-stripify-1";
  json["file"] = escaped(options.input());
  json["error"] = error ? json_of<Json>(*error) : Json();
  json["algorithm"] = algorithm;
  json["triangles"] = s.triangles;
  json["strips"] = s.strips;
  json["singletons"] = s.singletons;
  json["swaps"] = s.swaps;
  json["entries"] = s.entries;
  json["indices_sent"] = s.indices_sent;
  json["acmr16"] = s.acmr16;
  json["milliseconds"] = f.milliseconds;
  json["cpu_milliseconds"] = f.cpu_milliseconds;
  out << json.dump(2) << "\n";
}

Result<Model> open_model(const FileBytes& bytes, const Options& options) {
  auto file = load(bytes, options.input(),
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

ExitCode refuse_input(const Options& options, const Error& error, const Streams& io) {
  if (options.format.json()) print_json(io.out, {}, &error, options.algorithm_or_best(), options);
  return complain(io, error, options.input());
}

ExitCode stripify_model(Model model, const Options& options, const StripOptions& strip_options,
                        const Streams& io) {
  const bool points_only = has_points(model) && !has_faces(model);
  const std::string name = options.algorithm_or_best();
  const Algorithm algorithm(name);
  const bool takes_points = algorithm.points && (points_only || !algorithm.triangles);
  if (!takes_points && !algorithm.triangles)
    return refuse_input(options, {ErrorCode::unsupported, "holds no tetrahedra"}, io);
  if (takes_points && has_too_many_points(model))
    return refuse_input(options, {ErrorCode::over_limit, "more points than can be triangulated"},
                        io);
  for (const Mesh& mesh : model.meshes)
    if (const auto fits =
            check_stripping_capacity(work_size(mesh), options.limits.limits.memory_bytes);
        !fits)
      return refuse_input(options, fits.error(), io);
  const std::string output = options.output();
  const StripFigures figures =
      takes_points ? measure_point_strips(model, *algorithm.points, strip_options, !output.empty())
                   : measure_strips(model, *algorithm.triangles, strip_options, !output.empty());
  if (!figures.remark.empty())
    return complain(io, {ErrorCode::corrupt, name + " " + figures.remark});
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
    print_json(out, figures, nullptr, name, options);
  else
    print_text(out, figures, name, options);
  return kOk;
}

ExitCode run(const Options& options, const Streams& io) {
  const auto strip_options = options.stripping.get();
  if (!strip_options) return complain(io, strip_options.error());
  if (options.compare) return compare(options, *strip_options, io);
  if (!options.algorithm.empty() && !Algorithm(options.algorithm).is_any())
    return complain(
        io, {ErrorCode::bad_argument,
             "--algorithm takes one of those that --help lists, or several with --compare"});
  if (options.files.size() > 2 || options.format.csv() || options.format.md())
    return complain(io, {ErrorCode::bad_argument, "several models, csv and md are for --compare"});
  const auto file = read_file(options.input(), options.limits.limits.memory_bytes);
  if (file && holds_tetra_mesh(*file, options.input())) {
    if (!options.algorithm.empty() && !Algorithm(options.algorithm).tetrahedra)
      return complain(io, {ErrorCode::bad_argument, "tetrahedra take tetra-multi-path"},
                      options.input());
    const ExitCode code = stripify_tetra(*file,
                                         {.input = options.input(),
                                          .output = options.output(),
                                          .json = options.format.json(),
                                          .strip_options = *strip_options,
                                          .limits = options.limits.limits},
                                         io);
    options.stripping.note_time_limit(io);
    return code;
  }
  auto opened = file ? open_model(*file, options) : Result<Model>(tl::unexpected(file.error()));
  return opened ? stripify_model(std::move(*opened), options, *strip_options, io)
                : refuse_input(options, opened.error(), io);
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
                  "Model, points or progressive file, - for standard input; then a file for the "
                  "triangles in strip order (glTF holds them as strips). Or tetrahedra (MEDIT); "
                  "then a file for the strips as text")
      ->required();
  app->add_flag("--compare", options->compare,
                "A table of all algorithms, and of other libraries' that are installed; all files "
                "are inputs");
  app->add_option("--algorithm,--stripifier", options->algorithm,
                  "One of " + names +
                      "; points: best, delaunay; tetrahedra: best, which is tetra-multi-path "
                      "(default best); "
                      "with --compare any number, parted by commas")
      ->type_name("NAME");
  options->stripping.add_to(*app);
  options->target.add_to(*app);
  options->format.add_to(*app, {"text", "json", "csv", "md"});
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
