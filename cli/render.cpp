#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output_option.h"
#include "cli/picture.h"
#include "cli/report.h"
#include "converters/decode.h"
#include "core/file.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string input;
  OutputOption output;
  View view;
  LevelOptions level;
  LimitOptions limits;
};

/// A level, framed as the full model would be, so that pictures of levels fit onto each other.
Result<RgbaImage> picture_of(const Options& options) {
  auto file = load(options.input,
                   {.limits = options.limits.limits, .allow_prefix = true, .text_options = {}});
  if (!file) return tl::unexpected(file.error());
  if (!file->is_progressive()) {
    if (options.level.given())
      return fail(ErrorCode::bad_argument, "has no levels; convert it to progressive strips first");
    const Model& model = std::get<Model>(file->content);
    return draw(model, model, options.view, options.limits.limits);
  }
  const ProgressiveStrips& strips = std::get<ProgressiveStrips>(file->content);
  const auto choice = options.level.choice(strips);
  if (!choice) return tl::unexpected(choice.error());
  const auto full = decode(strips);
  if (!full) return tl::unexpected(full.error());
  const std::size_t packets = packets_for(strips, *choice);
  if (packets == strips.packets.size())
    return draw(*full, *full, options.view, options.limits.limits);
  const auto level = decode(strips, packets);
  if (!level) return tl::unexpected(level.error());
  return draw(*level, *full, options.view, options.limits.limits);
}

ExitCode run(const Options& options, const Streams& io) {
  if (const auto fits = options.output.check({options.input}); !fits)
    return report(io, fits.error());
  const auto picture = picture_of(options);
  if (!picture) return report(io, picture.error(), options.input);
  const auto png = write_png(*picture);
  if (!png) return report(io, png.error(), options.output.path);
  if (const auto written = write_files({{.path = options.output.path, .bytes = *png}}); !written)
    return report(io, written.error(), options.output.path);
  list_written(io, {{options.output.path, png->size()}});
  return kOk;
}

}  // namespace

Command add_render(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("render", "Draw a model, or a level of a progressive file");
  app->add_option("input", options->input, "Model or progressive file; - is standard input")
      ->required();
  app->add_option("output", options->output.path, "PNG file to write; - is standard output")
      ->required();
  app->add_flag("--force", options->output.force, "Replace the input");
  app->add_option("--size", options->view.size, "Width and height in pixels")
      ->type_name("N")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  app->add_option("--turn", options->view.turn,
                  "Degrees around the model; 0 looks along -z, 90 along -x")
      ->type_name("X")
      ->capture_default_str();
  app->add_option("--tilt", options->view.tilt, "Degrees from above; y points up")
      ->type_name("X")
      ->check(CLI::Range(-90, 90))
      ->capture_default_str();
  options->level.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
