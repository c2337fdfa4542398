#pragma once

#include <string>

#include "cli/command.h"
#include "codecs/stripify/stripify.h"
#include "core/file.h"
#include "core/limits.h"

namespace pstrips::cli {

struct TetraJob {
  std::string input;
  std::string output;  ///< for the strips as text; empty: none
  bool json = false;
  StripOptions strip_options;
  Limits limits;
};

/// Cuts the tetrahedra of a file into strips, checks them, writes them and prints the metrics.
ExitCode stripify_tetra(const FileBytes& file, const TetraJob& job, const Streams& io);

/// The one algorithm for tetrahedra.
inline constexpr std::string_view kTetraStripifier = "tetra-multi-path";

}  // namespace pstrips::cli
