#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/attribute_names.h"
#include "cli/bits_report.h"
#include "cli/command.h"
#include "cli/conversion_report.h"
#include "cli/number_options.h"
#include "cli/option_groups.h"
#include "cli/output_option.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/table.h"
#include "cli/texture_options.h"
#include "codecs/weld/weld.h"
#include "converters/lossless_cost.h"
#include "converters/placement.h"
#include "core/parallel.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string input;
  std::string attributes;
  bool verbose = false;
  bool ascii = false, gltf_strips = false, prefix = false;
  bool strict = false;
  std::string report = "text";
  OutputOption output;
  EncodeOptionsGroup encode;
  LevelOptions level;
  PlacingOption placing;
  LimitOptions limits;
  TextureOptions textures;
};

// A file on its way from input to output; errors are of the one or of the other.
struct Conversion {
  const Options& options;
  const Streams& io;
  FileFormat target;
  EncodeOptions encode;
  ProgressBar bar{io};
  std::vector<SimplifyReport> simplified{};
  std::uint64_t below_cells = 0;  // see bytes_below_cells()
  /// Before the writer saw the model; `read` is what the reader left out, which was said.
  std::vector<std::string> converted{}, dropped{}, read{};
  std::vector<KindCount> kept{};
  Textures textures = Textures::embed;
};

std::string counts_of(const ConstraintCounts& counts) {
  return fmt::format(
      "{} by border, {} by topology,\n    {} by flipped faces, {} by flipped texture",
      grouped(counts.border), grouped(counts.link), grouped(counts.flip), grouped(counts.texture));
}

std::string_view reason_of(SimplifyStop stop) {
  switch (stop) {
    case SimplifyStop::target:
      return "as wanted";
    case SimplifyStop::max_error:
      return "the rest is above the error limit";
    case SimplifyStop::exhausted:
      return "no edge is left that may be collapsed";
    case SimplifyStop::interrupted:
      break;
  }
  return "interrupted";
}

// All of it when verbose, else only of meshes that came out larger than wanted.
void report_simplification(const Streams& io, const std::vector<SimplifyReport>& meshes,
                           bool verbose) {
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const SimplifyReport& r = meshes[m];
    if (!verbose && (io.quiet || r.stop != SimplifyStop::exhausted)) continue;
    io.err << fmt::format("mesh {} \"{}\": {} -> {} triangles, {}\n", m, escaped(r.mesh),
                          grouped(r.triangles), grouped(r.base_triangles), reason_of(r.stop));
    io.err << fmt::format("  collapses put off: {}\n", counts_of(r.refused));
    io.err << fmt::format("  taken nevertheless: {}\n", counts_of(r.forced));
  }
}

// What is unusual about the model as levels see it.
MeshStatistics statistics_of(const Model& model, std::optional<double> distance) {
  MeshStatistics all;
  for (const Mesh& mesh : model.meshes) {
    const auto welds = distance ? find_welds(mesh, *distance) : std::nullopt;
    all += mesh_statistics(welds ? weld(mesh, *welds) : mesh);
  }
  return all;
}

Result<void> does_nothing(const std::string& option, const std::string& why) {
  return fail(ErrorCode::bad_argument, option + " does nothing " + why);
}

// Options that an output of this format has no use for.
Result<void> check_target(const Options& options, FileFormat target) {
  const std::string why = fmt::format("for a {} file", name_of(target));
  if (options.ascii && !holds(target, Feature::text_and_binary))
    return does_nothing("--ascii", why);
  if (options.gltf_strips && !holds(target, Feature::separate_strips))
    return does_nothing("--gltf-strips", why);
  const std::string first = options.encode.first_given();
  if (!first.empty() && !is_progressive(target)) return does_nothing(first, why);
  return options.textures.check(target);
}

// Strips to strips of one profile keeps the records; anything else goes through the mesh.
bool keeps_records(const Options& options, const LoadedFile& file, FileFormat target) {
  if (!file.is_progressive() || !is_progressive(target)) return false;
  const auto& strips = std::get<ProgressiveStrips>(file.content);
  const bool moves = options.placing.transforms() && !holds(target, Feature::nodes);
  if (moves && !is_placed(strips.scene, strips.meshes.size()).value_or(false)) return false;
  return !options.level.given() && options.attributes.empty() &&
         !options.encode.asks_for_another(strips.profile);
}

