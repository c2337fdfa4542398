#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "formats/obj/census.h"
#include "formats/obj/mtl.h"
#include "formats/obj/names.h"
#include "formats/obj/numbers.h"
#include "formats/obj/obj.h"
#include "formats/obj/wedges.h"

namespace pstrip {
namespace {

using obj::Number;
using obj::WedgeTable;

// Bits of a `v` or `vt` line beside those of ObjPresent: which of its numbers fit a float.
constexpr std::uint8_t kUvFit = 1, kTexWFits = 2;

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

/// The lines of one kind that corners refer to; they may follow later in the file.
struct Referenced {
  std::uint64_t count = 0;
  std::uint64_t largest = 0;        ///< index referred to, from 1
  std::uint64_t total = kMaxCount;  ///< the largest that may be
};

/// What a file has of each attribute, its values and which of them fit a float.
struct VertexValues {
  std::vector<double> position;     ///< three a vertex
  std::vector<double> color;        ///< four a vertex, or empty: no vertex has a colour
  std::vector<double> weight;       ///< one a vertex, or empty
  std::vector<std::uint8_t> flags;  ///< of ObjPresent, one a vertex, or empty: all 0
  bool position_fits = true, color_fits = true, weight_fits = true;
};

/// A list with an element for each corner or face that stays empty until one differs from `usual`.
template <class T>
void append_sparse(std::vector<T>& list, std::size_t before, T value, T usual) {
  if (list.empty()) {
    if (value == usual) return;
    list.assign(before, usual);
  }
  list.push_back(value);
}

/// Reads statement by statement into flat arrays, then makes the mesh of them.
class ObjReader {
 public:
  ObjReader(ByteView file, const ReadFile& read_file, const Limits& limits)
      : text_(as_text(file)), read_file_(read_file), limits_(limits) {}

  Result<Model> read() {
    if (!expect_room() || !read_statements() || !check_references() || !build())
      return tl::unexpected(*error_);
    return std::move(model_);
  }

 private:
  std::uint64_t most_vertices() const {
    return std::min<std::uint64_t>(limits_.vertices, kMaxCount);
  }
  std::uint64_t most_tuples() const { return std::min<std::uint64_t>(limits_.wedges, kMaxCount); }
  std::uint64_t most_corners() const { return std::min<std::uint64_t>(limits_.corners, kMaxCount); }

  /// Refuses a text that is long enough to hold more than the limits, and does, before it is read.
  bool expect_room() {
    constexpr std::uint64_t kShortestVertex = 8;     // "v 0 0 0\n"
    constexpr std::uint64_t kShortestTuple = 5;      // "vt 0\n"
    constexpr std::uint64_t kShortestFace = 4;       // "f 1\n"
    constexpr std::uint64_t kMemoryACharacter = 12;  // of the shortest vertices
    const std::uint64_t size = text_.size();
    if (size / kShortestVertex <= most_vertices() && size / kShortestTuple <= most_tuples() &&
        size / kShortestFace <= most_corners() && size * kMemoryACharacter <= limits_.memory_bytes)
      return true;
    const obj::Census census = obj::take_census(text_);
    const auto over = [&](std::uint64_t figure, std::string_view what, std::uint64_t limit) {
      return figure > limit &&
             !refuse_at(ErrorCode::over_limit, over_limit_message(figure, what, limit), 0);
    };
    return !over(census.vertices, "vertices", most_vertices()) &&
           !over(census.tuples, "vt and vn lines", 2 * most_tuples()) &&
           !over(census.faces, "face corners", most_corners()) &&
           !over(census.vertices * kVertexBytes + census.tuples * kTupleBytes +
                     census.faces * kCornerBytes,
                 "bytes of memory", limits_.memory_bytes);
  }

  // Lines.

  bool read_statements() {
    constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
    std::size_t at = text_.starts_with(kUtf8Mark) ? kUtf8Mark.size() : 0;
    const char line_end = text_.find('\n') == text_.npos ? '\r' : '\n';
    while (at < text_.size()) {
      std::size_t end = std::min(text_.find(line_end, at), text_.size());
      std::string_view line = text_.substr(at, end - at);
      line_at_ = at;
      at_last_ = end == text_.size();
      if (is_continued(line) && !obj::trimmed(line).starts_with('#')) {
        end = join_lines(end, line_end);
        line = joined_;
      }
      begin_ = p_ = line.data();
      end_ = p_ + line.size();
      if (!read_statement()) return false;
      if (charged_ > limits_.memory_bytes)
        return refuse(ErrorCode::over_limit,
                      over_limit_message(charged_, "bytes of memory", limits_.memory_bytes));
      at = end + 1;
    }
    if (!statements_ && first_unknown_)
      return refuse_at(ErrorCode::corrupt, "has no statement of an OBJ file", *first_unknown_);
    return true;
  }

