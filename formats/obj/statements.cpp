#include "formats/obj/statements.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <optional>

#include "core/parallel.h"
#include "core/text.h"
#include "formats/obj/libraries.h"
#include "formats/obj/line_counts.h"
#include "formats/obj/names.h"
#include "formats/obj/runs.h"

namespace pstrips::inline formats::obj {
namespace {

class StatementReader {
 public:
  StatementReader(ByteView file, const ReadFile& read_file, const Limits& limits,
                  const ObjReadOptions& options, std::size_t run_bytes)
      : text_(as_text(file)),
        limits_(limits),
        options_(options),
        run_bytes_(run_bytes),
        libraries_(read_file, limits, options) {}

  Result<Statements> read() && {
    if (!expect_room() || !read_lines_of_file() || !check_references())
      return tl::unexpected(*error_);
    out_.object = object_name_;
    out_.libraries = libraries_.text();
    out_.missing_libraries = libraries_.missing();
    return std::move(out_);
  }

 private:
  /// Refuses a text that is long enough to hold more than the limits, and does, before it is read.
  bool expect_room() {
    constexpr std::uint64_t kShortestVertex = 8;     // "v 0 0 0\n"
    constexpr std::uint64_t kShortestTuple = 5;      // "vt 0\n"
    constexpr std::uint64_t kShortestFace = 4;       // "f 1\n"
    constexpr std::uint64_t kMemoryACharacter = 12;  // of the shortest vertices
    const std::uint64_t size = text_.size();
    if (size / kShortestVertex <= max_vertices(limits_) &&
        size / kShortestTuple <= max_tuples(limits_) &&
        size / kShortestFace <= max_corners(limits_) &&
        size * kMemoryACharacter <= limits_.memory_bytes)
      return true;
    const LineCounts counts = count_lines(text_);
    const auto over = [&](std::uint64_t figure, std::string_view what, std::uint64_t limit) {
      return figure > limit &&
             !refuse_at(ErrorCode::over_limit, over_limit_message(figure, what, limit), 0);
    };
    return !over(counts.vertices, "vertices", max_vertices(limits_)) &&
           !over(counts.tuples, "vt and vn lines", 2 * max_tuples(limits_)) &&
           !over(counts.faces, "face corners", max_corners(limits_)) &&
           !over(counts.vertices * kVertexBytes + counts.tuples * kTupleBytes +
                     counts.faces * kCornerBytes,
                 "bytes of memory", limits_.memory_bytes);
  }

  // Lines.

  bool read_lines_of_file() {
    line_end_ = text_.find('\n') == text_.npos ? '\r' : '\n';
    const bool in_runs = thread_count(limits_.threads) > 1 && text_.size() > run_bytes_;
    for (std::size_t at = text_.size() - without_utf8_mark(text_).size(); at < text_.size();)
      if (!(in_runs && header_ended_ ? read_runs(at) : read_line(at))) return false;
    if (!has_statements_ && first_unknown_)
      return refuse_at(ErrorCode::corrupt, "has no statement of an OBJ file", *first_unknown_);
    return true;
  }

  /// Reads the line at `at` with those that continue it, and moves behind them.
  bool read_line(std::size_t& at) {
    std::size_t end = std::min(text_.find(line_end_, at), text_.size());
    std::string_view line = text_.substr(at, end - at);
    line_at_ = at;
    cursor_.at_last = end == text_.size();
    if (goes_on(text_, at, end, line_end_)) {
      end = join_lines(end);
      line = joined_;
    }
    begin_ = cursor_.p = line.data();
    cursor_.end = begin_ + line.size();
    at = end + 1;
    if (!read_statement()) return false;
    return charged() <= limits_.memory_bytes ||
           refuse(ErrorCode::over_limit,
                  over_limit_message(charged(), "bytes of memory", limits_.memory_bytes));
  }

  // Runs. Some are read at once, then appended one after the other.