Result<void> check_input(const Options& options, const LoadedFile& file, FileFormat target) {
  if (options.level.given() && !file.is_progressive())
    return fail(ErrorCode::unsupported, "has no levels");
  // A text record gets its strips and its order here; the others have them.
  if (!options.textures.mode.empty() && keeps_records(options, file, target))
    return does_nothing("--textures", "to progressive strips, which stay as they are");
  const std::string first = options.encode.first_given();
  if (!first.empty() && file.format != FileFormat::pm && keeps_records(options, file, target))
    return does_nothing(first,
                        "to progressive strips, which stay as they are; convert to a model "
                        "first");
  return {};
}

Result<void> keep_chosen_attributes(Model& model, const std::string& chosen) {
  if (chosen.empty() || chosen == "all") return {};
  const auto names = chosen == "none" ? std::vector<std::string>() : split_list(chosen);
  if (auto known = check_attribute_names(model, "--attributes", names); !known) return known;
  keep_attributes(model, names);
  return {};
}

Result<void> check_weights(const Model& model, const EncodeOptions& options) {
  std::vector<std::string> names;
  for (const AttributeWeight& weight : options.attribute_weights) names.push_back(weight.semantic);
  return check_attribute_names(model, "--attribute-weight", names);
}

Result<Model> model_of(Conversion& job, LoadedFile file) {
  LevelChoice choice;
  if (job.options.level.given()) {
    const auto chosen = job.options.level.choice(std::get<ProgressiveStrips>(file.content));
    if (!chosen) return tl::unexpected(chosen.error());
    choice = *chosen;
  }
  auto model = std::move(file).model(choice);
  if (!model) return model;
  if (const auto kept = keep_chosen_attributes(*model, job.options.attributes); !kept)
    return tl::unexpected(kept.error());
  if (const auto known = check_weights(*model, job.encode); !known)
    return tl::unexpected(known.error());
  return model;
}

// In a format that has levels but no nodes.
Result<Model> placed_model(Conversion& job, Model model) {
  if (!job.options.placing.transforms() || holds(job.target, Feature::nodes)) return model;
  auto placed = place_meshes(model, job.options.limits.limits, job.converted, job.dropped);
  if (!placed) return tl::unexpected(std::move(placed).error());
  return *placed ? std::move(**placed) : std::move(model);
}

// Encodes and, at the same time, looks for what is unusual about the model.
Result<ProgressiveStrips> strips_of(Conversion& job, const Model& model) {
  const bool reports = !job.io.quiet && !job.options.output.is_stdout();
  MeshStatistics met;
  Result<ProgressiveStrips> strips;
  parallel_invoke(
      job.encode.threads,
      [&] {
        if (reports) met = statistics_of(model, job.encode.weld);
      },
      [&] { strips = encode(model, job.encode, job.bar.callback(), &job.simplified); });
  job.bar.clear();
  if (reports) print_mesh_statistics(job.io.err, met, true);
  if (strips) job.options.encode.stripping.note_time_limit(job.io);
  return strips;
}

// What arrives in the target, and what it has no place for.
void note_arrivals(Conversion& job, const Model& model) {
  Arrivals found = arrivals(model, job.target);
  job.kept = std::move(found.kept);
  for (const auto& [kind, count] : found.dropped)
    job.dropped.push_back(fmt::format("{} ({})", kind, grouped(count)));
}

SaveOptions save_options(const Conversion& job) {
  SaveOptions out;
  out.strict = job.options.strict;
  out.dropped_before = job.dropped;
  return out;
}

Result<SavedFiles> save_model(const Conversion& job, const Model& model) {
  return save(model, job.options.output.path, job.target,
              {.ascii = job.options.ascii,
               .strips = job.options.gltf_strips,
               .threads = job.options.limits.limits.threads,
               .transforms = job.options.placing.transforms(),
               .limits = job.options.limits.limits,
               .strict = job.options.strict,
               .dropped_before = job.dropped,
               .textures = job.textures,
               .replace_companions = job.options.output.force});
}

Result<SavedFiles> save_records(const Conversion& job, ProgressiveStrips& strips) {
  if (!strips.complete) strips = cut(strips, strips.packets.size());
  return save(strips, job.options.output.path, job.target, save_options(job));
}

void report_conversion(const Conversion& job, const SavedFiles& saved) {
  ConversionReport out{.input = job.options.input,
                       .output = job.options.output.path,
                       .kept = job.kept,
                       .converted = job.converted,
                       .dropped = saved.notes,
                       .files = saved.files};
  out.converted.insert(out.converted.end(), saved.converted.begin(), saved.converted.end());
  print_lines(job.io, out);
  if (job.options.report != "json") return;
  out.dropped.insert(out.dropped.begin(), job.read.begin(), job.read.end());
  print_json(job.options.output.is_stdout() ? job.io.err : job.io.out, out);
}

