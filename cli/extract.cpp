#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output_option.h"
#include "cli/report.h"
#include "cli/table.h"
#include "cli/texture_options.h"
#include "converters/scene_level.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string input;
  bool cut = false;
  OutputOption output;
  LevelOptions level;
  PlacingOption placing;
  TextureOptions textures;
  LimitOptions limits;
};

Result<ProgressiveStrips> open_strips(const Options& options) {
  // A level of a file that is still arriving can be extracted as well.
  auto file = load(options.input,
                   {.limits = options.limits.limits, .allow_prefix = true, .text_options = {}});
  if (!file) return tl::unexpected(file.error());
  if (!file->is_progressive())
    return fail(ErrorCode::unsupported, "has no levels; convert it to progressive strips first");
  return std::get<ProgressiveStrips>(std::move(file->content));
}

// The error of the last whole packet is a bound for what comes after it.
void report_level(const Streams& io, const Options& options, const ProgressiveStrips& strips,
                  const SplitLevel& at) {
  if (io.quiet || options.output.is_stdout()) return;
  SceneLevel level(strips);
  for (std::size_t k = 0; k < at.packets; ++k) level.add(strips.packets[k]);
  const std::string more =
      at.more_vsplits == 0 ? "" : fmt::format(" and {} vsplits", grouped(at.more_vsplits));
  io.err << fmt::format("{}: packet {} of {}{}, {} vertices, {} triangles, error {}{}\n",
                        escaped(options.output.path), at.packets, strips.packets.size(), more,
                        grouped(level.vertices() + at.more_vsplits),
                        grouped(level.triangles() + at.more_triangles), four_digits(level.error()),
                        strips.complete ? "" : " (the file ends early)");
}

ExitCode run(const Options& options, const Streams& io) {
  const auto target = options.output.format();
  if (!target) return report(io, target.error());
  for (const auto& fits : {options.output.check({options.input}), options.placing.check(*target),
                           options.textures.check(*target)})
    if (!fits) return report(io, fits.error());
  if (options.cut && !is_progressive(*target))
    return report(io, {ErrorCode::bad_argument, "--cut writes pstrip, pstripx or pm"},
                  options.output.path);
  const auto strips = open_strips(options);
  if (!strips) return report(io, strips.error(), options.input);
  const auto choice = options.level.choice(*strips);
  if (!choice) return report(io, choice.error(), options.input);
  SplitLevel level{.packets = packets_for(*strips, *choice)};
  Result<SavedFiles> saved;
  if (is_progressive(*target)) {
    saved = save(cut(*strips, level.packets), options.output.path, *target);
  } else {
    // A number of triangles is met inside a packet, too.
    const bool splits = choice->triangles >= 0 && strips->complete;
    if (splits) level = split_level(*strips, static_cast<std::uint64_t>(choice->triangles));
    auto model = splits ? decode(*strips, level) : decode(*strips, level.packets);
    if (!model) return report(io, model.error(), options.input);
    std::vector<std::string> notes;
    const Textures textures = options.textures.prepare(model->scene, options.input, options.output,
                                                       *target, options.limits.limits, notes);
    note(io, options.output.path, notes);
    saved = save(*model, options.output.path, *target,
                 {.transforms = options.placing.transforms(),
                  .limits = options.limits.limits,
                  .textures = textures,
                  .replace_companions = options.output.force});
  }
  if (!saved) return report_unsaved(io, saved.error(), options.output);
  note(io, options.output.path, saved->converted, "converted");
  note(io, options.output.path, saved->notes);
  report_level(io, options, *strips, level);
  list_written(io, saved->files);
  return kOk;
}

}  // namespace

Command add_extract(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("extract", "Take one level out of a progressive file");
  app->add_option("input", options->input, "Progressive file; - is standard input")->required();
  options->output.add_to(*app);
  app->add_flag("--cut", options->cut, "Make a shorter progressive file instead of a mesh");
  options->level.add_to(*app);
  options->placing.add_to(*app);
  options->textures.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
