#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "core/parallel.h"
#include "formats/obj/census.h"
#include "formats/obj/geometry.h"
#include "formats/obj/mtl.h"
#include "formats/obj/names.h"
#include "formats/obj/numbers.h"
#include "formats/obj/obj.h"
#include "formats/obj/runs.h"
#include "formats/obj/wedges.h"

namespace pstrips::inline formats {
namespace {

using obj::WedgeTable;

/// Strings by number, in order of their first use.
class Names {
 public:
  Index id(std::string name) {
    const auto [at, is_new] = ids_.emplace(std::move(name), static_cast<Index>(names_.size()));
    if (is_new) names_.push_back(&at->first);
    return at->second;
  }
  const std::string& operator[](Index id) const { return *names_[id]; }
  std::size_t size() const { return names_.size(); }

 private:
  std::map<std::string, Index> ids_;
  std::vector<const std::string*> names_;  // map nodes stay where they are
};

/// Reads statement by statement into flat arrays, then makes the mesh of them.
class ObjReader {
 public:
  ObjReader(ByteView file, const ReadFile& read_file, const Limits& limits, std::size_t run_bytes)
      : text_(as_text(file)), read_file_(read_file), limits_(limits), run_bytes_(run_bytes) {}

  Result<Model> read() {
    if (!expect_room() || !read_statements() || !check_references() || !build())
      return tl::unexpected(*error_);
    return std::move(model_);
  }

 private:
  /// Refuses a text that is long enough to hold more than the limits, and does, before it is read.
  bool expect_room() {
    constexpr std::uint64_t kShortestVertex = 8;     // "v 0 0 0\n"
    constexpr std::uint64_t kShortestTuple = 5;      // "vt 0\n"
    constexpr std::uint64_t kShortestFace = 4;       // "f 1\n"
    constexpr std::uint64_t kMemoryACharacter = 12;  // of the shortest vertices
    const std::uint64_t size = text_.size();
    if (size / kShortestVertex <= obj::most_vertices(limits_) &&
        size / kShortestTuple <= obj::most_tuples(limits_) &&
        size / kShortestFace <= obj::most_corners(limits_) &&
        size * kMemoryACharacter <= limits_.memory_bytes)
      return true;
    const obj::Census census = obj::take_census(text_);
    const auto over = [&](std::uint64_t figure, std::string_view what, std::uint64_t limit) {
      return figure > limit &&
             !refuse_at(ErrorCode::over_limit, over_limit_message(figure, what, limit), 0);
    };
    return !over(census.vertices, "vertices", obj::most_vertices(limits_)) &&
           !over(census.tuples, "vt and vn lines", 2 * obj::most_tuples(limits_)) &&
           !over(census.faces, "face corners", obj::most_corners(limits_)) &&
           !over(census.vertices * obj::kVertexBytes + census.tuples * obj::kTupleBytes +
                     census.faces * obj::kCornerBytes,
                 "bytes of memory", limits_.memory_bytes);
  }

  // Lines.

  bool read_statements() {
    constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
    line_end_ = text_.find('\n') == text_.npos ? '\r' : '\n';
    const bool in_runs = thread_count(limits_.threads) > 1 && text_.size() > run_bytes_;
    for (std::size_t at = text_.starts_with(kUtf8Mark) ? kUtf8Mark.size() : 0; at < text_.size();)
      if (!(in_runs && header_ended_ ? read_runs(at) : read_line(at))) return false;
    if (!statements_ && first_unknown_)
      return refuse_at(ErrorCode::corrupt, "has no statement of an OBJ file", *first_unknown_);
    return true;
  }

