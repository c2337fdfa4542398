#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/report.h"
#include "cli/suggest.h"
#include "core/file.h"

namespace {

using namespace pstrips::cli;

constexpr const char* kVersion = "pstrips " PSTRIPS_VERSION "\n" PSTRIPS_LIBRARIES;

extern "C" void end_cleanly(int signal) {
  pstrips::remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// What nohup has the program ignore stays ignored.
void remove_temporary_files_on_interrupt() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, end_cleanly) == SIG_IGN) std::signal(signal, SIG_IGN);
}

// " (did you mean …?)", where a word is near.
std::string hint(const std::string& near) {
  return near.empty() ? "" : "; did you mean " + near + "?";
}

// The first word, which names the command, when there is no such command.
bool reports_unknown_command(const CLI::App& app, const std::vector<std::string>& words) {
  const auto first =
      std::ranges::find_if(words, [](const std::string& word) { return !word.starts_with('-'); });
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (first == words.end() || std::ranges::find(names, *first) != names.end()) return false;
  std::cerr << "pstrips: there is no command " << escaped(*first) << hint(nearest(*first, names))
            << "\nRun with --help for more information.\n";
  return true;
}

// What an option may have been meant as that the command does not have.
std::string hint_for_options(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  const auto add_names = [&](const CLI::App& from) {
    for (const CLI::Option* option : from.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  };
  add_names(app);
  for (const CLI::App* command : app.get_subcommands()) add_names(*command);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || std::ranges::find(names, name) != names.end()) continue;
    const std::string near = nearest(name, names);
    if (!near.empty()) return "Instead of " + name + " did you mean " + near + "?\n";
  }
  return {};
}

int exit_of_parse(const CLI::App& app, const CLI::ParseError& error,
                  const std::vector<std::string>& words) {
  if (error.get_exit_code() != 0 && reports_unknown_command(app, words)) return kBadCommandLine;
  if (app.exit(error) == 0) return kOk;
  std::cerr << hint_for_options(app, words);
  return kBadCommandLine;
}

ExitCode run(const Command& command, const Streams& io) {
  try {
    const ExitCode code = command.run(io);
    std::cout.flush();
    if (std::cout) return code;
    std::cerr << "pstrips: cannot write to standard output\n";
    return kInputOutput;
  } catch (const std::bad_alloc&) {
    std::cerr << "pstrips: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "pstrips: " << escaped(error.what()) << "\n";
  }
  return kRuntime;
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  remove_temporary_files_on_interrupt();
  CLI::App app("Progressive strips: 3D models that sharpen while they arrive", "pstrips");
  set_help(app);
  app.set_version_flag("-V,--version", kVersion, "Print versions, of libraries too, and exit");
  app.require_subcommand(1);
  bool quiet = false;
  app.add_flag("-q,--quiet", quiet, "Print results and errors only; of all commands");
  app.fallthrough();

  const Command commands[] = {add_convert(app), add_validate(app), add_inspect(app),
                              add_extract(app), add_compare(app),  add_stripify(app),
                              add_render(app),  add_view(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return exit_of_parse(app, error, {argv + 1, argv + argc});
  }
  const Streams io{.out = std::cout,
                   .err = std::cerr,
                   .terminal = ::isatty(STDERR_FILENO) == 1,
                   .color = ::isatty(STDOUT_FILENO) == 1 && !std::getenv("NO_COLOR"),
                   .quiet = quiet};
  for (const Command& command : commands)
    if (command.app->parsed()) return run(command, io);
  return kRuntime;
}
