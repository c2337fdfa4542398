#include "codecs/stripify/stripify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "codecs/stripify/stats.h"
#include "codecs/triangulate/triangulate.h"
#include "converters/strip_mesh.h"

namespace pstrip::cli {
namespace {

struct Options {
  std::string input, output;
  std::string algorithm = "best";
  StripOptionsGroup stripping;
  FormatOption format;
  TargetOption target;
  LimitOptions limits;
};

struct Figures {
  StripStats stats;
  double cache_misses = 0;
  double milliseconds = 0;
};

// The mesh with its triangles in strip order, so that a strip-aware writer finds them again.
Mesh in_strip_order(const Mesh& mesh, const StripMap& map) {
  Mesh out = mesh;
  out.corners.clear();
  out.face_first.clear();
  out.face_group.clear();
  out.face_attributes.clear();
  std::size_t first = 0;
  for (Index g = 0; g < map.group_entries.size(); ++g) {
    for_each_triangle(
        std::span(map.entries).subspan(first, map.group_entries[g]),
        [&](Index w) { return mesh.vertex_of(w); },
        [&](Index a, Index b, Index c) {
          out.corners.insert(out.corners.end(), {a, b, c});
          out.face_group.push_back(g);
        });
    first += map.group_entries[g];
  }
  canonicalize(out);
  return out;
}

Figures stripify_model(Model& model, const NamedStripifier& algorithm,
                       const StripOptions& options) {
  Figures out;
  for (Mesh& mesh : model.meshes) {
    const Triangulation triangles = triangulate(mesh);
    const auto start = std::chrono::steady_clock::now();
    const StripMap map = strip_mesh(mesh, triangles, algorithm.run, options);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    out.milliseconds += time.count();
    const StripStats stats = strip_stats(map.entries);
    out.stats.triangles += stats.triangles;
    out.stats.strips += stats.strips;
    out.stats.singletons += stats.singletons;
    out.stats.swaps += stats.swaps;
    out.stats.entries += stats.entries;
    out.stats.indices_sent += stats.indices_sent;
    out.cache_misses += stats.acmr16 * static_cast<double>(stats.triangles);
    mesh = in_strip_order(mesh, map);
  }
  if (out.stats.triangles)
    out.stats.acmr16 = out.cache_misses / static_cast<double>(out.stats.triangles);
  return out;
}

void print_text(std::ostream& out, const Figures& f, const Options& options) {
  const StripStats& s = f.stats;
  Table table({"", ""});
  table.add({"triangles", grouped(s.triangles)});
  table.add({"strips", grouped(s.strips)});
  table.add({"of one triangle", grouped(s.singletons)});
  table.add({"swaps", grouped(s.swaps)});
  table.add({"indices sent", grouped(s.indices_sent)});
  const double per_triangle =
      s.triangles ? static_cast<double>(s.indices_sent) / static_cast<double>(s.triangles) : 0;
  table.add({"a triangle", fmt::format("{:.3f}", per_triangle)});
  table.add({"ACMR, FIFO 16", fmt::format("{:.3f}", s.acmr16)});
  table.add({"milliseconds", fmt::format("{:.1f}", f.milliseconds)});
  out << escaped(options.input) << ": " << options.algorithm << "\n";
  table.print(out);
}

void print_json(std::ostream& out, const Figures& f, const Error* error, const Options& options) {
  using Json = nlohmann::ordered_json;
  const StripStats& s = f.stats;
  Json json;
  json["schema"] = "pstrips-stripify-1";
  json["file"] = escaped(options.input);
  json["error"] = error ? json_of<Json>(*error) : Json();
  json["algorithm"] = options.algorithm;
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
  auto file = load(options.input,
                   {.limits = options.limits.limits, .allow_prefix = false, .text_options = {}});
  if (!file) return tl::unexpected(file.error());
  return std::move(*file).model();
}

ExitCode run(const Options& options, const Streams& io) {
  auto opened = open_model(options);
  if (!opened) {
    if (options.format.json()) print_json(io.out, {}, &opened.error(), options);
    return complain(io, opened.error(), options.input);
  }
  Model model = std::move(opened).value();
  const auto strip_options = options.stripping.get();
  if (!strip_options) return complain(io, strip_options.error());
  const Figures figures =
      stripify_model(model, *find_stripifier(options.algorithm), *strip_options);
  if (!options.output.empty()) {
    const auto target = options.target.format_for(options.output);
    if (!target) return complain(io, target.error());
    if (is_progressive(*target))
      return complain(io, {ErrorCode::bad_argument, "use convert for progressive formats"},
                      options.output);
    const auto saved = save(model, options.output, *target, {.ascii = false, .strips = true});
    if (!saved) return complain(io, saved.error(), options.output);
    note(io, options.output, saved->notes);
  }
  // Figures are the result; with the mesh on standard output they would be in its way.
  std::ostream& out = options.output == "-" ? io.err : io.out;
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
  std::vector<std::string> names;
  for (const NamedStripifier& s : stripifiers()) names.emplace_back(s.name);
  app->add_option("input", options->input, "Model or progressive file; - is standard input")
      ->required();
  app->add_option("output", options->output,
                  "File for the triangles in strip order; glTF holds them as strips");
  app->add_option("--algorithm,--stripifier", options->algorithm, "Stripifier")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  options->stripping.add_to(*app);
  options->target.add_to(*app);
  options->format.add_to(*app, false);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrip::cli
