#pragma once

#include <string>
#include <vector>

#include "cli/output_option.h"
#include "converters/textures.h"

namespace pstrips::cli {

/// --textures and --allow-parent-paths
struct TextureOptions {
  std::string mode;  ///< empty: what is usual for the output
  bool allow_parent_paths = false;
  void add_to(CLI::App& app);

  /// Whether an output takes what was asked for.
  /// errors  bad_argument
  Result<void> check(FileFormat target) const;
  /// Brings a model's textures where its output needs them, and answers what save() is to do.
  Textures prepare(Scene& scene, const std::string& input, const OutputOption& output,
                   FileFormat target, const Limits& limits, std::vector<std::string>& notes) const;

 private:
  Textures for_target(FileFormat target, bool to_stdout) const;
};

}  // namespace pstrips::cli