  static bool is_continued(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line.ends_with('\\');
  }

  /// Joins a line with those that continue it into joined_, blanks in place of the line ends, so
  /// that positions stay what they are. Returns the end of the last one.
  std::size_t join_lines(std::size_t end, char line_end) {
    joined_.assign(text_.substr(line_at_, end - line_at_));
    while (is_continued(joined_)) {
      joined_[joined_.find_last_of('\\')] = ' ';
      if (end == text_.size()) break;
      const std::size_t next = std::min(text_.find(line_end, end + 1), text_.size());
      joined_ += ' ';
      joined_ += text_.substr(end + 1, next - end - 1);
      end = next;
    }
    at_last_ = end == text_.size();
    return end;
  }

  void skip_space() {
    while (p_ != end_ && obj::is_space(*p_)) ++p_;
  }
  bool at_end() {
    skip_space();
    return p_ == end_ || *p_ == '#';
  }
  std::string_view rest() const { return {p_, static_cast<std::size_t>(end_ - p_)}; }

  // Errors.

  bool refuse_at(ErrorCode code, std::string message, std::uint64_t offset) {
    const auto before = text_.substr(0, offset);
    const char line_end = text_.find('\n') == text_.npos ? '\r' : '\n';
    const auto line = 1 + std::ranges::count(before, line_end);
    error_ = Error{code, std::move(message), offset, "line " + std::to_string(line)};
    return false;
  }
  std::uint64_t offset() const { return line_at_ + static_cast<std::size_t>(p_ - begin_); }
  bool refuse(ErrorCode code, std::string message) {
    return refuse_at(code, std::move(message), offset());
  }
  /// For a statement that stops too early: more bytes mend the last line of a file.
  bool refuse_short(std::string message) {
    const bool cut = at_last_ && p_ == end_;
    return refuse(cut ? ErrorCode::truncated : ErrorCode::corrupt, std::move(message));
  }

  // Statements.

  bool read_statement() {
    skip_space();
    if (p_ == end_) return true;
    const char* const word_begin = p_;
    if (*p_ == '#') return read_comment();
    while (p_ != end_ && !obj::is_space(*p_)) ++p_;
    const std::string_view word(word_begin, static_cast<std::size_t>(p_ - word_begin));
    header_ended_ = true;
    if (word == "v") return known() && read_vertex();
    if (word == "f" || word == "fo") return known() && read_face(FaceKind::polygons);
    if (word == "vt") return known() && read_texcoord();
    if (word == "vn") return known() && read_normal();
    if (word == "l") return known() && read_face(FaceKind::lines);
    if (word == "p") return known() && read_face(FaceKind::points);
    if (word == "g") return known() && set_name(group_, obj::clean_group(rest()));
    if (word == "o") return known() && set_name(object_, obj::clean_name(rest()));
    if (word == "usemtl") return known() && set_name(material_, obj::clean_name(rest()));
    if (word == "s" && read_smoothing()) return known();
    if (word == "mtllib") return known() && read_mtllib();
    p_ = word_begin;
    if (!first_unknown_) first_unknown_ = offset();
    return keep_line(notes_, rest());
  }

  bool known() { return statements_ = true; }

  bool read_comment() {
    constexpr std::string_view kNote = "# note: ";
    if (rest().starts_with(kNote)) return keep_line(notes_, rest().substr(kNote.size()));
    return header_ended_ || keep_line(header_, rest());
  }

  bool keep_line(std::string& lines, std::string_view line) {
    line = obj::trimmed(line);
    if (lines.size() + line.size() >= limits_.string_bytes)
      return refuse(ErrorCode::over_limit, "more text beside the mesh than the limit allows");
    lines.append(line) += '\n';
    return true;
  }

  /// Reads the numbers of a statement up to its end; refuses fewer than `least` or more than fit.
  template <std::size_t n>
  bool read_numbers(std::array<Number, n>& numbers, std::size_t least, std::size_t& count) {
    for (count = 0; !at_end(); ++count) {
      if (count == n) return refuse(ErrorCode::corrupt, "more numbers than the statement takes");
      const char* const next = obj::parse_number(p_, end_, numbers[count]);
      if (!next) return refuse(ErrorCode::corrupt, "not a number, or not in the range of a double");
      p_ = next;
    }
    return count >= least || refuse_short("fewer numbers than the statement needs");
  }

