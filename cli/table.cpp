#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <span>
#include <string_view>

#include "cli/report.h"

namespace pstrips::cli {
namespace {

constexpr std::size_t kColumns = 80;

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.,+-e% ") == text.npos;
}

// Characters rather than bytes, so that columns with names line up.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

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
  std::size_t all = 2 * (widths.size() - 1);
  for (const std::size_t column : widths) all += column;
  const std::string gap(all > kColumns ? 1 : 2, ' ');
  const bool has_header =
      std::ranges::any_of(rows_[0], [](const std::string& c) { return !c.empty(); });
  for (const auto& row : std::span(rows_).subspan(has_header ? 0 : 1)) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(widths[c] - width(row[c]), ' ');
      if (c > 0) line += gap;
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
    out.insert(static_cast<std::size_t>(at), 1, ',');
  return out;
}

std::string four_digits(double value) { return fmt::format("{:.4g}", value); }

std::string byte_size(std::uint64_t bytes) {
  constexpr std::array kUnits = {"B", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1000 && unit + 1 < kUnits.size(); ++unit) value /= 1000;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}", value, kUnits[unit]);
}

std::string csv_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : escaped(text)) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace pstrips::cli
