#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "codecs/stripify/stripify.h"
#include "core/limits.h"

namespace pstrips::cli {

/// `pstrips stripify --compare`: every algorithm on every model.
struct ComparisonOptions {
  std::vector<std::string> models;
  std::vector<std::string> algorithms;  ///< empty: all, and the peers that are there
  StripOptions strip_options;
  double time_limit = 0;  ///< seconds for each of them on each mesh; 0: none
  std::string format;     ///< text, json, csv or md
  Limits limits;
};

/// Prints one table a model. Those that cannot be read are complained about; the exit code is the
/// first one's.
ExitCode compare_stripifiers(const ComparisonOptions& options, const Streams& io);

}  // namespace pstrips::cli
