#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "core/result.h"

namespace pstrips::cli {

/// Text from files as a terminal may see it: control characters and broken UTF-8 become \xNN.
std::string escaped(std::string_view text);

/// Prints an error as "pstrips: FILE: message (at byte N, PATH)" and gives its exit code.
ExitCode report(const Streams& io, const Error& error, std::string_view file = {});

/// An error as the reports in JSON hold it. `Json` is nlohmann's; the template keeps its header out
/// of this one.
template <class Json>
Json json_of(const Error& error) {
  Json json{
      {"message", escaped(error.message)}, {"offset", nullptr}, {"path", escaped(error.path)}};
  if (error.offset != kNoOffset) json["offset"] = error.offset;
  return json;
}

/// Notes on standard error, unless quiet: "pstrips: FILE: left out: …".
void note(const Streams& io, std::string_view file, const std::vector<std::string>& notes,
          std::string_view outcome = "left out");

}  // namespace pstrips::cli
