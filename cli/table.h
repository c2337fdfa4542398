#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "codecs/measure/mesh_statistics.h"

namespace pstrips::cli {

/// A table whose columns line up: numbers to the right, text to the left.
class Table {
 public:
  /// A header of empty strings is not printed.
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// What a mesh has of what simple programs stumble over, a line a kind that occurs (components when
/// there are several): count, name and, if wanted, what became of it.
void print_mesh_statistics(std::ostream& out, const MeshStatistics& statistics,
                           bool with_treatment);

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t value);
/// Four significant digits, plain or scientific.
std::string four_digits(double value);
/// "12.3 kB", decimal units.
std::string byte_size(std::uint64_t bytes);

/// In quotes, for a field of CSV that comes from outside.
std::string csv_text(std::string_view text);

}  // namespace pstrips::cli
