#include "cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <ostream>
#include <span>

#include "core/file.h"

namespace pstrips::cli {
namespace {

constexpr std::array kInterrupts = {SIGINT, SIGTERM, SIGHUP};

extern "C" void end_cleanly(int signal) {
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// Length of the UTF-8 sequence at the front of text, 0 when it is broken or a control character.
std::size_t printable_sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return 0;
  if (byte(0) < 0x80) return 1;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  if (byte(0) == 0xc2 && byte(1) < 0xa0) return 0;  // C1 controls, which terminals obey
  // Overlong forms, surrogates and what lies beyond U+10FFFF; JSON takes none of them.
  if (byte(0) == 0xe0 && byte(1) < 0xa0) return 0;
  if (byte(0) == 0xed && byte(1) > 0x9f) return 0;
  if (byte(0) == 0xf0 && byte(1) < 0x90) return 0;
  if (byte(0) == 0xf4 && byte(1) > 0x8f) return 0;
  return length;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.,+-e% ") == text.npos;
}

// Characters rather than bytes, so that columns with names line up.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
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

ExitCode complain(const Streams& io, const Error& error, std::string_view file) {
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

void note(const Streams& io, std::string_view file, const std::vector<std::string>& notes) {
  if (io.quiet) return;
  for (const std::string& text : notes)
    io.err << "pstrips: " << escaped(file) << ": left out: " << escaped(text) << "\n";
}

void Table::print(std::ostream& out) const {
  std::vector<std::size_t> widths;
  std::vector<bool> numbers(rows_[0].size(), true);
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], width(row[c]));
      if (&row != &rows_[0] && !row[c].empty() && row[c] != "-" && !is_number(row[c]))
        numbers[c] = false;
    }
  }
  const bool has_header =
      std::ranges::any_of(rows_[0], [](const std::string& c) { return !c.empty(); });
  for (const auto& row : std::span(rows_).subspan(has_header ? 0 : 1)) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(widths[c] - width(row[c]), ' ');
      if (c > 0) line += "  ";
      line += numbers[c] ? pad + row[c] : row[c] + pad;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << "\n";
  }
}

void print_mesh_statistics(std::ostream& out, const MeshStatistics& statistics,
                           bool with_treatment) {
  for (const MeshStatisticKind& kind : mesh_statistic_kinds()) {
    const std::uint64_t count = statistics.*kind.count;
    if (count <= (kind.count == &MeshStatistics::components ? 1u : 0u)) continue;
    const std::string line = with_treatment ? fmt::format("{:>13}  {:<26}  {}", grouped(count),
                                                          kind.name, kind.treatment)
                                            : fmt::format("{:>13}  {}", grouped(count), kind.name);
    out << line << "\n";
  }
}

std::string grouped(std::uint64_t value) {
  std::string out = std::to_string(value);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(out.size()) - 3; at > 0; at -= 3)
    out.insert(static_cast<std::size_t>(at), ",");
  return out;
}

std::string figure(double value) { return fmt::format("{:.4g}", value); }

std::string byte_size(std::uint64_t bytes) {
  constexpr std::array kUnits = {"B", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1000 && unit + 1 < kUnits.size(); ++unit) value /= 1000;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}", value, kUnits[unit]);
}

void ProgressBar::clear() {
  if (shown_) io_.err << "\r\033[K" << std::flush;
  shown_ = false;
}

Progress ProgressBar::callback() {
  if (!io_.terminal || io_.quiet) return {};
  return [this](std::string_view stage, double done) {
    constexpr int kCells = 30;
    const int full = static_cast<int>(std::clamp(done, 0.0, 1.0) * kCells);
    io_.err << fmt::format(
                   "\r\033[K[{}{}] {:3.0f} % {}", std::string(static_cast<std::size_t>(full), '#'),
                   std::string(static_cast<std::size_t>(kCells - full), '.'), done * 100, stage)
            << std::flush;
    shown_ = true;
    return true;
  };
}

void install_interrupt_handler() {
  for (const int signal : kInterrupts)  // what nohup has the program ignore stays ignored
    if (std::signal(signal, end_cleanly) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace pstrips::cli
