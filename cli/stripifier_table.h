#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/strip_metrics.h"
#include "codecs/stripify/stripify.h"
#include "core/limits.h"

namespace pstrips::cli {

/// Every algorithm on every model: `pstrips stripify --compare`.
struct ComparisonOptions {
  std::vector<std::string> models;
  std::vector<std::string> algorithms;  ///< by name; empty: all
  StripOptions strip_options;
  double time_limit = 0;  ///< seconds for each of them on each mesh; 0: none
  std::string format;     ///< text, json, csv or md
  Limits limits;
  std::span<const NamedStripifier> peers = {};  ///< beside our own
  HeapMeter heap = {};                          ///< adds columns of memory
};

/// Prints one table a model. A model that cannot be read is reported; the exit code is that of the
/// first one.
ExitCode compare_stripifiers(const ComparisonOptions& options, const Streams& io);

}  // namespace pstrips::cli
