#pragma once

#include <functional>
#include <iosfwd>

namespace CLI {
class App;
}

namespace pstrips::cli {

/// What a shell script may rely on; listed in --help and in the README.
enum ExitCode : int {
  kOk = 0,
  kBadCommandLine = 1,
  kInputOutput = 2,
  kInvalidFile = 3,
  kRuntime = 4,
  kUnsupported = 5,
  kDifference = 7,
};

/// Findings go to `out`, chatter and errors to `err`.
struct Streams {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;  ///< err is a terminal: progress is shown
  bool color = false;     ///< terminal and no NO_COLOR
  bool quiet = false;     ///< no chatter
};

/// A subcommand: how it parses and what it runs.
struct Command {
  CLI::App* app;
  std::function<ExitCode(Streams)> run;
};

Command add_convert(CLI::App& root);
Command add_validate(CLI::App& root);
Command add_inspect(CLI::App& root);
Command add_extract(CLI::App& root);
Command add_compare(CLI::App& root);
Command add_stripify(CLI::App& root);
Command add_render(CLI::App& root);
Command add_view(CLI::App& root);

}  // namespace pstrips::cli