  bool read_vertex() {
    std::array<Number, 7> numbers;
    std::size_t count = 0;
    if (!read_numbers(numbers, 3, count)) return false;
    if (count == 5) return refuse(ErrorCode::corrupt, "five numbers in a vertex");
    if (vertices_.count >= most_vertices())
      return refuse(ErrorCode::over_limit,
                    over_limit_message(vertices_.count + 1, "vertices", most_vertices()));
    for (std::size_t i = 0; i < 3; ++i) {
      values_.position.push_back(numbers[i].value);
      values_.position_fits &= numbers[i].fits_f32;
    }
    std::uint8_t flags = 0;
    if (count == 4) flags = kHasWeight;
    if (count >= 6) flags = kHasColor;
    if (count == 7) flags |= kHasAlpha;
    append_sparse(values_.flags, vertices_.count, flags, std::uint8_t{0});
    if (flags & kHasWeight) {
      values_.weight.resize(vertices_.count);
      values_.weight.push_back(numbers[3].value);
      values_.weight_fits &= numbers[3].fits_f32;
    }
    if (flags & kHasColor) {
      values_.color.resize(4 * vertices_.count);
      for (std::size_t i = 3; i < 7; ++i) {
        values_.color.push_back(numbers[i].value);
        values_.color_fits &= numbers[i].fits_f32;
      }
    }
    ++vertices_.count;
    charge(kVertexBytes);
    return true;
  }

  bool read_texcoord() {
    std::array<Number, 3> numbers;
    std::size_t count = 0;
    if (!read_numbers(numbers, 1, count)) return false;
    for (const Number& number : numbers) texcoord_.push_back(number.value);
    std::uint8_t flags = kHasTexcoord;
    if (count >= 2) flags |= kHasTexV;
    if (count == 3) flags |= kHasTexW;
    texcoord_flags_.push_back(flags);
    const bool uv_fit = numbers[0].fits_f32 && numbers[1].fits_f32;
    texcoord_fits_.push_back(
        static_cast<std::uint8_t>((uv_fit ? kUvFit : 0) | (numbers[2].fits_f32 ? kTexWFits : 0)));
    ++texcoords_.count;
    return check_tuple_count(texcoords_.count);
  }

  bool read_normal() {
    std::array<Number, 3> numbers;
    std::size_t count = 0;
    if (!read_numbers(numbers, 3, count)) return false;
    bool fits = true;
    for (const Number& number : numbers) {
      normal_.push_back(number.value);
      fits &= number.fits_f32;
    }
    normal_fits_.push_back(fits);
    ++normals_.count;
    return check_tuple_count(normals_.count);
  }

  bool check_tuple_count(std::uint64_t count) {
    charge(kTupleBytes);
    return count <= most_tuples() ||
           refuse(ErrorCode::over_limit,
                  over_limit_message(count, "vt or vn lines", most_tuples()));
  }

  bool read_face(FaceKind kind) {
    const std::size_t first = corner_vertex_.size();
    while (!at_end()) {
      if (!read_corner()) return false;
      if (kind == FaceKind::points) end_face(kind);
    }
    const std::size_t corners = corner_vertex_.size() - first;
    if (corners == 0) return refuse_short("an element without a corner");
    if (corner_vertex_.size() > most_corners())
      return refuse(ErrorCode::over_limit,
                    over_limit_message(corner_vertex_.size(), "face corners", most_corners()));
    if (kind != FaceKind::points) end_face(kind);
    charge(corners * kCornerBytes);
    return error_ == std::nullopt;
  }

  /// v, v/vt, v//vn or v/vt/vn, where "v/" and "v//" occur and mean v.
  bool read_corner() {
    Index v = kNone, vt = kNone, vn = kNone;
    if (!read_index(vertices_, v)) return false;
    if (p_ != end_ && *p_ == '/') {
      ++p_;
      if (!at_corner_part_end() && !read_index(texcoords_, vt)) return false;
      if (p_ != end_ && *p_ == '/') {
        ++p_;
        if (!at_corner_part_end() && !read_index(normals_, vn)) return false;
      }
    }
    if (p_ != end_ && !obj::is_space(*p_)) return refuse(ErrorCode::corrupt, "not a face corner");
    append_sparse(corner_texcoord_, corner_vertex_.size(), vt, kNone);
    append_sparse(corner_normal_, corner_vertex_.size(), vn, kNone);
    corner_vertex_.push_back(v);
    return true;
  }

  bool at_corner_part_end() const { return p_ == end_ || *p_ == '/' || obj::is_space(*p_); }

