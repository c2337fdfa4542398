#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "converters/files.h"

namespace CLI {
class App;
}

namespace pstrips::cli {

/// The file that a command writes: OUT or -o, --to and --force. Every command keeps one rule: a
/// file that the user did not name, or that it reads, is not replaced without --force.
struct OutputOption {
  std::string path;
  std::string to;
  bool force = false;

  /// OUT, a positional argument that -o may take the place of.
  void add_to(CLI::App& app);
  /// -o only, where every positional argument is an input.
  void add_named_to(CLI::App& app, const char* description);

  bool given() const { return !path.empty(); }
  bool is_stdout() const { return path == "-"; }
  /// errors  bad_argument when neither the option nor the path names a format
  Result<FileFormat> format() const;
  /// Whether the output can be written and may be, found before any work: there is a folder that
  /// takes files, and the output is none of the inputs.
  ///
  /// errors  io; bad_argument for an input
  Result<void> check(const std::vector<std::string>& inputs) const;

 private:
  void add_rest_to(CLI::App& app);
};

/// Prints why nothing was written and, where a companion stood in the way, what replaces it.
ExitCode report_unsaved(const Streams& io, const Error& error, const OutputOption& output);

/// The rule above, as --help says it.
extern const std::string_view kOverwriteRule;

/// "wrote out.gltf (2 kB), out.bin (3 kB)" on standard error. Nothing when quiet or when the output
/// is standard output.
void list_written(const Streams& io, const std::vector<SavedFile>& files,
                  std::string before = "wrote");

}  // namespace pstrips::cli
