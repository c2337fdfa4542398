#include "codecs/stripify/stripify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output_option.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/strip_metrics.h"
#include "cli/strip_model.h"
#include "cli/stripifier_table.h"
#include "cli/stripify_tetra.h"
#include "cli/table.h"
#include "cli/texture_options.h"
#include "codecs/stripify/delaunay.h"
#include "converters/capacity.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::vector<std::string> inputs;  // several to compare
  std::string algorithm;            // to compare: a list; empty: best, or all
  bool compare = false;
  bool join = false, color = false;
  OutputOption output;
  StripOptionsGroup stripping;
  FormatOption format;
  LimitOptions limits;

  const std::string& input() const { return inputs[0]; }
  /// A second file that is not there yet is the output, as it is of other commands.
  void take_output() {
    if (compare || output.given() || inputs.size() != 2 || std::filesystem::exists(inputs[1]))
      return;
    output.path = inputs[1];
    inputs.pop_back();
  }
  std::string algorithm_or_best() const { return algorithm.empty() ? "best" : algorithm; }
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

void print_text(std::ostream& out, const StripMetrics& m, const std::string& algorithm,
                const Options& options) {
  const StripStats& s = m.stats;
  Table table({"", ""});
  table.add({"triangles", grouped(s.triangles)});
  table.add({"strips", grouped(s.strips)});
  table.add({"of one triangle", grouped(s.singletons)});
  table.add({"swaps", grouped(s.swaps)});
  table.add({"indices sent", grouped(s.indices_sent)});
  table.add({"a triangle", fmt::format("{:.3f}", m.indices_per_triangle())});
  table.add({"ACMR, FIFO 16", fmt::format("{:.3f}", s.acmr16)});
  table.add({"milliseconds", fmt::format("{:.1f}", m.milliseconds)});
  out << escaped(options.input()) << ": " << algorithm << "\n";
  table.print(out);
}

void print_json(std::ostream& out, const StripMetrics& m, const Error* error,
                const std::string& algorithm, const Options& options) {
  using Json = nlohmann::ordered_json;
  const StripStats& s = m.stats;
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
  json["milliseconds"] = m.milliseconds;
  json["cpu_milliseconds"] = m.cpu_milliseconds;
  out << json.dump(2) << "\n";
}

ExitCode refuse_input(const Options& options, const Error& error, const Streams& io) {
  if (options.format.json()) print_json(io.out, {}, &error, options.algorithm_or_best(), options);
  return report(io, error, options.input());
}

// What the command line alone decides, before any file is opened.
Result<void> check_command_line(const Options& options) {
  const auto refuse = [](std::string message) {
    return fail(ErrorCode::bad_argument, std::move(message));
  };
  if (options.compare)
    return options.output.given() ? Result<void>(refuse("--output does nothing with --compare"))
                                  : Result<void>();
  if (options.inputs.size() > 1)
    return refuse(
        "several models are for --compare; an output that is there already is named by -o");
  if (options.color && !options.output.given())
    return refuse("--color-strips does nothing without -o");
  if (options.join && !options.output.given()) return refuse("--join does nothing without -o");
  if (options.format.csv() || options.format.md()) return refuse("csv and md are for --compare");
  if (!options.algorithm.empty() && !Algorithm(options.algorithm).is_any())
    return refuse("--algorithm takes one of those that --help lists, or several with --compare");
  return options.output.given() ? options.output.check(options.inputs) : Result<void>();
}

// The format of the strips of a mesh, where they are written.
Result<FileFormat> mesh_format(const Options& options) {
  const auto format = options.output.format();
  if (!format) return format;
  if (is_progressive(*format))
    return fail(ErrorCode::bad_argument, "use convert for progressive formats", kNoOffset,
                options.output.path);
  if (options.join && !holds(*format, Feature::separate_strips))
    return fail(ErrorCode::bad_argument,
                fmt::format("--join does nothing for a {} file", name_of(*format)));
  return format;
}

// A primitive a strip, or a primitive a group whose strips are joined, in a format that has strips.
Result<SavedFiles> save_strips(Model model, const std::vector<StripMap>& maps, bool of_points,
                               FileFormat target, const Options& options) {
  const bool separate = holds(target, Feature::separate_strips) && !options.join;
  put_strips(model, maps, target,
             {.of_points = of_points, .a_group_each = separate, .colored = options.color});
  std::vector<std::string> notes;
  const Textures textures = TextureOptions{}.prepare(model.scene, options.input(), options.output,
                                                     target, options.limits.limits, notes);
  auto saved = save(model, options.output.path, target,
                    {.strips = !options.join,
                     .joined_strips = options.join,
                     .strip_swaps = true,
                     .threads = options.limits.limits.threads,
                     .limits = options.limits.limits,
                     .textures = textures,
                     .replace_companions = options.output.force});
  if (saved) saved->notes.insert(saved->notes.begin(), notes.begin(), notes.end());
  return saved;
}

Result<void> check_size(const Model& model, bool takes_points, const Limits& limits) {
  if (takes_points && has_too_many_points(model))
    return fail(ErrorCode::over_limit, "more points than can be triangulated");
  for (const Mesh& mesh : model.meshes)
    if (auto fits = check_stripping_capacity(work_size(mesh), limits.memory_bytes); !fits)
      return fits;
  return {};
}