  /// A reference to the lines of one kind: from 1, or from -1 back from the newest.
  bool read_index(Referenced& lines, Index& index) {
    const char* const start = p_;
    const bool relative = p_ != end_ && *p_ == '-';
    if (relative) ++p_;
    constexpr std::uint64_t kPastAll = std::uint64_t{1} << 40;
    std::uint64_t value = 0;
    const char* const digits = p_;
    for (; p_ != end_ && *p_ >= '0' && *p_ <= '9'; ++p_)
      value = std::min(10 * value + static_cast<std::uint64_t>(*p_ - '0'), kPastAll);
    if (p_ == digits)
      return relative ? refuse_short("not an index") : refuse(ErrorCode::corrupt, "not an index");
    const bool in_range = value != 0 && value <= (relative ? lines.count : lines.total);
    if (!in_range) {
      p_ = start;
      return refuse(ErrorCode::corrupt, value == 0 ? "index 0" : "index out of range");
    }
    if (relative) value = lines.count + 1 - value;
    lines.largest = std::max(lines.largest, value);
    index = static_cast<Index>(value - 1);
    return true;
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
    if (!has_smoothing_) face_smoothing_.assign(face_first_.size() - 1, 0);
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
    face_first_.push_back(static_cast<Index>(corner_vertex_.size()));
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
    const auto in_range = [](const Referenced& lines) { return lines.largest <= lines.count; };
    if (in_range(vertices_) && in_range(texcoords_) && in_range(normals_)) return true;
    const ReadFile no_file;
    ObjReader second(as_bytes(text_), no_file, limits_);
    second.vertices_.total = vertices_.count;
    second.texcoords_.total = texcoords_.count;
    second.normals_.total = normals_.count;
    second.read_statements();
    error_ = std::move(second.error_);
    return false;
  }

  bool build() {
    count_unused_tuples();
    // Wedges are numbered in 32 bits.
    if (const std::uint64_t most = corner_vertex_.size() + vertices_.count; most > kMaxCount)
      return refuse_at(ErrorCode::over_limit,
                       over_limit_message(most, "corners and vertices", kMaxCount), 0);
    WedgeTable wedges = obj::build_wedges({.vertex_count = static_cast<Index>(vertices_.count),
                                           .corner_vertex = corner_vertex_,
                                           .corner_texcoord = corner_texcoord_,
                                           .corner_normal = corner_normal_,
                                           .texcoord = texcoord_,
                                           .texcoord_flags = texcoord_flags_,
                                           .normal = normal_});
    if (wedges.vertex.size() > most_tuples())
      return refuse_at(ErrorCode::over_limit,
                       over_limit_message(wedges.vertex.size(), "wedges", most_tuples()), 0);
    wedges_ = std::move(wedges);
    if (corner_vertex_.empty()) take_cloud_attributes();

    Mesh& mesh = model_.meshes.emplace_back();
    mesh.position =
        attribute("POSITION", values_.position_fits, 3, vertices_.count,
                  [&](std::size_t v, std::size_t c) { return values_.position[3 * v + c]; });
    add_wedge_attributes(mesh);
    mesh.wedge_vertex = std::move(wedges_.vertex);
    mesh.corners = std::move(wedges_.corners);
    mesh.face_first = std::move(face_first_);
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
    if (normals_.count == vertices_.count)
      std::iota(wedges_.normal.begin(), wedges_.normal.end(), 0u);
    if (texcoords_.count == vertices_.count)
      std::iota(wedges_.texcoord.begin(), wedges_.texcoord.end(), 0u);
  }

  void count_unused_tuples() {
    note_unused("vt", texcoords_.count, corner_texcoord_);
    note_unused("vn", normals_.count, corner_normal_);
  }

  void note_unused(std::string_view kind, std::uint64_t count, const std::vector<Index>& used) {
    if (count == 0 || (corner_vertex_.empty() && count == vertices_.count)) return;
    std::vector<bool> is_used(count);
    for (const Index i : used)
      if (i != kNone) is_used[i] = true;
    const auto unused = std::ranges::count(is_used, false);
    if (unused > 0) notes_ += std::to_string(unused) + " unused " + std::string(kind) + " lines\n";
  }

