#include <algorithm>
#include <optional>

#include "formats/pstrip/numbers.h"
#include "formats/pstrip/text/face_finder.h"
#include "formats/pstrip/text/text.h"

namespace pstrips::inline formats {
namespace {

constexpr std::string_view kHeader = "# pstrips text ";

/// Words of a file with their positions; the first failure sticks and ends the words.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word; empty at the end, which `needed` makes an error.
  std::string_view next(bool needed = true) {
    while (at_ < text_.size() && is_xml_space(text_[at_])) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    }
    word_ = at_;
    while (at_ < text_.size() && !is_xml_space(text_[at_])) ++at_;
    // A word that nothing follows may have been cut.
    if (at_ == text_.size() && (needed || word_ < at_))
      fail(ErrorCode::truncated, "ends inside a line");
    return error_ ? std::string_view() : text_.substr(word_, at_ - word_);
  }
  void skip_line() {
    at_ = std::min(text_.find('\n', at_), text_.size());
    if (at_ == text_.size()) fail(ErrorCode::truncated, "ends inside a line");
  }
  std::string_view line_from(std::size_t start) const {
    return text_.substr(start, text_.find('\n', start) - start);
  }
  std::size_t word_start() const { return word_; }

  bool fail(ErrorCode code, const char* message) {
    if (!error_) error_ = Error{code, message, word_, "line " + std::to_string(line_)};
    at_ = word_ = text_.size();
    return false;
  }
  bool ok() const { return !error_; }
  const std::optional<Error>& error() const { return error_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0, word_ = 0;
  std::uint64_t line_ = 1;
  std::optional<Error> error_;
};

/// What the header comment announces.
struct Announced {
  bool counts = false;
  Index vertices = 0, faces = 0, vsplits = 0;
};

class Parser {
 public:
  Parser(ByteView file, const Limits& limits)
      : words_(as_text(file)), limits_(limits), finder_(fingerprint(file)) {}

  Result<TextProgressive> parse() {
    texture_.semantic = "TEXCOORD_0";
    texture_.count = 2;
    while (words_.ok() && statement()) {
    }
    if (words_.ok()) check_announced();
    if (!words_.ok()) return tl::unexpected<Error>(*words_.error());
    return result();
  }

 private:
  enum class Textured : std::uint8_t { unknown, no, yes };

  /// One comment, base line or record. False at the end of the file.
  bool statement() {
    const std::string_view word = words_.next(false);
    if (word.empty()) return false;
    if (word.front() == '#') return comment();
    if (word == "s") return record();
    const bool base = word == "v" || word == "vt" || word == "f";
    if (!base) return words_.fail(ErrorCode::corrupt, "line of an unknown kind");
    if (!collapses_.empty())
      return words_.fail(ErrorCode::corrupt, "line of the base after a record");
    if (word == "v") return vertex();
    return word == "vt" ? coordinates(texture_.data) : face();
  }

  bool comment() {
    if (words_.word_start() == 0) {
      const std::string_view line = words_.line_from(0);
      if (line.starts_with(kHeader) && !header(line.substr(kHeader.size()))) return false;
    }
    words_.skip_line();
    return words_.ok();
  }

  bool header(std::string_view line) {
    Tokens tokens(line);
    const std::string_view version = tokens.next();
    if (!version.starts_with("1."))
      return words_.fail(ErrorCode::unsupported, "version that this build does not know");
    announced_.counts = true;
    while (!tokens.at_end()) {
      const std::string_view token = tokens.next();
      const std::size_t equals = std::min(token.find('='), token.size());
      const std::string_view key = token.substr(0, equals);
      const std::string_view value = token.substr(std::min(equals + 1, token.size()));
      if (!header_field(key, value)) return words_.fail(ErrorCode::corrupt, "malformed header");
    }
    return true;
  }

  bool header_field(std::string_view key, std::string_view value) {
    if (key == "vertices") return parse_number(value, announced_.vertices);
    if (key == "faces") return parse_number(value, announced_.faces);
    if (key == "vsplits") return parse_number(value, announced_.vsplits);
    if (key == "position") return parse_type(value, mesh_.position.type);
    return key == "texture" && parse_type(value, texture_.type);
  }

  static bool parse_type(std::string_view word, ComponentType& out) {
    for (int i = 0; i <= static_cast<int>(ComponentType::f64); ++i)
      if (name_of(static_cast<ComponentType>(i)) == word)
        return out = static_cast<ComponentType>(i), true;
    return false;
  }

  /// Appends components of the attribute's type.
  bool components(const Attribute& format, Bytes& out) {
    const std::size_t size = size_of(format.type);
    for (std::size_t c = 0; c < format.count && words_.ok(); ++c) {
      const std::string_view word = words_.next();
      out.resize(out.size() + size);
      if (words_.ok() && !parse_component(word, format.type, out.data() + out.size() - size))
        words_.fail(ErrorCode::corrupt, "not a number of the type");
    }
    return words_.ok();
  }
  bool coordinates(Bytes& out) { return components(texture_, out); }

