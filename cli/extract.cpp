#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "converters/scene_level.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string input, output;
  bool cut = false;
  TargetOption target;
  LevelOptions level;
  LimitOptions limits;
};

ExitCode run(const Options& options, const Streams& io) {
  const auto target = options.target.format_for(options.output);
  if (!target) return complain(io, target.error());
  if (options.cut && !is_progressive(*target))
    return complain(io, {ErrorCode::bad_argument, "--cut writes pstrip, pstripx or pm"},
                    options.output);
  // A level of a file that is still arriving can be extracted as well.
  auto file = load(options.input,
                   {.limits = options.limits.limits, .allow_prefix = true, .text_options = {}});
  if (!file) return complain(io, file.error(), options.input);
  if (!file->is_progressive())
    return complain(
        io, {ErrorCode::unsupported, "has no levels; convert it to progressive strips first"},
        options.input);
  const ProgressiveStrips& strips = std::get<ProgressiveStrips>(file->content);
  const std::size_t packets = packets_for(strips, options.level.choice);
  Result<SavedFiles> saved;
  if (is_progressive(*target)) {
    saved = save(cut(strips, packets), options.output, *target);
  } else {
    const auto model = decode(strips, packets);
    if (!model) return complain(io, model.error(), options.input);
    saved = save(*model, options.output, *target);
  }
  if (!saved) return complain(io, saved.error(), options.output);
  note(io, options.output, saved->notes);
  if (!io.quiet && options.output != "-") {
    SceneLevel level(strips);
    for (std::size_t k = 0; k < packets; ++k) level.add(strips.packets[k]);
    io.err << fmt::format("{}: packet {} of {}, {} vertices, {} triangles, error {}{}\n",
                          escaped(options.output), packets, strips.packets.size(),
                          grouped(level.vertices()), grouped(level.triangles()),
                          figure(level.error()), strips.complete ? "" : " (the file ends early)");
  }
  return kOk;
}

}  // namespace

Command add_extract(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("extract", "Take one level out of a progressive file");
  app->add_option("input", options->input, "Progressive file; - is standard input")->required();
  app->add_option("output", options->output, "File to write; - is standard output")->required();
  options->target.add_to(*app);
  app->add_flag("--cut", options->cut, "Make a shorter progressive file instead of a mesh");
  options->level.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