  bool read_runs(std::size_t& at) {
    constexpr std::size_t kRunsAtOnce = 16;
    std::vector<Run> runs;
    while (at < text_.size() && runs.size() < kRunsAtOnce) {
      Run& run = runs.emplace_back();
      run.begin = at;
      run.end = at = run_end(text_, at, run_bytes_, line_end_);
      run.geometry.vertices.total = geometry_.vertices.total;
      run.geometry.texcoords.total = geometry_.texcoords.total;
      run.geometry.normals.total = geometry_.normals.total;
    }
    parallel_for(limits_.threads, runs.size(), 1,
                 [&](std::size_t i, std::size_t) { read_run(runs[i], text_, line_end_, limits_); });
    for (Run& run : runs) {
      if (!(run.good && has_room(run) ? take(run) : read_lines(run))) return false;
      run = {};
    }
    return true;
  }

  /// Line by line: the first fault shows, and where.
  bool read_lines(const Run& run) {
    for (std::size_t at = run.begin; at < run.end;)
      if (!read_line(at)) return false;
    return true;
  }

  /// Whether a run breaks no limit, whatever its events are.
  bool has_room(const Run& run) const {
    const std::uint64_t others = run.events.empty() ? 0 : run.end - run.begin;
    const auto fits = [&](std::uint64_t all, std::uint64_t more, std::uint64_t most) {
      return all + more + others <= most;
    };
    const Geometry &all = geometry_, &more = run.geometry;
    return fits(all.vertices.count, more.vertices.count, max_vertices(limits_)) &&
           fits(all.texcoords.count, more.texcoords.count, max_tuples(limits_)) &&
           fits(all.normals.count, more.normals.count, max_tuples(limits_)) &&
           fits(all.corner_vertex.size(), more.corner_vertex.size(), max_corners(limits_)) &&
           charged() + run.max_bytes(kNameBytes) <= limits_.memory_bytes;
  }

  bool take(const Run& run) {
    Extent from;
    for (const Event& event : run.events) {
      append(run.geometry, from, event.before);
      from = event.before;
      std::size_t at = event.line_at;
      if (!read_line(at)) return false;
    }
    append(run.geometry, from, extent_of(run.geometry));
    geometry_.texcoords.missing += run.geometry.texcoords.missing;
    geometry_.normals.missing += run.geometry.normals.missing;
    return true;
  }

  void append(const Geometry& more, const Extent& from, const Extent& to) {
    obj::append(geometry_, more, from, to);
    const std::size_t faces = to.faces - from.faces;
    has_statements_ |= to.vertices + to.texcoords + to.normals + to.faces > 0;
    if (faces == 0) return;
    const Index group = current_group_[static_cast<std::size_t>(FaceKind::polygons)];
    assert(group != kNone);  // the first face of a group is an event
    out_.face_group.insert(out_.face_group.end(), faces, group);
    if (out_.has_smoothing)
      out_.face_smoothing.insert(out_.face_smoothing.end(), faces, smoothing_);
  }

  /// Joins a line with those that continue it into joined_, blanks in place of the line ends, so
  /// that positions stay what they are. Returns the end of the last one.
  std::size_t join_lines(std::size_t end) {
    joined_.assign(text_.substr(line_at_, end - line_at_));
    while (is_continued(joined_)) {
      joined_[joined_.find_last_of('\\')] = ' ';
      if (end == text_.size()) break;
      const std::size_t next = std::min(text_.find(line_end_, end + 1), text_.size());
      joined_ += ' ';
      joined_ += text_.substr(end + 1, next - end - 1);
      end = next;
    }
    cursor_.at_last = end == text_.size();
    return end;
  }

  std::string_view rest() const { return cursor_.rest(); }

  // Errors.

  bool refuse_at(ErrorCode code, std::string message, std::uint64_t offset) {
    const auto before = text_.substr(0, offset);
    const auto line = 1 + std::ranges::count(before, line_end_);
    error_ = Error{code, std::move(message), offset, "line " + std::to_string(line)};
    return false;
  }
  std::uint64_t offset() const { return line_at_ + static_cast<std::size_t>(cursor_.p - begin_); }
  bool refuse(ErrorCode code, std::string message) {
    return refuse_at(code, std::move(message), offset());
  }
  /// What a statement's own reader says.
  bool accept(bool good) { return good || refuse(cursor_.code, std::move(cursor_.message)); }

  // Statements.

