#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "cli/command.h"
#include "cli/output.h"

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 ok, 1 command line, 2 input or output, 3 invalid file, 4 runtime,\n"
    "5 unsupported, 7 difference found.";

}  // namespace

int main(int argc, char** argv) {
  using namespace pstrips::cli;
  std::ios::sync_with_stdio(false);
  install_interrupt_handler();
  CLI::App app("Progressive strips: 3D models that sharpen while they arrive.", "pstrips");
  app.set_version_flag("--version", "pstrips " PSTRIPS_VERSION);
  app.footer(kExitCodes);
  app.require_subcommand(1);
  bool quiet = false;
  app.add_flag("-q,--quiet", quiet, "Print results and errors only");
  app.fallthrough();

  const Command commands[] = {add_convert(app), add_validate(app), add_inspect(app),
                              add_extract(app), add_compare(app),  add_stripify(app)};
  for (const Command& command : commands) command.app->footer(kExitCodes);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kBadCommandLine;
  }
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const Streams io{.out = std::cout,
                   .err = std::cerr,
                   .terminal = terminal,
                   .color = ::isatty(STDOUT_FILENO) == 1 && !std::getenv("NO_COLOR"),
                   .quiet = quiet};
  try {
    for (const Command& command : commands) {
      if (!command.app->parsed()) continue;
      const ExitCode code = command.run(io);
      std::cout.flush();
      if (!std::cout) {
        std::cerr << "pstrips: cannot write to standard output\n";
        return kInputOutput;
      }
      return code;
    }
  } catch (const std::bad_alloc&) {
    std::cerr << "pstrips: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "pstrips: " << escaped(error.what()) << "\n";
  }
  return kRuntime;
}
