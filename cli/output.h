#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "codecs/measure/mesh_statistics.h"
#include "core/progress.h"
#include "core/result.h"

namespace pstrips::cli {

/// Text from files as a terminal may see it: control characters and broken UTF-8 become \xNN.
std::string escaped(std::string_view text);

/// Prints an error as "pstrips: FILE: message (at byte N, PATH)" and gives its exit code.
ExitCode complain(const Streams& io, const Error& error, std::string_view file = {});

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
void note(const Streams& io, std::string_view file, const std::vector<std::string>& notes);

/// A table whose columns line up: numbers to the right, text to the left.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// What a mesh has of what simple programs stumble over, a line a kind that occurs (components when
/// there are several): count, name and, if asked for, what became of it.
void print_mesh_statistics(std::ostream& out, const MeshStatistics& statistics,
                           bool with_treatment);

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t value);
/// Four significant digits, plain or scientific.
std::string figure(double value);
/// "12.3 kB", decimal units.
std::string byte_size(std::uint64_t bytes);

/// A progress bar on a terminal, nothing elsewhere; stops the work after an interrupt (Ctrl-C).
/// The bar is cleared when the object ends, or before that to make room for other text.
class ProgressBar {
 public:
  explicit ProgressBar(const Streams& io) : io_(io) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  Progress callback();
  void clear();

 private:
  const Streams& io_;
  bool shown_ = false;
};

/// Makes Ctrl-C and SIGTERM remove temporary files before they end the program.
void install_interrupt_handler();

}  // namespace pstrips::cli