  bool read_statement() {
    cursor_.skip_space();
    if (cursor_.p == cursor_.end) return true;
    const char* const word_begin = cursor_.p;
    if (*cursor_.p == '#') return read_comment();
    while (cursor_.p != cursor_.end && !is_space(*cursor_.p)) ++cursor_.p;
    const std::string_view word(word_begin, static_cast<std::size_t>(cursor_.p - word_begin));
    header_ended_ = true;
    if (word == "v") return known() && accept(read_vertex(cursor_, geometry_, limits_));
    if (word == "f" || word == "fo") return known() && read_face(FaceKind::polygons);
    if (word == "vt") return known() && accept(read_texcoord(cursor_, geometry_, limits_));
    if (word == "vn") return known() && accept(read_normal(cursor_, geometry_, limits_));
    if (word == "l") return known() && read_face(FaceKind::lines);
    if (word == "p") return known() && read_face(FaceKind::points);
    if (word == "g") return known() && set_name(group_, clean_group(rest()));
    if (word == "o") return known() && set_object(clean_name(rest()));
    if (word == "usemtl") return known() && set_name(material_, clean_name(rest()));
    if (word == "s" && read_smoothing()) return known();
    if (word == "mtllib") return known() && read_mtllib();
    cursor_.p = word_begin;
    if (!first_unknown_) first_unknown_ = offset();
    return keep_line(out_.notes, rest());
  }

  bool known() { return has_statements_ = true; }

  bool read_comment() {
    if (rest().starts_with(kNote)) return keep_line(out_.notes, rest().substr(kNote.size()));
    return header_ended_ || keep_line(out_.header, rest());
  }

  bool keep_line(std::string& lines, std::string_view line) {
    line = trimmed(line);
    if (lines.size() + line.size() >= limits_.string_bytes)
      return refuse(ErrorCode::over_limit, "more text beside the mesh than the limit allows");
    lines.append(line) += '\n';
    return true;
  }

  bool read_face(FaceKind kind) {
    const std::size_t first = geometry_.corner_vertex.size();
    while (!cursor_.at_end()) {
      if (!accept(read_corner(cursor_, geometry_))) return false;
      if (kind == FaceKind::points) end_face(kind);
    }
    const std::size_t corners = geometry_.corner_vertex.size();
    if (corners == first) return accept(cursor_.refuse_short("an element without a corner"));
    if (corners > max_corners(limits_))
      return refuse(ErrorCode::over_limit,
                    over_limit_message(corners, "face corners", max_corners(limits_)));
    if (kind != FaceKind::points) end_face(kind);
    return error_ == std::nullopt;
  }

  /// `s 3`, `s off`, or `s` for off; others are left to the notes.
  bool read_smoothing() {
    std::string_view text = rest();
    const std::string_view word = next_word(text);
    std::uint64_t value = 0;
    if (word == "on") {
      value = 1;
    } else if (word != "off") {
      for (const char c : word) {
        if (c < '0' || c > '9') return false;
        value = 10 * value + static_cast<std::uint64_t>(c - '0');
        if (value > std::numeric_limits<std::uint32_t>::max()) return false;
      }
    }
    if (!out_.has_smoothing) out_.face_smoothing.assign(geometry_.face_first.size() - 1, 0);
    out_.has_smoothing = true;
    smoothing_ = static_cast<std::uint32_t>(value);
    return true;
  }

  // Groups.

  bool set_name(Index& current, std::string name) {
    const std::size_t bytes = name.size() + kNameBytes, known_names = out_.names.size();
    current = out_.names.id(std::move(name));
    if (out_.names.size() > known_names) charge(bytes);
    current_group_.fill(kNone);
    return true;
  }

  /// Each statement begins another object, which counts once it has a face.
  bool set_object(std::string name) {
    set_name(object_name_, std::move(name));
    object_ = object_name_ == kEmptyName ? 0 : kNone;
    return true;
  }

  void end_face(FaceKind kind) {
    Index& group = current_group_[static_cast<std::size_t>(kind)];
    if (group == kNone) group = find_group(kind);
    out_.face_group.push_back(group);
    geometry_.face_first.push_back(static_cast<Index>(geometry_.corner_vertex.size()));
    if (out_.has_smoothing) out_.face_smoothing.push_back(smoothing_);
  }

