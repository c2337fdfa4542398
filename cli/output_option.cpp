#include "cli/output_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>

#include "cli/number_options.h"
#include "cli/report.h"
#include "cli/table.h"

namespace pstrips::cli {
namespace {

constexpr std::size_t kColumns = 80;

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return std::filesystem::equivalent(a, b, none);
}

std::vector<std::string> writable_names() {
  std::vector<std::string> names;
  for (const FileFormatRow& row : file_formats())
    if (row.is_writable()) names.emplace_back(row.name);
  return names;
}

}  // namespace

const std::string_view kOverwriteRule =
    "A file that you did not name, or that is an input, is never replaced without --force.";

void OutputOption::add_to(CLI::App& app) {
  app.add_option("output,-o,--output", path, "File to write; - is standard output")->required();
  add_rest_to(app);
}

void OutputOption::add_named_to(CLI::App& app, const char* description) {
  app.add_option("-o,--output", path, description);
  add_rest_to(app);
}

void OutputOption::add_rest_to(CLI::App& app) {
  takes_one_of(app.add_option("--to", to, "Format of the output, where its name does not say it"),
               writable_names());
  app.add_flag("--force", force, "Replace files that you did not name, and the input");
}

Result<FileFormat> OutputOption::format() const {
  if (!to.empty()) return *format_named(to);
  if (const auto format = format_of_path(path)) return *format;
  return fail(ErrorCode::bad_argument,
              "the name has no known extension; --to names the format: " + writable_formats(),
              kNoOffset, path);
}

Result<void> OutputOption::check(const std::vector<std::string>& inputs) const {
  if (is_stdout()) return {};
  if (const auto writable = check_writable(path); !writable || force) return writable;
  for (const std::string& input : inputs)
    if (is_same_file(input, path))
      return fail(ErrorCode::bad_argument, "is the input, too; --force replaces it", kNoOffset,
                  path);
  return {};
}

ExitCode report_unsaved(const Streams& io, const Error& error, const OutputOption& output) {
  const ExitCode code = report(io, error, output.path);
  const bool is_companion = error.code == ErrorCode::io && error.path != output.path;
  if (is_companion && !output.force && std::filesystem::is_regular_file(error.path))
    io.err << "--force replaces it.\n";
  return code;
}

void list_written(const Streams& io, const std::vector<SavedFile>& files, std::string before) {
  if (io.quiet || files.empty() || files.front().path == "-") return;
  std::string line = std::move(before);
  for (const SavedFile& file : files) {
    const std::string item = fmt::format("{} ({}){}", escaped(file.path), byte_size(file.bytes),
                                         &file == &files.back() ? "" : ",");
    if (line.size() + 1 + item.size() > kColumns) {
      io.err << line << "\n";
      line = " ";
    }
    line += " " + item;
  }
  io.err << line << "\n";
}

}  // namespace pstrips::cli
