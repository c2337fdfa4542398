#include "formats/ply/ply_runs.h"

#include <algorithm>
#include <string_view>

#include "core/parallel.h"
#include "formats/ply/ply_numbers.h"

namespace pstrips::inline formats::ply {
namespace {

/// Rows in text without LF. Lone CRs end rows, too.
std::uint64_t rows_between_line_feeds(std::string_view text) {
  if (text.ends_with('\r')) text.remove_suffix(1);
  if (text.empty()) return 0;
  if (!is_space(text.front()) && text.find('\r') == text.npos) return 1;
  std::uint64_t rows = 0;
  bool in_row = false;
  for (const char c : text) {
    rows += !in_row && !is_space(c);
    in_row = (in_row || !is_space(c)) && !is_line_end(c);
  }
  return rows;
}

std::uint64_t count_rows(std::string_view text) {
  std::uint64_t rows = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    rows += rows_between_line_feeds(text.substr(at, end - at));
    at = end + 1;
  }
  return rows;
}

}  // namespace

std::vector<Run> cut_into_runs(ByteView file, std::uint64_t body, std::size_t run_bytes,
                               unsigned threads) {
  const std::string_view text = as_text(file);
  std::vector<Run> runs;
  for (std::size_t at = body; at < text.size();) {
    runs.push_back({at});
    if (text.size() - at <= run_bytes) break;
    const auto end = std::find_if(text.begin() + static_cast<std::ptrdiff_t>(at + run_bytes - 1),
                                  text.end(), is_line_end);
    at = end == text.end() ? text.size() : static_cast<std::size_t>(end - text.begin()) + 1;
  }
  runs.push_back({text.size()});
  parallel_for(threads, runs.size() - 1, 1, [&](std::size_t i, std::size_t) {
    runs[i + 1].rows = count_rows(text.substr(runs[i].begin, runs[i + 1].begin - runs[i].begin));
  });
  for (std::size_t i = 1; i < runs.size(); ++i) runs[i].rows += runs[i - 1].rows;
  return runs;
}

}  // namespace pstrips::inline formats::ply
