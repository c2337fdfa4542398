#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "core/parallel.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string input, output;
  std::string attributes;
  bool verbose = false;
  bool ascii = false, gltf_strips = false, prefix = false;
  TargetOption target;
  EncodeOptionsGroup encode;
  LevelOptions level;
  LimitOptions limits;
};

void report(const Streams& io, const Options& options, const LoadedFile& input,
            const SavedFiles& saved) {
  note(io, options.output, saved.notes);
  if (io.quiet || options.output == "-") return;
  io.err << fmt::format("{} ({}) -> {} ({})\n", escaped(options.input), byte_size(input.bytes),
                        escaped(options.output), byte_size(saved.bytes()));
}

std::string constraints_of(const ConstraintCounts& counts) {
  return fmt::format("{} by border, {} by topology, {} by flipped faces, {} by flipped texture",
                     grouped(counts.border), grouped(counts.link), grouped(counts.flip),
                     grouped(counts.texture));
}

std::string_view reason_of(SimplifyStop stop) {
  switch (stop) {
    case SimplifyStop::target:
      return "as asked";
    case SimplifyStop::max_error:
      return "the rest is above the error limit";
    case SimplifyStop::exhausted:
      return "no edge is left that may be collapsed";
    case SimplifyStop::interrupted:
      break;
  }
  return "interrupted";
}

// All of it when asked for, else only of meshes that came out larger than wanted.
void report_simplification(const Streams& io, const std::vector<SimplifyReport>& meshes,
                           bool verbose) {
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const SimplifyReport& r = meshes[m];
    if (!verbose && (io.quiet || r.stop != SimplifyStop::exhausted)) continue;
    io.err << fmt::format("mesh {} \"{}\": {} -> {} triangles, {}\n", m, escaped(r.mesh),
                          grouped(r.triangles), grouped(r.base_triangles), reason_of(r.stop));
    io.err << fmt::format("  collapses put off: {}\n", constraints_of(r.refused));
    io.err << fmt::format("  taken nevertheless: {}\n", constraints_of(r.forced));
  }
}

// What is unusual about the model.
MeshStatistics statistics_of(const Model& model) {
  MeshStatistics all;
  for (const Mesh& mesh : model.meshes) all += mesh_statistics(mesh);
  return all;
}

// Strips to strips keeps the records; anything else goes through the mesh.
bool keeps_records(const Options& options, const LoadedFile& file, FileFormat target) {
  return file.is_progressive() && is_progressive(target) && !options.level.given() &&
         options.attributes.empty();
}

ExitCode run(const Options& options, const Streams& io) {
  const auto target = options.target.format_for(options.output);
  if (!target) return complain(io, target.error());
  auto encode_options = options.encode.get();
  if (!encode_options) return complain(io, encode_options.error());
  encode_options->memory_bytes = options.limits.limits.memory_bytes;
  encode_options->threads = options.limits.limits.threads;
  // A mesh made from a text record has the record's own order.
  if (!is_progressive(*target)) encode_options->keep_order = true;
  ProgressBar bar(io);
  auto file = load(options.input, {.limits = options.limits.limits,
                                   .allow_prefix = options.prefix,
                                   .text_options = *encode_options});
  if (!file) return complain(io, file.error(), options.input);
  if (options.level.given() && !file->is_progressive())
    return complain(io, {ErrorCode::unsupported, "has no levels"}, options.input);
  note(io, options.input, file->notes);

  Result<SavedFiles> saved;
  std::vector<SimplifyReport> simplified;
  if (keeps_records(options, *file, *target)) {
    auto& strips = std::get<ProgressiveStrips>(file->content);
    if (!strips.complete) strips = cut(strips, strips.packets.size());
    saved = save(strips, options.output, *target);
  } else {
    auto decoded = std::move(*file).model(options.level.choice);
    if (!decoded) return complain(io, decoded.error(), options.input);
    Model model = std::move(decoded).value();
    if (!options.attributes.empty() && options.attributes != "all")
      keep_attributes(model, options.attributes == "none" ? std::vector<std::string>()
                                                          : split_list(options.attributes));
    if (is_progressive(*target)) {
      const bool tells = !io.quiet && options.output != "-";
      MeshStatistics met;
      Result<ProgressiveStrips> strips;
      parallel_invoke(
          encode_options->threads,
          [&] {
            if (tells) met = statistics_of(model);
          },
          [&] { strips = encode(model, *encode_options, bar.callback(), &simplified); });
      bar.clear();
      if (tells) print_mesh_statistics(io.err, met, true);
      if (!strips) return complain(io, strips.error(), options.input);
      options.encode.stripping.note_time_limit(io);
      saved = save(*strips, options.output, *target);
    } else {
      saved = save(model, options.output, *target,
                   {.ascii = options.ascii,
                    .strips = options.gltf_strips,
                    .threads = options.limits.limits.threads});
    }
  }
  if (!saved) return complain(io, saved.error(), options.output);
  report(io, options, *file, *saved);
  if (options.verbose || options.output != "-")
    report_simplification(io, simplified, options.verbose);
  return kOk;
}

}  // namespace

Command add_convert(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("convert", "Turn a model into progressive strips, or back");
  app->add_option("input", options->input, "Model or progressive file; - is standard input")
      ->required();
  app->add_option("output", options->output, "File to write; - is standard output")->required();
  options->target.add_to(*app);
  app->add_option("--attributes", options->attributes,
                  "Attributes to keep: all, none, or a list such as NORMAL,TEXCOORD_0");
  app->add_flag("-v,--verbose", options->verbose, "Say how each mesh was simplified");
  app->add_flag("--ascii", options->ascii, "PLY output as text");
  app->add_flag("--gltf-strips", options->gltf_strips, "glTF output as strips, one primitive each");
  app->add_flag("--allow-prefix", options->prefix,
                "Accept a binary progressive file that ends early, as far as it goes");
  options->encode.add_to(*app);
  options->level.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