  /// Which of ObjPresent wedge w has, by the lines it was made of.
  std::uint8_t present(std::size_t w) const {
    std::uint8_t flags = values_.flags.empty() ? 0 : values_.flags[wedges_.vertex[w]];
    if (wedges_.texcoord[w] != kNone) flags |= texcoord_flags_[wedges_.texcoord[w]];
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
    const bool plain = values_.flags.empty() && corner_texcoord_.empty() &&
                       corner_normal_.empty() && !corner_vertex_.empty();
    if (plain) return;
    std::vector<std::uint8_t> flags(n);
    std::uint8_t any = 0;
    bool uv_fit = true, w_fit = true, normal_fit = true;
    for (std::size_t w = 0; w < n; ++w) {
      any |= flags[w] = present(w);
      if (const Index vt = wedges_.texcoord[w]; vt != kNone) {
        uv_fit &= (texcoord_fits_[vt] & kUvFit) != 0;
        w_fit &= (texcoord_fits_[vt] & kTexWFits) != 0;
      }
      if (const Index vn = wedges_.normal[w]; vn != kNone) normal_fit &= normal_fits_[vn] != 0;
    }
    std::vector<Attribute>& out = mesh.wedge_attributes;
    const auto value_of = [](const std::vector<double>& values, std::size_t width, Index i,
                             std::size_t c) { return i == kNone ? 0.0 : values[width * i + c]; };
    if (any & kHasNormal)
      out.push_back(attribute("NORMAL", normal_fit, 3, n, [&](std::size_t w, std::size_t c) {
        return value_of(normal_, 3, wedges_.normal[w], c);
      }));
    if (any & kHasTexcoord)
      out.push_back(attribute("TEXCOORD_0", uv_fit, 2, n, [&](std::size_t w, std::size_t c) {
        return value_of(texcoord_, 3, wedges_.texcoord[w], c);
      }));
    values_.color.resize(any & kHasColor ? 4 * vertices_.count : 0);
    if (any & kHasColor)
      out.push_back(attribute("COLOR_0", values_.color_fits, any & kHasAlpha ? 4 : 3, n,
                              [&](std::size_t w, std::size_t c) {
                                return values_.color[std::size_t{4} * wedges_.vertex[w] + c];
                              }));
    values_.weight.resize(any & kHasWeight ? vertices_.count : 0);
    if (any & kHasWeight)
      out.push_back(
          attribute(kObjWeight, values_.weight_fits, 1, n,
                    [&](std::size_t w, std::size_t) { return values_.weight[wedges_.vertex[w]]; }));
    if (any & kHasTexW)
      out.push_back(attribute(kObjTexW, w_fit, 1, n, [&](std::size_t w, std::size_t) {
        return value_of(texcoord_, 3, wedges_.texcoord[w], 2);
      }));
    add_presence(mesh, std::move(flags), any);
  }

  /// The mask is there when a wedge lacks something that others have. What a file can only say
  /// of corners is not missed in a wedge without one.
  void add_presence(Mesh& mesh, std::vector<std::uint8_t> flags, std::uint8_t any) {
    if (any & kHasTexcoord) any |= kHasTexV;
    constexpr std::uint8_t kOfVertex = kHasColor | kHasAlpha | kHasWeight;
    const auto misses = [&](std::size_t w) {
      const std::uint8_t mask = wedges_.has_corner(w) || corner_vertex_.empty() ? 0xff : kOfVertex;
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

  // What the arrays take for one of each, with the mesh that is made of them.
  static constexpr std::uint64_t kVertexBytes = 96, kTupleBytes = 32, kCornerBytes = 36,
                                 kNameBytes = 160;
  // All group names together may be so many times the file's size, and a little more.
  static constexpr std::uint64_t kNameGrowth = 16, kShortNames = 1u << 16;
  void charge(std::uint64_t bytes) { charged_ += bytes; }

  using GroupKey = std::tuple<Index, Index, Index, FaceKind>;  ///< object, group, material, kind
  static constexpr Index kEmptyName = 0;

  std::string_view text_;
  const ReadFile& read_file_;
  const Limits& limits_;
  std::optional<Error> error_;
  std::uint64_t charged_ = 0;

  // The current line.
  const char *begin_ = nullptr, *p_ = nullptr, *end_ = nullptr;
  std::size_t line_at_ = 0;  ///< offset of begin_
  bool at_last_ = false;     ///< no line end follows
  std::string joined_;

  bool header_ended_ = false, statements_ = false;
  std::optional<std::uint64_t> first_unknown_;
  std::string header_, notes_, missing_, mtl_;
  std::set<std::string> missing_names_;
  std::map<std::string, bool> companions_;  ///< by path; whether it could be read

  Referenced vertices_, texcoords_, normals_;
  VertexValues values_;
  std::vector<double> texcoord_, normal_;  ///< three a line
  std::vector<std::uint8_t> texcoord_flags_, texcoord_fits_, normal_fits_;
  std::vector<Index> corner_vertex_, corner_texcoord_, corner_normal_;
  std::vector<Index> face_first_{0}, face_group_;
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

Result<Model> read_obj(ByteView file, const ReadFile& read_file, const Limits& limits) {
  return ObjReader(file, read_file, limits).read();
}

}  // namespace pstrip