ExitCode stripify_model(Model model, const Options& options, const StripOptions& strip_options,
                        const Streams& io) {
  const bool points_only = has_points(model) && !has_faces(model);
  const std::string name = options.algorithm_or_best();
  const Algorithm algorithm(name);
  const bool takes_points = algorithm.points && (points_only || !algorithm.triangles);
  if (!takes_points && !algorithm.triangles)
    return refuse_input(options, {ErrorCode::unsupported, "holds no tetrahedra"}, io);
  if (const auto fits = check_size(model, takes_points, options.limits.limits); !fits)
    return refuse_input(options, fits.error(), io);
  const OutputOption& output = options.output;
  const auto target = output.given() ? mesh_format(options) : FileFormat::ply;
  if (!target) return report(io, target.error());

  ProgressBar bar(io);
  bar.show(name, 0);
  std::vector<StripMap> maps;
  const StripMetrics metrics =
      takes_points ? measure_point_strips(model, *algorithm.points, strip_options, &maps)
                   : measure_strips(model, *algorithm.triangles, strip_options, {}, &maps);
  bar.clear();
  if (!metrics.fault.empty()) return report(io, {ErrorCode::corrupt, name + " " + metrics.fault});
  options.stripping.note_time_limit(io);
  if (output.given()) {
    const auto saved = save_strips(std::move(model), maps, takes_points, *target, options);
    if (!saved) return report_unsaved(io, saved.error(), output);
    note(io, output.path, saved->converted, "converted");
    note(io, output.path, saved->notes);
    list_written(io, saved->files);
  }
  // The metrics are the result; with the mesh on standard output they would stand in its way.
  std::ostream& out = output.is_stdout() ? io.err : io.out;
  if (options.format.json())
    print_json(out, metrics, nullptr, name, options);
  else
    print_text(out, metrics, name, options);
  return kOk;
}

ExitCode stripify_tetrahedra(const FileBytes& file, const Options& options,
                             const StripOptions& strip_options, const Streams& io) {
  if (!options.algorithm.empty() && !Algorithm(options.algorithm).tetrahedra)
    return report(io, {ErrorCode::bad_argument, "tetrahedra take tetra-multi-path"},
                  options.input());
  const ExitCode code = stripify_tetra(file,
                                       {.input = options.input(),
                                        .output = options.output.path,
                                        .json = options.format.json(),
                                        .strip_options = strip_options,
                                        .limits = options.limits.limits},
                                       io);
  options.stripping.note_time_limit(io);
  return code;
}

Result<Model> open_model(const FileBytes& bytes, const Options& options) {
  auto file = load(bytes, options.input(),
                   {.limits = options.limits.limits, .allow_prefix = false, .text_options = {}});
  if (!file) return tl::unexpected(file.error());
  return std::move(*file).model();
}

ExitCode compare(const Options& options, const StripOptions& strip_options, const Streams& io) {
  return compare_stripifiers({.models = options.inputs,
                              .algorithms = split_list(options.algorithm),
                              .strip_options = strip_options,
                              .time_limit = options.stripping.time_limit,
                              .format = options.format.format,
                              .limits = options.limits.limits},
                             io);
}

ExitCode run(const Options& options, const Streams& io) {
  const auto strip_options = options.stripping.get();
  if (!strip_options) return report(io, strip_options.error());
  if (const auto usable = check_command_line(options); !usable) return report(io, usable.error());
  if (options.compare) return compare(options, *strip_options, io);
  const auto file = read_file(options.input(), options.limits.limits.memory_bytes);
  if (file && holds_tetra_mesh(*file, options.input()))
    return stripify_tetrahedra(*file, options, *strip_options, io);
  auto opened = file ? open_model(*file, options) : Result<Model>(tl::unexpected(file.error()));
  return opened ? stripify_model(std::move(*opened), options, *strip_options, io)
                : refuse_input(options, opened.error(), io);
}

}  // namespace

Command add_stripify(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("stripify", "Cut a mesh into triangle strips and measure them");
  std::string names;
  for (const NamedStripifier& stripifier : stripifiers())
    names += (names.empty() ? "" : ", ") + std::string(stripifier.name);
  app->add_option("files", options->inputs,
                  "Model, points, tetrahedra (MEDIT) or progressive file, - for standard input; "
                  "several with --compare; a second that is not there is the output")
      ->required();
  options->output.add_named_to(*app,
                               "File for the triangles in strip order, which glTF holds as strips; "
                               "of tetrahedra, for the strips as text");
  app->add_flag("--compare", options->compare, "A table of all algorithms");
  app->add_flag(
      "--join", options->join,
      "glTF output: one primitive a group, its strips joined by repeated indices, instead "
      "of one a strip");
  app->add_flag("--color-strips,--colours", options->color,
                "Tell the strips of the output apart by colour");
  app->add_option("--algorithm,--stripifier", options->algorithm,
                  "One of " + names +
                      "; points: best, delaunay; tetrahedra: best, which is tetra-multi-path "
                      "(default best); with --compare any number, parted by commas")
      ->type_name("NAME");
  options->stripping.add_to(*app);
  options->format.add_to(*app, {"text", "json", "csv", "md"});
  options->limits.add_to(*app);
  return {app, [options](Streams io) {
            options->take_output();
            return run(*options, io);
          }};
}

}  // namespace pstrips::cli
