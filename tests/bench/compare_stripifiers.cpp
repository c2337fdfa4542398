// What `pstrips stripify --compare` prints, and more: other libraries' stripifiers that are
// installed, and the largest heap of each. See README.md.

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "cli/option_groups.h"
#include "cli/report.h"
#include "cli/stripifier_table.h"
#include "tests/bench/heap.h"
#include "tests/bench/peers/peers.h"

int main(int argc, char** argv) {
  using namespace pstrips;
  CLI::App app("Compares stripifiers, ours and other libraries', on models.",
               "compare_stripifiers");
  std::vector<std::string> models;
  std::string algorithms;
  cli::StripOptionsGroup stripping;
  cli::FormatOption format;
  cli::LimitOptions limits;
  app.add_option("files", models, "Models")->required();
  app.add_option("--algorithm", algorithms, "Names, parted by commas; all when left out");
  stripping.add_to(app);
  format.add_to(app, {"text", "json", "csv", "md"});
  limits.add_to(app);
  CLI11_PARSE(app, argc, argv);

  const cli::Streams io{.out = std::cout, .err = std::cerr};
  const auto options = stripping.get();
  if (!options) return cli::report(io, options.error());
  return cli::compare_stripifiers(
      {.models = models,
       .algorithms = cli::split_list(algorithms),
       .strip_options = *options,
       .time_limit = stripping.time_limit,
       .format = format.format,
       .limits = limits.limits,
       .peers = bench::peer_stripifiers(),
       .heap = {.start = bench::start_heap_peak, .peak = bench::heap_peak}},
      io);
}
