#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "cli/number_options.h"
#include "cli/option_groups.h"
#include "cli/page_server.h"
#include "cli/report.h"
#include "converters/encode.h"
#include "converters/files.h"
#include "core/file.h"
#include "formats/pstrip/container/binary.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::uint16_t port = 0;
  std::string bandwidth;
  LimitOptions limits;
};

/// "2Mbit", "500kbit" as bytes a second; 0 for no word.
Result<double> bytes_a_second(std::string word) {
  if (word.empty()) return 0;
  constexpr std::string_view kUnit = "bit";
  if (word.ends_with(kUnit)) {
    word.resize(word.size() - kUnit.size());
    const auto bits = parse_count(word);
    if (bits && *bits >= 8) return static_cast<double>(*bits) / 8;
  }
  return fail(ErrorCode::bad_argument,
              "--bandwidth takes bits a second, at least 8, such as 500kbit or 2Mbit");
}

/// Where an installation has the page, or web/build leaves it.
Result<std::string> page_folder() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"../share/pstrips/viewer", "../../web/viewer"})
    if (std::filesystem::exists(program / place / "index.html", error))
      return (program / place).string();
  return fail(ErrorCode::unsupported, "the page is not there; web/build makes it");
}

/// A progressive file as it is, anything else encoded compactly.
Result<Bytes> bytes_to_show(const std::string& path, const Limits& limits) {
  const auto bytes = read_file(path, limits.memory_bytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const LoadOptions options{.limits = limits, .allow_prefix = true, .text_options = {}};
  const auto file = load(*bytes, path, options);
  if (!file) return tl::unexpected(file.error());
  if (file->format == FileFormat::pstrip) return Bytes(bytes->view().begin(), bytes->view().end());
  if (file->is_progressive()) return write_binary(std::get<ProgressiveStrips>(file->content));
  const auto strips = encode(std::get<Model>(file->content), {.profile = Profile::compact});
  if (!strips) return tl::unexpected(strips.error());
  return write_binary(*strips);
}

ExitCode run(const Options& options, const Streams& io) {
  const auto speed = bytes_a_second(options.bandwidth);
  if (!speed) return report(io, speed.error());
  const auto page = page_folder();
  if (!page) return report(io, page.error());
  std::vector<ServedFile> files;
  for (const std::string& input : options.inputs) {
    auto bytes = bytes_to_show(input, options.limits.limits);
    if (!bytes) return report(io, bytes.error(), input);
    const auto name = std::filesystem::path(input).filename().replace_extension(".pstrip");
    files.push_back({name.string(), std::move(*bytes)});
  }
  PageServer server(*page, std::move(files), *speed);
  const auto address = server.open(options.port);
  if (!address) return report(io, address.error());
  io.out << *address << std::endl;  // before the wait
  if (!io.quiet) io.err << "pstrips: open it in a browser; Ctrl-C ends\n";
  server.run();
  return kOk;
}

}  // namespace

Command add_view(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("view", "Show files in a browser, from a server on this machine");
  app->add_option("input", options->inputs, "Progressive files, or models, which are encoded first")
      ->required();
  app->add_option("--port", options->port, "Port of 127.0.0.1; 0: any that is free")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--bandwidth", options->bandwidth,
                  "Deliver no faster than a link of so many bits a second, such as 2Mbit")
      ->type_name("N");
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
