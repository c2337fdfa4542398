#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "converters/files.h"
#include "converters/losses.h"

namespace pstrips::cli {

/// What became of a conversion.
struct ConversionReport {
  std::string input, output;
  std::vector<KindCount> kept;
  std::vector<std::string> converted, dropped;
  std::vector<SavedFile> files;  ///< none when `--strict` refused to write
};

/// A line of what was kept and one for each that was converted or left out, on standard error,
/// unless quiet.
void print_lines(const Streams& io, const ConversionReport& report);

/// As spec/schemas/convert.schema.json says.
void print_json(std::ostream& out, const ConversionReport& report);

}  // namespace pstrips::cli