  /// Reads the line at `at` with those that continue it, and moves behind them.
  bool read_line(std::size_t& at) {
    std::size_t end = std::min(text_.find(line_end_, at), text_.size());
    std::string_view line = text_.substr(at, end - at);
    line_at_ = at;
    cursor_.at_last = end == text_.size();
    if (obj::is_continued(line) && !obj::trimmed(line).starts_with('#')) {
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

  // Runs. Some are read at once, then told one after the other.

  bool read_runs(std::size_t& at) {
    constexpr std::size_t kRunsAtOnce = 16;
    std::vector<obj::Run> runs;
    while (at < text_.size() && runs.size() < kRunsAtOnce) {
      obj::Run& run = runs.emplace_back();
      run.begin = at;
      run.end = at = obj::run_end(text_, at, run_bytes_, line_end_);
      run.geometry.vertices.total = geometry_.vertices.total;
      run.geometry.texcoords.total = geometry_.texcoords.total;
      run.geometry.normals.total = geometry_.normals.total;
    }
    parallel_for(limits_.threads, runs.size(), 1, [&](std::size_t i, std::size_t) {
      obj::read_run(runs[i], text_, line_end_, limits_);
    });
    for (obj::Run& run : runs) {
      if (!(run.good && has_room(run) ? take(run) : read_lines(run))) return false;
      run = {};
    }
    return true;
  }

  /// Line by line: the first fault shows, and where.
  bool read_lines(const obj::Run& run) {
    for (std::size_t at = run.begin; at < run.end;)
      if (!read_line(at)) return false;
    return true;
  }

  /// Whether a run breaks no limit, whatever its events are.
  bool has_room(const obj::Run& run) const {
    const std::uint64_t others = run.events.empty() ? 0 : run.end - run.begin;
    const auto fits = [&](std::uint64_t all, std::uint64_t more, std::uint64_t most) {
      return all + more + others <= most;
    };
    const obj::Geometry &all = geometry_, &more = run.geometry;
    return fits(all.vertices.count, more.vertices.count, obj::most_vertices(limits_)) &&
           fits(all.texcoords.count, more.texcoords.count, obj::most_tuples(limits_)) &&
           fits(all.normals.count, more.normals.count, obj::most_tuples(limits_)) &&
           fits(all.corner_vertex.size(), more.corner_vertex.size(), obj::most_corners(limits_)) &&
           charged() + run.most_bytes(kNameBytes) <= limits_.memory_bytes;
  }

  bool take(const obj::Run& run) {
    obj::Extent from;
    for (const obj::Event& event : run.events) {
      append(run.geometry, from, event.before);
      from = event.before;
      std::size_t at = event.line_at;
      if (!read_line(at)) return false;
    }
    append(run.geometry, from, obj::extent_of(run.geometry));
    return true;
  }

  void append(const obj::Geometry& more, const obj::Extent& from, const obj::Extent& to) {
    obj::append(geometry_, more, from, to);
    const std::size_t faces = to.faces - from.faces;
    statements_ |= to.vertices + to.texcoords + to.normals + to.faces > 0;
    if (faces == 0) return;
    const Index group = current_group_[static_cast<std::size_t>(FaceKind::polygons)];
    assert(group != kNone);  // the first face of a group is an event
    face_group_.insert(face_group_.end(), faces, group);
    if (has_smoothing_) face_smoothing_.insert(face_smoothing_.end(), faces, smoothing_);
  }

  /// Joins a line with those that continue it into joined_, blanks in place of the line ends, so
  /// that positions stay what they are. Returns the end of the last one.
  std::size_t join_lines(std::size_t end) {
    joined_.assign(text_.substr(line_at_, end - line_at_));
    while (obj::is_continued(joined_)) {
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
    while (cursor_.p != cursor_.end && !obj::is_space(*cursor_.p)) ++cursor_.p;
    const std::string_view word(word_begin, static_cast<std::size_t>(cursor_.p - word_begin));
    header_ended_ = true;
    if (word == "v") return known() && accept(read_vertex(cursor_, geometry_, limits_));
    if (word == "f" || word == "fo") return known() && read_face(FaceKind::polygons);
    if (word == "vt") return known() && accept(read_texcoord(cursor_, geometry_, limits_));
    if (word == "vn") return known() && accept(read_normal(cursor_, geometry_, limits_));
    if (word == "l") return known() && read_face(FaceKind::lines);
    if (word == "p") return known() && read_face(FaceKind::points);
    if (word == "g") return known() && set_name(group_, obj::clean_group(rest()));
    if (word == "o") return known() && set_name(object_, obj::clean_name(rest()));
    if (word == "usemtl") return known() && set_name(material_, obj::clean_name(rest()));
    if (word == "s" && read_smoothing()) return known();
    if (word == "mtllib") return known() && read_mtllib();
    cursor_.p = word_begin;
    if (!first_unknown_) first_unknown_ = offset();
    return keep_line(notes_, rest());
  }

  bool known() { return statements_ = true; }

  bool read_comment() {
    if (rest().starts_with(obj::kNote)) return keep_line(notes_, rest().substr(obj::kNote.size()));
    return header_ended_ || keep_line(header_, rest());
  }

  bool keep_line(std::string& lines, std::string_view line) {
    line = obj::trimmed(line);
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
    if (corners > obj::most_corners(limits_))
      return refuse(ErrorCode::over_limit,
                    over_limit_message(corners, "face corners", obj::most_corners(limits_)));
    if (kind != FaceKind::points) end_face(kind);
    return error_ == std::nullopt;
  }

  /// `s 3`, `s off`, or `s` for off; others are left to the notes.
  bool read_smoothing() {
    std::string_view text = rest();
    const std::string_view word = obj::next_word(text);
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
    if (!has_smoothing_) face_smoothing_.assign(geometry_.face_first.size() - 1, 0);
    has_smoothing_ = true;
    smoothing_ = static_cast<std::uint32_t>(value);
    return true;
  }

  // Groups.

  bool set_name(Index& current, std::string name) {
    const std::size_t bytes = name.size() + kNameBytes, known_names = names_.size();
    current = names_.id(std::move(name));
    if (names_.size() > known_names) charge(bytes);
    current_group_.fill(kNone);
    return true;
  }

  void end_face(FaceKind kind) {
    Index& group = current_group_[static_cast<std::size_t>(kind)];
    if (group == kNone) group = find_group(kind);
    face_group_.push_back(group);
    geometry_.face_first.push_back(static_cast<Index>(geometry_.corner_vertex.size()));
    if (has_smoothing_) face_smoothing_.push_back(smoothing_);
  }

  Index find_group(FaceKind kind) {
    const GroupKey key{object_, group_, material_, kind};
    const auto [at, is_new] = group_ids_.emplace(key, static_cast<Index>(groups_.size()));
    if (!is_new) return at->second;
    groups_.push_back(key);
    // An object's name is repeated in each of its groups: a long one must not multiply.
    group_name_bytes_ += names_[object_].size() + names_[group_].size();
    charge(kNameBytes);
    if (groups_.size() > limits_.meshes)
      refuse(ErrorCode::over_limit, "more groups than the limit allows");
    if (group_name_bytes_ > kNameGrowth * text_.size() + kShortNames)
      refuse(ErrorCode::over_limit, "group names that outgrow the file");
    return at->second;
  }

  // Materials.

  bool read_mtllib() {
    const std::string_view whole = obj::trimmed(rest());
    if (whole.empty()) return true;
    if (const auto read = read_companion(whole)) return *read;
    for (const std::string_view name : obj::split_mtllib(whole)) {
      if (const auto read = read_companion(name)) {
        if (!*read) return false;
        continue;
      }
      bool found = false;
      std::string_view words = name;
      for (auto word = obj::next_word(words); !word.empty(); word = obj::next_word(words)) {
        const auto read = read_companion(word);
        if (read && !*read) return false;
        found |= read.has_value();
      }
      if (found || !missing_names_.emplace(name).second) continue;
      if (!keep_line(missing_, name)) return false;
    }
    return true;
  }

  /// Nothing: there is no such file. False: an error. A library that was read before counts once.
  std::optional<bool> read_companion(std::string_view written) {
    const auto path = obj::companion_path(written);
    if (!path || !read_file_) return std::nullopt;
    const auto seen = companions_.find(*path);
    if (seen != companions_.end()) return seen->second ? std::optional(true) : std::nullopt;
    auto bytes = read_file_(*path);
    companions_.emplace(*path, bytes.has_value());
    if (!bytes && bytes.error().code == ErrorCode::io) return std::nullopt;
    if (!bytes) {
      error_ = std::move(bytes.error());
      return false;
    }
    std::string_view text = as_text(*bytes);
    constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
    if (text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
    if (mtl_.size() + text.size() >= limits_.string_bytes)
      return refuse(ErrorCode::over_limit, "more material text than the limit allows");
    mtl_ += text;
    if (!mtl_.empty() && !mtl_.ends_with('\n')) mtl_ += '\n';
    return true;
  }

  // Making the model.

  /// When a reference leads nowhere, a second reader that knows the totals finds the first such.
  bool check_references() {
    const auto in_range = [](const obj::Referenced& lines) { return lines.largest <= lines.count; };
    if (in_range(geometry_.vertices) && in_range(geometry_.texcoords) &&
        in_range(geometry_.normals))
      return true;
    const ReadFile no_file;
    ObjReader second(as_bytes(text_), no_file, limits_, run_bytes_);
    second.geometry_.vertices.total = geometry_.vertices.count;
    second.geometry_.texcoords.total = geometry_.texcoords.count;
    second.geometry_.normals.total = geometry_.normals.count;
    second.read_statements();
    error_ = std::move(second.error_);
    return false;
  }

  bool build() {
    count_unused_tuples();
    // Wedges are numbered in 32 bits.
    if (const std::uint64_t most = geometry_.corner_vertex.size() + geometry_.vertices.count;
        most > kMaxCount)
      return refuse_at(ErrorCode::over_limit,
                       over_limit_message(most, "corners and vertices", kMaxCount), 0);
    WedgeTable wedges =
        obj::build_wedges({.vertex_count = static_cast<Index>(geometry_.vertices.count),
                           .corner_vertex = geometry_.corner_vertex,
                           .corner_texcoord = geometry_.corner_texcoord,
                           .corner_normal = geometry_.corner_normal,
                           .texcoord = geometry_.texcoord,
                           .texcoord_flags = geometry_.texcoord_flags,
                           .normal = geometry_.normal});
    if (wedges.vertex.size() > obj::most_tuples(limits_))
      return refuse_at(
          ErrorCode::over_limit,
          over_limit_message(wedges.vertex.size(), "wedges", obj::most_tuples(limits_)), 0);
    wedges_ = std::move(wedges);
    if (geometry_.corner_vertex.empty()) take_cloud_attributes();

    Mesh& mesh = model_.meshes.emplace_back();
    mesh.position = attribute(
        "POSITION", geometry_.values.position_fits, 3, geometry_.vertices.count,
        [&](std::size_t v, std::size_t c) { return geometry_.values.position[3 * v + c]; });
    add_wedge_attributes(mesh);
    mesh.wedge_vertex = std::move(wedges_.vertex);
    mesh.corners = std::move(wedges_.corners);
    mesh.face_first = std::move(geometry_.face_first);
    mesh.face_group = std::move(face_group_);
    if (has_smoothing_ && mesh.face_count() > 0) {
      const ByteView data = std::as_bytes(std::span(face_smoothing_));
      mesh.face_attributes.push_back({std::string(kObjSmoothing), ComponentType::u32, 1, false,
                                      Bytes(data.begin(), data.end())});
    }
    if (!add_materials()) return false;
    name_groups(mesh);
    add_foreign();
    canonicalize(mesh);
    return true;
  }

  /// Point clouds come with as many normals or texture coordinates as vertices and nothing that
  /// would tie them together.
  void take_cloud_attributes() {
    if (geometry_.normals.count == geometry_.vertices.count)
      std::iota(wedges_.normal.begin(), wedges_.normal.end(), 0u);
    if (geometry_.texcoords.count == geometry_.vertices.count)
      std::iota(wedges_.texcoord.begin(), wedges_.texcoord.end(), 0u);
  }

  void count_unused_tuples() {
    note_unused("vt", geometry_.texcoords.count, geometry_.corner_texcoord);
    note_unused("vn", geometry_.normals.count, geometry_.corner_normal);
  }

  void note_unused(std::string_view kind, std::uint64_t count, const std::vector<Index>& used) {
    if (count == 0 || (geometry_.corner_vertex.empty() && count == geometry_.vertices.count))
      return;
    std::vector<bool> is_used(count);
    for (const Index i : used)
      if (i != kNone) is_used[i] = true;
    const auto unused = std::ranges::count(is_used, false);
    if (unused > 0) notes_ += std::to_string(unused) + " unused " + std::string(kind) + " lines\n";
  }

  /// Which of ObjPresent wedge w has, by the lines it was made of.
  std::uint8_t present(std::size_t w) const {
    std::uint8_t flags =
        geometry_.values.flags.empty() ? 0 : geometry_.values.flags[wedges_.vertex[w]];
    if (wedges_.texcoord[w] != kNone) flags |= geometry_.texcoord_flags[wedges_.texcoord[w]];
    if (wedges_.normal[w] != kNone) flags |= kHasNormal;
    return flags;
  }

  template <class Value>
  static Attribute attribute(std::string_view semantic, bool f32, std::uint8_t count,
                             std::size_t elements, Value&& value) {
    Attribute out{
        std::string(semantic), f32 ? ComponentType::f32 : ComponentType::f64, count, false, {}};
    out.data.resize(elements * out.element_bytes());
    std::byte* at = out.data.data();
    for (std::size_t i = 0; i < elements; ++i)
      for (std::size_t c = 0; c < count; ++c) {
        const double number = value(i, c);
        if (f32) {
          const auto single = static_cast<float>(number);
          std::memcpy(at, &single, sizeof single);
        } else {
          std::memcpy(at, &number, sizeof number);
        }
        at += size_of(out.type);
      }
    return out;
  }

  void add_wedge_attributes(Mesh& mesh) {
    const std::size_t n = wedges_.vertex.size();
    const bool plain = geometry_.values.flags.empty() && geometry_.corner_texcoord.empty() &&
                       geometry_.corner_normal.empty() && !geometry_.corner_vertex.empty();
    if (plain) return;
    std::vector<std::uint8_t> flags(n);
    std::uint8_t any = 0;
    bool uv_fit = true, w_fit = true, normal_fit = true;
    for (std::size_t w = 0; w < n; ++w) {
      any |= flags[w] = present(w);
      if (const Index vt = wedges_.texcoord[w]; vt != kNone) {
        uv_fit &= (geometry_.texcoord_fits[vt] & obj::kUvFit) != 0;
        w_fit &= (geometry_.texcoord_fits[vt] & obj::kTexWFits) != 0;
      }
      if (const Index vn = wedges_.normal[w]; vn != kNone)
        normal_fit &= geometry_.normal_fits[vn] != 0;
    }
    std::vector<Attribute>& out = mesh.wedge_attributes;
    const auto value_of = [](const std::vector<double>& values, std::size_t width, Index i,
                             std::size_t c) { return i == kNone ? 0.0 : values[width * i + c]; };
    if (any & kHasNormal)
      out.push_back(attribute("NORMAL", normal_fit, 3, n, [&](std::size_t w, std::size_t c) {
        return value_of(geometry_.normal, 3, wedges_.normal[w], c);
      }));
    if (any & kHasTexcoord)
      out.push_back(attribute("TEXCOORD_0", uv_fit, 2, n, [&](std::size_t w, std::size_t c) {
        return value_of(geometry_.texcoord, 3, wedges_.texcoord[w], c);
      }));
    geometry_.values.color.resize(any & kHasColor ? 4 * geometry_.vertices.count : 0);
    if (any & kHasColor)
      out.push_back(
          attribute("COLOR_0", geometry_.values.color_fits, any & kHasAlpha ? 4 : 3, n,
                    [&](std::size_t w, std::size_t c) {
                      return geometry_.values.color[std::size_t{4} * wedges_.vertex[w] + c];
                    }));
    geometry_.values.weight.resize(any & kHasWeight ? geometry_.vertices.count : 0);
    if (any & kHasWeight)
      out.push_back(attribute(
          kObjWeight, geometry_.values.weight_fits, 1, n,
          [&](std::size_t w, std::size_t) { return geometry_.values.weight[wedges_.vertex[w]]; }));
    if (any & kHasTexW)
      out.push_back(attribute(kObjTexW, w_fit, 1, n, [&](std::size_t w, std::size_t) {
        return value_of(geometry_.texcoord, 3, wedges_.texcoord[w], 2);
      }));
    add_presence(mesh, std::move(flags), any);
  }

  /// The mask is there when a wedge lacks something that others have. What a file can only say
  /// of corners is not missed in a wedge without one.
  void add_presence(Mesh& mesh, std::vector<std::uint8_t> flags, std::uint8_t any) {
    if (any & kHasTexcoord) any |= kHasTexV;
    constexpr std::uint8_t kOfVertex = kHasColor | kHasAlpha | kHasWeight;
    const auto misses = [&](std::size_t w) {
      const std::uint8_t mask =
          wedges_.has_corner(w) || geometry_.corner_vertex.empty() ? 0xff : kOfVertex;
      return (flags[w] & mask) != (any & mask);
    };
    bool mixed = false;
    for (std::size_t w = 0; w < flags.size() && !mixed; ++w) mixed = misses(w);
    if (!mixed) return;
    const ByteView data = std::as_bytes(std::span(flags));
    mesh.wedge_attributes.push_back(
        {std::string(kObjPresent), ComponentType::u8, 1, false, Bytes(data.begin(), data.end())});
  }

  bool add_materials() {
    Scene& scene = model_.scene;
    if (const auto read = obj::read_mtl(mtl_, scene, limits_); !read) {
      error_ = read.error();
      return false;
    }
    std::map<std::string_view, Index> by_name;
    const auto defined = static_cast<Index>(scene.materials.size());
    for (Index m = 0; m < defined; ++m) by_name.emplace(scene.materials[m].name, m);
    for (const GroupKey& key : groups_) {
      const std::string& name = names_[std::get<2>(key)];
      if (name.empty()) continue;
      const auto next = static_cast<Index>(defined + unknown_materials_.size());
      if (by_name.emplace(name, next).second) unknown_materials_.push_back(name);
    }
    for (const GroupKey& key : groups_) {
      const auto found = by_name.find(names_[std::get<2>(key)]);
      const bool has_name = !names_[std::get<2>(key)].empty();
      group_material_.push_back(has_name ? found->second : kNone);
    }
    if (defined + unknown_materials_.size() > limits_.meshes)
      return refuse_at(ErrorCode::over_limit, "more materials than the limit allows", 0);
    for (std::string& name : unknown_materials_)
      scene.materials.push_back(obj::named_material(std::move(name)));
    return true;
  }

  void name_groups(Mesh& mesh) {
    const auto object_of = [](const GroupKey& key) { return std::get<0>(key); };
    const Index object = groups_.empty() ? object_ : object_of(groups_.front());
    const bool one_object =
        std::ranges::all_of(groups_, [&](const GroupKey& key) { return object_of(key) == object; });
    if (one_object) mesh.name = names_[object];
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const auto& [key_object, key_group, material, kind] = groups_[i];
      const std::string& prefix = one_object ? names_[kEmptyName] : names_[key_object];
      mesh.groups.push_back({obj_group_name(prefix, names_[key_group]), group_material_[i], kind});
    }
  }

  void add_foreign() {
    const auto add = [&](std::string key, std::string_view text) {
      const ByteView data = as_bytes(text);
      if (!text.empty())
        model_.scene.foreign.push_back({std::move(key), Bytes(data.begin(), data.end())});
    };
    add("obj/header", header_);
    add("obj/mtllib", missing_);
    add("obj/mtl", mtl_);
    add("obj/notes", notes_);
  }

  static constexpr std::uint64_t kNameBytes = 160;
  // All group names together may be so many times the file's size, and a little more.
  static constexpr std::uint64_t kNameGrowth = 16, kShortNames = 1u << 16;
  void charge(std::uint64_t bytes) { charged_for_names_ += bytes; }
  std::uint64_t charged() const { return geometry_.bytes() + charged_for_names_; }

  using GroupKey = std::tuple<Index, Index, Index, FaceKind>;  ///< object, group, material, kind
  static constexpr Index kEmptyName = 0;

  std::string_view text_;
  const ReadFile& read_file_;
  const Limits& limits_;
  std::optional<Error> error_;
  std::uint64_t charged_for_names_ = 0;
  const std::size_t run_bytes_;
  char line_end_ = '\n';

  // The current line.
  obj::Cursor cursor_;
  const char* begin_ = nullptr;
  std::size_t line_at_ = 0;  ///< offset of begin_
  std::string joined_;

  bool header_ended_ = false, statements_ = false;
  std::optional<std::uint64_t> first_unknown_;
  std::string header_, notes_, missing_, mtl_;
  std::set<std::string> missing_names_;
  std::map<std::string, bool> companions_;  ///< by path; whether it could be read

  obj::Geometry geometry_;
  std::vector<Index> face_group_;
  std::vector<std::uint32_t> face_smoothing_;
  std::uint32_t smoothing_ = 0;
  bool has_smoothing_ = false;

  Names names_;
  Index object_ = names_.id(""), group_ = kEmptyName, material_ = kEmptyName;
  std::array<Index, 3> current_group_{kNone, kNone, kNone};  ///< by kind; of the state in force
  std::map<GroupKey, Index> group_ids_;
  std::vector<GroupKey> groups_;
  std::uint64_t group_name_bytes_ = 0;

  WedgeTable wedges_;
  std::vector<std::string> unknown_materials_;
  std::vector<Index> group_material_;
  Model model_;
};

}  // namespace

Result<Model> obj::read_obj_in_runs(ByteView file, const ReadFile& read_file, const Limits& limits,
                                    std::size_t run_bytes) {
  return ObjReader(file, read_file, limits, run_bytes).read();
}

Result<Model> read_obj(ByteView file, const ReadFile& read_file, const Limits& limits) {
  return obj::read_obj_in_runs(file, read_file, limits, obj::kRunBytes);
}

}  // namespace pstrips::inline formats
