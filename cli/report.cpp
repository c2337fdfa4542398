#include "cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "core/text.h"

namespace pstrips::cli {
namespace {

// Length of the UTF-8 sequence at the front of text, 0 when it is broken or a control character.
std::size_t printable_sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return 0;
  const std::size_t length = utf8_length(text);
  // C1 controls, which terminals obey.
  return length == 2 && byte(0) == 0xc2 && byte(1) < 0xa0 ? 0 : length;
}

ExitCode exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_argument:
      return kBadCommandLine;
    case ErrorCode::io:
      return kInputOutput;
    case ErrorCode::truncated:
    case ErrorCode::corrupt:
    case ErrorCode::over_limit:
      return kInvalidFile;
    case ErrorCode::unsupported:
      return kUnsupported;
    case ErrorCode::interrupted:
      return kRuntime;
  }
  return kRuntime;
}

std::string_view kind_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::truncated:
      return "truncated: ";
    case ErrorCode::corrupt:
      return "corrupt: ";
    case ErrorCode::over_limit:
      return "over the limit: ";
    case ErrorCode::unsupported:
      return "unsupported: ";
    default:
      return "";
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = printable_sequence(text);
    if (length == 0)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

ExitCode report(const Streams& io, const Error& error, std::string_view file) {
  std::string where;
  if (error.offset != kNoOffset) where = fmt::format("byte {}", error.offset);
  if (!error.path.empty() && error.path != file)
    where += (where.empty() ? "" : ", ") + escaped(error.path);
  io.err << "pstrips: ";
  if (!file.empty()) io.err << escaped(file) << ": ";
  io.err << kind_of(error.code) << escaped(error.message);
  if (!where.empty()) io.err << " (at " << where << ")";
  io.err << "\n";
  return exit_code(error.code);
}

void note(const Streams& io, std::string_view file, const std::vector<std::string>& notes,
          std::string_view outcome) {
  if (io.quiet) return;
  for (const std::string& text : notes)
    io.err << "pstrips: " << escaped(file) << ": " << outcome << ": " << escaped(text) << "\n";
}

}  // namespace pstrips::cli