ExitCode refuse_losses(const Conversion& job) {
  job.io.err << "pstrips: " << escaped(job.options.output.path)
             << ": not written, since something would be left out (--strict)\n";
  return kDifference;
}

ExitCode finish(const Conversion& job, std::uint64_t input_bytes, const Result<SavedFiles>& saved) {
  const Options& options = job.options;
  const Streams& io = job.io;
  if (!saved) return report_unsaved(io, saved.error(), options.output);
  const bool is_written = !saved->files.empty();
  report_conversion(job, *saved);
  if (!is_written) return refuse_losses(job);
  list_written(io, saved->files,
               fmt::format("{} ({}) ->", escaped(options.input), byte_size(input_bytes)));
  if (options.verbose || !options.output.is_stdout())
    report_simplification(io, job.simplified, options.verbose);
  if (!options.output.is_stdout())
    report_bits(io, job.encode, job.simplified, job.below_cells, saved->files.front().bytes);
  return kOk;
}

ExitCode convert(Conversion& job, LoadedFile file) {
  const Options& options = job.options;
  const std::uint64_t bytes = file.bytes;
  if (keeps_records(options, file, job.target))
    return finish(job, bytes, save_records(job, std::get<ProgressiveStrips>(file.content)));
  auto model = model_of(job, std::move(file));
  if (!model) return report(job.io, model.error(), options.input);
  job.textures = options.textures.prepare(model->scene, options.input, options.output, job.target,
                                          options.limits.limits, job.dropped);
  if (!job.io.quiet || options.strict || options.report == "json") note_arrivals(job, *model);
  if (!is_progressive(job.target)) return finish(job, bytes, save_model(job, *model));
  const auto placed = placed_model(job, std::move(*model));
  if (!placed) return report(job.io, placed.error(), options.input);
  const auto strips = strips_of(job, *placed);
  if (!strips) return report(job.io, strips.error(), options.input);
  if (job.target == FileFormat::pstrip) job.below_cells = bytes_below_cells(*strips);
  return finish(job, bytes, save(*strips, options.output.path, job.target, save_options(job)));
}

ExitCode run(const Options& options, const Streams& io) {
  const auto target = options.output.format();
  if (!target) return report(io, target.error());
  for (const auto& fits : {options.output.check({options.input}), check_target(options, *target),
                           options.placing.check(*target)})
    if (!fits) return report(io, fits.error());
  auto encode_options = options.encode.get();
  if (!encode_options) return report(io, encode_options.error());
  encode_options->memory_bytes = options.limits.limits.memory_bytes;
  encode_options->threads = options.limits.limits.threads;
  // A mesh made from a text record has the record's own order.
  if (!is_progressive(*target)) encode_options->keep_order = true;
  Conversion job{options, io, *target, *encode_options};
  job.bar.show("read", 0);
  auto file = load(options.input, {.limits = options.limits.limits,
                                   .allow_prefix = options.prefix,
                                   .allow_parent_paths = options.textures.allow_parent_paths,
                                   .text_options = *encode_options});
  job.bar.clear();
  if (!file) return report(io, file.error(), options.input);
  if (const auto fits = check_input(options, *file, *target); !fits)
    return report(io, fits.error(), options.input);
  note(io, options.input, file->notes);
  job.read = file->notes;
  if (options.strict && !job.read.empty()) {
    report_conversion(job, {});
    return refuse_losses(job);
  }
  return convert(job, std::move(*file));
}

}  // namespace

Command add_convert(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("convert", "Turn a model into progressive strips, or back");
  app->add_option("input", options->input, "Model or progressive file; - is standard input")
      ->required();
  options->output.add_to(*app);
  app->add_option("--attributes", options->attributes,
                  "Attributes to keep: all, none, or a list such as NORMAL,TEXCOORD_0")
      ->type_name("LIST");
  app->add_flag("-v,--verbose", options->verbose, "Say how each mesh was simplified");
  app->add_flag("--ascii", options->ascii, "PLY output as text");
  app->add_flag("--gltf-strips", options->gltf_strips, "glTF output as strips, one primitive each");
  app->add_flag("--allow-prefix", options->prefix,
                "Accept a binary progressive file that ends early, as far as it goes");
  app->add_flag("--strict", options->strict,
                "Write nothing, and end with code 7, when anything would be left out");
  takes_one_of(app->add_option("--report", options->report,
                               "What was kept, converted and left out: text goes to standard "
                               "error, json to standard output"),
               {"text", "json"});
  options->encode.add_to(*app);
  options->level.add_to(*app);
  options->placing.add_to(*app);
  options->textures.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
