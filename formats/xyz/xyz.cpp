#include "formats/xyz/xyz.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/numbers.h"
#include "core/text.h"

namespace pstrips::inline formats {
namespace {

constexpr bool parts_columns(char c) { return is_space(c) || c == ',' || c == ';'; }

// Takes the next column off the line; empty when there is none.
std::string_view next_column(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && parts_columns(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !parts_columns(line[end])) ++end;
  const std::string_view column = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return column;
}

// How many of the first three columns are numbers, up to the first that is not.
std::size_t parse_point(std::string_view line, double (&point)[3]) {
  std::size_t count = 0;
  while (count < 3 && parse_number(next_column(line), point[count])) ++count;
  return count;
}

}  // namespace

Result<Model> read_xyz(ByteView file, const Limits& limits) {
  const std::string_view text = as_text(file);
  const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
  std::size_t at = text.size() - without_utf8_mark(text).size();
  std::uint64_t points = 0;
  std::optional<Error> before_points;  // at the first line of something else
  Bytes data;
  for (std::uint64_t number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find(line_end, at), text.size());
    std::string_view line = text.substr(at, end - at);
    line = line.substr(0, line.find('#'));
    double point[3];
    const std::size_t count = parse_point(line, point);
    const auto fail_here = [&](ErrorCode code, std::string message) {
      return fail(code, std::move(message), at, "line " + std::to_string(number));
    };
    if (count == 3) {
      if (++points > limits.vertices || data.size() + sizeof point > limits.memory_bytes)
        return fail_here(ErrorCode::over_limit, "more points than the limit allows");
      data.resize(data.size() + sizeof point);
      std::memcpy(data.data() + data.size() - sizeof point, point, sizeof point);
    } else if (std::ranges::any_of(line, [](char c) { return !parts_columns(c); })) {
      if (points > 0 && end == text.size())
        return fail_here(ErrorCode::truncated, "ends within a point");
      if (points > 0) return fail_here(ErrorCode::corrupt, "a point needs three numbers");
      if (!before_points)
        before_points = Error{ErrorCode::corrupt, "no line has three numbers", at,
                              "line " + std::to_string(number)};
    }
    at = end + 1;
  }
  if (points == 0 && before_points) return tl::unexpected(*before_points);
  Model model;
  Mesh& mesh = model.meshes.emplace_back();
  mesh.position.type = ComponentType::f64;
  mesh.position.data = std::move(data);
  mesh.groups.push_back({});
  return model;
}

}  // namespace pstrips::inline formats