  bool vertex() {
    if (mesh_.position.elements() >= std::min<std::uint64_t>(limits_.vertices, kMaxCount))
      return words_.fail(ErrorCode::over_limit, "more vertices than the limit");
    return components(mesh_.position, mesh_.position.data);
  }

  /// A number from 1 to `count`, as an index.
  Index reference(std::string_view word, std::size_t count) {
    Index number = 0;
    if (words_.ok() && (!parse_number(word, number) || number == 0 || number > count))
      words_.fail(ErrorCode::corrupt, "not the number of anything there is");
    return number - 1;
  }
  Index vertex_reference() { return reference(words_.next(), mesh_.position.elements()); }
  FaceFinder::Triangle vertex_references() {
    FaceFinder::Triangle t{};
    for (Index& v : t) v = vertex_reference();
    return t;
  }
  Index count() {
    Index n = 0;
    const std::string_view word = words_.next();
    if (words_.ok() && !parse_number(word, n)) words_.fail(ErrorCode::corrupt, "not a count");
    return n;
  }

  bool set_textured(bool textured) {
    const Textured now = textured ? Textured::yes : Textured::no;
    if (textured_ != Textured::unknown && textured_ != now)
      return words_.fail(ErrorCode::corrupt, "faces with and without texture");
    textured_ = now;
    return words_.ok();
  }

  bool add_face(const FaceFinder::Triangle& t) {
    if (mesh_.corners.size() + 3 > std::min<std::uint64_t>(limits_.corners, kMaxCount))
      return words_.fail(ErrorCode::over_limit, "more corners than the limit");
    if (!words_.ok()) return false;
    finder_.insert(static_cast<Index>(mesh_.corners.size() / 3), t);
    mesh_.corners.insert(mesh_.corners.end(), t.begin(), t.end());
    return true;
  }

  bool face() {
    FaceFinder::Triangle t{};
    for (Index& v : t) {
      const std::string_view word = words_.next();
      const std::size_t slash = word.find('/');
      v = reference(word.substr(0, slash), mesh_.position.elements());
      if (!words_.ok() || !set_textured(slash != std::string_view::npos)) return false;
      if (textured_ == Textured::yes)
        slots_.push_back(reference(word.substr(slash + 1), texture_.elements()));
    }
    return add_face(t);
  }

  /// [Skabek11 §3.3]
  bool record() {
    const Index next = mesh_.vertex_count();
    const Index first = reference(words_.next(), std::size_t{next} + 1);
    Bytes moved;
    components(mesh_.position, moved);
    const Index second = reference(words_.next(), std::size_t{next} + 1);
    if (words_.ok() && second != next)
      words_.fail(ErrorCode::corrupt, "new vertex has not the next number");
    if (!words_.ok() || !vertex()) return false;
    collapses_.push_back({second, first == second ? kNone : first});
    move(first, moved);
    return add_faces() && change_faces(first, second) && change_texture();
  }

  void move(Index vertex, const Bytes& to) {
    std::byte* at = mesh_.position.data.data() + vertex * mesh_.position.element_bytes();
    kept_position_.insert(kept_position_.end(), at, at + to.size());
    moves_ = moves_ || !std::equal(to.begin(), to.end(), at);
    std::copy(to.begin(), to.end(), at);
  }

  bool add_faces() {
    added_ = count();
    for (Index i = 0; i < added_ && words_.ok(); ++i) add_face(vertex_references());
    return words_.ok();
  }

  bool change_faces(Index from, Index to) {
    const Index changed = count();
    for (Index i = 0; i < changed && words_.ok(); ++i) {
      FaceFinder::Triangle t = vertex_references();
      const Index face = words_.ok() ? finder_.take(t) : kNone;
      if (face == kNone || std::ranges::find(t, from) == t.end())
        return words_.fail(ErrorCode::corrupt, "no face around the vertex has these corners");
      std::ranges::replace(t, from, to);
      std::replace(mesh_.corners.begin() + 3 * std::ptrdiff_t{face},
                   mesh_.corners.begin() + 3 * std::ptrdiff_t{face} + 3, from, to);
      finder_.insert(face, t);
    }
    return words_.ok();
  }

  bool change_texture() {
    const Index triangles = count();
    if (words_.ok() && triangles != 0 && triangles != added_)
      return words_.fail(ErrorCode::corrupt, "not one texture triangle for each new face");
    if (added_ > 0 && !set_textured(triangles > 0)) return false;
    // They may name indices that the same record adds: those are looked at below.
    const std::size_t named = slots_.size();
    for (std::uint64_t i = 0; i < 3 * std::uint64_t{triangles} && words_.ok(); ++i)
      slots_.push_back(reference(words_.next(), kMaxCount));
    const Index fresh = count();
    for (Index i = 0; i < fresh && words_.ok(); ++i) {
      const std::size_t next = texture_.elements();
      if (reference(words_.next(), next + 1) != next)
        words_.fail(ErrorCode::corrupt, "new texture index is not the next number");
      coordinates(texture_.data);
    }
    if (words_.ok() && std::any_of(slots_.begin() + static_cast<std::ptrdiff_t>(named),
                                   slots_.end(), [&](Index s) { return s >= texture_.elements(); }))
      return words_.fail(ErrorCode::corrupt, "texture triangle names what is not there");
    const Index changed = count();
    for (Index i = 0; i < changed && words_.ok(); ++i) {
      const Index slot = reference(words_.next(), texture_.elements());
      Bytes to;
      if (coordinates(to))
        std::ranges::copy(to, texture_.data.begin() +
                                  static_cast<std::ptrdiff_t>(slot * texture_.element_bytes()));
    }
    return words_.ok();
  }