  Index find_group(FaceKind kind) {
    if (object_ == kNone) {
      object_ = static_cast<Index>(out_.objects.size());
      out_.objects.push_back({object_name_, ++instances_[object_name_]});
    }
    const GroupKey key{object_, group_, material_, kind};
    const auto [at, is_new] = group_ids_.emplace(key, static_cast<Index>(out_.groups.size()));
    if (!is_new) return at->second;
    out_.groups.push_back(key);
    // An object's name is repeated in each of its groups: a long one must not multiply.
    group_name_bytes_ += out_.names[object_name_].size() + out_.names[group_].size();
    charge(kNameBytes);
    if (out_.groups.size() > limits_.meshes)
      refuse(ErrorCode::over_limit, "more groups than the limit allows");
    if (group_name_bytes_ > kNameGrowth * text_.size() + kShortNames)
      refuse(ErrorCode::over_limit, "group names that outgrow the file");
    return at->second;
  }

  bool read_mtllib() {
    const auto read = libraries_.read(rest());
    if (read) return true;
    Error error = read.error();
    if (error.offset == kNoOffset && error.path.empty())
      return refuse(error.code, std::move(error.message));
    error_ = std::move(error);
    return false;
  }

  /// When a reference leads nowhere, a second reader that knows the totals finds the first such.
  bool check_references() {
    const auto in_range = [](const Referenced& lines) { return lines.largest <= lines.count; };
    if (!in_range(geometry_.texcoords))
      remove_past_end(geometry_.texcoords, geometry_.corner_texcoord);
    if (!in_range(geometry_.normals)) remove_past_end(geometry_.normals, geometry_.corner_normal);
    if (in_range(geometry_.vertices)) return true;
    const ReadFile no_file;
    StatementReader second(as_bytes(text_), no_file, limits_, options_, run_bytes_);
    second.geometry_.vertices.total = geometry_.vertices.count;
    second.read_lines_of_file();
    error_ = std::move(second.error_);
    return false;
  }

  static void remove_past_end(Referenced& lines, std::vector<Index>& corners) {
    for (Index& line : corners)
      if (line != kNone && line >= lines.count) {
        line = kNone;
        ++lines.missing;
      }
  }

  static constexpr std::uint64_t kNameBytes = 160;
  // All group names together may be so many times the file's size, and a little more.
  static constexpr std::uint64_t kNameGrowth = 16, kShortNames = 1u << 16;
  void charge(std::uint64_t bytes) { charged_for_names_ += bytes; }
  std::uint64_t charged() const { return geometry_.bytes() + charged_for_names_; }

  std::string_view text_;
  const Limits& limits_;
  const ObjReadOptions& options_;
  std::optional<Error> error_;
  std::uint64_t charged_for_names_ = 0;
  const std::size_t run_bytes_;
  char line_end_ = '\n';

  // The current line.
  Cursor cursor_;
  const char* begin_ = nullptr;
  std::size_t line_at_ = 0;  ///< offset of begin_
  std::string joined_;

  bool header_ended_ = false, has_statements_ = false;
  std::optional<std::uint64_t> first_unknown_;
  MaterialLibraries libraries_;

  Statements out_;
  Geometry& geometry_ = out_.geometry;
  std::uint32_t smoothing_ = 0;
  Index object_name_ = out_.names.id(""), group_ = kEmptyName, material_ = kEmptyName;
  Index object_ = 0;                  ///< number of the current one; kNone: it has no face yet
  std::map<Index, Index> instances_;  ///< objects that have a face, by name
  std::array<Index, 3> current_group_{kNone, kNone, kNone};  ///< by kind; of the state in force
  std::map<GroupKey, Index> group_ids_;
  std::uint64_t group_name_bytes_ = 0;
};

}  // namespace

Result<Statements> read_statements(ByteView file, const ReadFile& read_file, const Limits& limits,
                                   const ObjReadOptions& options, std::size_t run_bytes) {
  return StatementReader(file, read_file, limits, options, run_bytes).read();
}

}  // namespace pstrips::inline formats::obj
