#include "formats/obj/runs.h"

#include <algorithm>

#include "formats/obj/names.h"
#include "formats/obj/numbers.h"

namespace pstrips::inline formats::obj {
namespace {

/// Statements whose rest is a name.
bool takes_name(std::string_view word) {
  return word == "o" || word == "g" || word == "usemtl" || word == "mtllib" || word == "usemap" ||
         word == "maplib";
}

class RunReader {
 public:
  RunReader(Run& run, const Limits& limits) : run_(run), limits_(limits) {}

  /// False: the line has a fault.
  bool read_line(std::string_view line, std::size_t line_at, bool whole) {
    Cursor cursor{line.data(), line.data() + line.size()};
    cursor.skip_space();
    const std::string_view rest = cursor.rest();
    if (rest.empty() || (rest.front() == '#' && !rest.starts_with(kNote))) return true;
    while (cursor.p != cursor.end && !is_space(*cursor.p)) ++cursor.p;
    const std::string_view word = rest.substr(0, rest.size() - cursor.rest().size());
    const bool is_face = whole && word == "f";
    if (whole && word == "v") return read_vertex(cursor, run_.geometry, limits_);
    if (whole && word == "vt") return read_texcoord(cursor, run_.geometry, limits_);
    if (whole && word == "vn") return read_normal(cursor, run_.geometry, limits_);
    if (is_face && knows_group_ && rest.find('-') == rest.npos) return read_face(cursor);
    run_.events.push_back({line_at, extent_of(run_.geometry)});
    knows_group_ = is_face;
    return true;
  }

 private:
  bool read_face(Cursor& cursor) {
    Geometry& out = run_.geometry;
    while (!cursor.at_end())
      if (!read_corner(cursor, out)) return false;
    if (out.corner_vertex.size() == out.face_first.back()) return false;
    out.face_first.push_back(static_cast<Index>(out.corner_vertex.size()));
    return out.corner_vertex.size() <= max_corners(limits_);
  }

  Run& run_;
  const Limits& limits_;
  bool knows_group_ = false;  // a face stands between the last line that may change it and here
};

}  // namespace

std::uint64_t Run::max_bytes(std::uint64_t name_bytes) const {
  // Each event may bring a name and a group, or corners like those of the run's own lines; no
  // character of a line costs more than the shortest corner's.
  const std::uint64_t text = end - begin;
  return geometry.bytes() + (events.empty() ? 0 : text * kCornerBytes) +
         2 * events.size() * name_bytes;
}

std::size_t run_end(std::string_view text, std::size_t begin, std::size_t run_bytes,
                    char line_end) {
  for (std::size_t at = begin + run_bytes - 1; at < text.size(); ++at) {
    at = text.find(line_end, at);
    if (at == text.npos) break;
    if (!is_continued(text.substr(0, at))) return at + 1;
  }
  return text.size();
}

bool goes_on(std::string_view text, std::size_t begin, std::size_t end, char line_end) {
  std::string_view line = text.substr(begin, end - begin);
  if (!is_continued(line) || trimmed(line).starts_with('#')) return false;
  if (!takes_name(next_word(line))) return true;
  if (end >= text.size()) return false;
  std::string_view next = text.substr(end + 1, text.find(line_end, end + 1) - end - 1);
  const std::string_view word = next_word(next);
  return !word.empty() && !word.starts_with('#') && !is_statement(word);
}

void read_run(Run& run, std::string_view text, char line_end, const Limits& limits) {
  RunReader reader(run, limits);
  bool continued = false;
  for (std::size_t at = run.begin; at < run.end;) {
    const std::size_t end = std::min(text.find(line_end, at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const bool continues = goes_on(text, at, end, line_end);
    // Its event covers the lines in which a statement goes on.
    if (!continued && !reader.read_line(line, at, !continues)) return;
    continued = continued ? is_continued(line) : continues;
    at = end + 1;
  }
  run.good = true;
}

}  // namespace pstrips::inline formats::obj