  void check_announced() {
    if (!announced_.counts) return;
    const auto vsplits = static_cast<Index>(collapses_.size());
    const Index vertices = mesh_.vertex_count(), faces = mesh_.face_count();
    if (vsplits < announced_.vsplits || vertices < announced_.vertices || faces < announced_.faces)
      words_.fail(ErrorCode::truncated, "fewer lines than the header announces");
    else if (vsplits > announced_.vsplits || vertices > announced_.vertices ||
             faces > announced_.faces)
      words_.fail(ErrorCode::corrupt, "more lines than the header announces");
  }

  TextProgressive result() {
    TextProgressive out;
    std::ranges::reverse(collapses_);
    if (moves_) out.kept_position = reversed(kept_position_, mesh_.position.element_bytes());
    if (textured_ == Textured::yes) make_wedges();
    mesh_.groups.resize(1);
    canonicalize(mesh_);
    out.mesh = std::move(mesh_);
    out.collapses = std::move(collapses_);
    return out;
  }

  static Bytes reversed(const Bytes& elements, std::size_t size) {
    Bytes out;
    out.reserve(elements.size());
    for (std::size_t end = elements.size(); end > 0; end -= size)
      out.insert(out.end(), elements.begin() + static_cast<std::ptrdiff_t>(end - size),
                 elements.begin() + static_cast<std::ptrdiff_t>(end));
    return out;
  }

  /// A wedge for each pair of vertex and texture index, and one for each vertex without a face,
  /// whose texture coordinates are zero.
  void make_wedges() {
    std::vector<std::uint64_t> pairs(mesh_.corners.size());
    std::vector<bool> used(mesh_.vertex_count());
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      pairs[c] = std::uint64_t{mesh_.corners[c]} << 32 | slots_[c];
      used[mesh_.corners[c]] = true;
    }
    std::vector<std::uint64_t> wedges = pairs;
    for (Index v = 0; v < used.size(); ++v)
      if (!used[v]) wedges.push_back(std::uint64_t{v} << 32 | kNone);
    std::ranges::sort(wedges);
    wedges.erase(std::unique(wedges.begin(), wedges.end()), wedges.end());
    for (std::size_t c = 0; c < pairs.size(); ++c)
      mesh_.corners[c] =
          static_cast<Index>(std::ranges::lower_bound(wedges, pairs[c]) - wedges.begin());
    Attribute texture = texture_;
    texture.data.assign(wedges.size() * texture.element_bytes(), std::byte{0});
    for (std::size_t w = 0; w < wedges.size(); ++w) {
      const auto slot = static_cast<Index>(wedges[w]);
      mesh_.wedge_vertex.push_back(static_cast<Index>(wedges[w] >> 32));
      if (slot != kNone)
        std::ranges::copy(
            texture_.element(slot),
            texture.data.begin() + static_cast<std::ptrdiff_t>(w * texture.element_bytes()));
    }
    mesh_.wedge_attributes.push_back(std::move(texture));
  }

  Words words_;
  const Limits& limits_;
  Announced announced_;
  Mesh mesh_;                 // corners are vertices until the end
  Attribute texture_;         // one element a texture index
  std::vector<Index> slots_;  // texture index of each corner
  Textured textured_ = Textured::unknown;
  FaceFinder finder_;
  std::vector<TextCollapse> collapses_;
  Bytes kept_position_;
  bool moves_ = false;
  Index added_ = 0;  // faces of the record that is read
};

}  // namespace

Result<TextProgressive> read_text(ByteView file, const Limits& limits) {
  if (looks_like_hoppe_pm(file))
    return fail(ErrorCode::unsupported,
                "binary progressive mesh of Hoppe's library, not the text format of that name", 0);
  // Six characters can name a face, of which corners, table and list growth keep 24 times as much.
  if (file.size() > limits.memory_bytes / 24)
    return fail(ErrorCode::over_limit, "file needs more memory than the limit");
  return Parser(file, limits).parse();
}

bool looks_like_text(ByteView start) { return as_text(start).starts_with(kHeader); }

bool looks_like_hoppe_pm(ByteView start) {
  std::string_view rest = as_text(start);
  while (rest.starts_with('#')) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  return rest.starts_with("PM\nversion=");
}

}  // namespace pstrips::inline formats
