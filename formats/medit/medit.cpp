#include "formats/medit/medit.h"

#include <algorithm>
#include <optional>

#include "core/numbers.h"

namespace pstrips::inline formats {
namespace {

constexpr std::string_view kFirstWord = "MeshVersionFormatted";

constexpr bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

class MeditReader {
 public:
  MeditReader(ByteView file, const Limits& limits) : text_(as_text(file)), limits_(limits) {}

  Result<TetraMesh> read() {
    constexpr std::string_view kOne("\1\0\0\0\1", 5);  // of four bytes, in either order
    if (text_.starts_with(kOne.substr(0, 4)) || text_.starts_with(kOne.substr(1)))
      return fail(ErrorCode::unsupported, "the binary variant of MEDIT's format", 0);
    if (read_header() && read_sections() && check_indices()) return std::move(mesh_);
    return tl::unexpected(*error_);
  }

 private:
  // Words.

  // The next word, or an empty one at the end. Keeps where it begins in at_.
  std::string_view word() {
    for (at_ = next_; at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '#');) {
      if (text_[at_] == '#')
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      else
        ++at_;
    }
    for (next_ = at_; next_ < text_.size() && !is_space(text_[next_]) && text_[next_] != '#';)
      ++next_;
    return text_.substr(at_, next_ - at_);
  }

  template <class T>
  bool number(T& value) {
    const std::string_view token = word();
    if (token.empty()) return refuse(ErrorCode::truncated, "ends within a section");
    if (parse_number(token, value)) return true;
    const bool is_cut = next_ == text_.size() && parse_number(std::string(token) + '0', value);
    return is_cut ? refuse(ErrorCode::truncated, "ends within a number")
                  : refuse(ErrorCode::corrupt, "not a number of this kind");
  }

  bool refuse(ErrorCode code, std::string message) { return refuse_at(code, message, at_); }
  bool refuse_at(ErrorCode code, std::string message, std::size_t offset) {
    const auto before = text_.substr(0, offset);
    const auto line = 1 + std::ranges::count(before, '\n');
    error_ = Error{code, std::move(message), offset, "line " + std::to_string(line)};
    return false;
  }

  // Sections.

  bool read_header() {
    const std::string_view first = word();
    if (first != kFirstWord) {
      const bool is_cut = next_ == text_.size() && kFirstWord.starts_with(first);
      return refuse(is_cut ? ErrorCode::truncated : ErrorCode::corrupt,
                    "does not begin as a MEDIT file");
    }
    Index version = 0;
    return number(version);
  }

  bool read_sections() {
    for (;;) {
      const std::string_view keyword = word();
      if (keyword.empty() || keyword == "End") return true;
      if (!is_letter(keyword.front()))
        return refuse(ErrorCode::corrupt, "a number where a keyword belongs");
      if (keyword == "Dimension"    ? !read_dimension()
          : keyword == "Vertices"   ? !read_vertices()
          : keyword == "Tetrahedra" ? !read_tetrahedra()
                                    : !skip_section())
        return false;
    }
  }

  bool skip_section() {
    for (;;) {
      const std::string_view token = word();
      double value = 0;
      if (!token.empty() && (!is_letter(token.front()) || parse_number(token, value))) continue;
      next_ = at_;
      return true;
    }
  }

  bool read_dimension() {
    if (has_dimension_) return refuse(ErrorCode::corrupt, "a second dimension");
    Index dimension = 0;
    if (!number(dimension)) return false;
    if (dimension == 2) return refuse(ErrorCode::unsupported, "a mesh of two dimensions");
    if (dimension != 3) return refuse(ErrorCode::corrupt, "neither two nor three dimensions");
    return has_dimension_ = true;
  }

  // A count of rows of `columns` words, which must be there.
  bool read_count(std::uint64_t columns, std::uint64_t limit, Index& count) {
    if (!number(count)) return false;
    if (count * columns > limit || count > kMaxCount / columns)
      return refuse(ErrorCode::over_limit, "more than the limit allows");
    constexpr std::uint64_t kLeastBytes = 2;  // a digit and a space
    if (count * columns * kLeastBytes > text_.size() - next_ + 1)
      return refuse(ErrorCode::truncated, "ends within a section");
    memory_ += count * columns * sizeof(double);
    return memory_ <= limits_.memory_bytes ||
           refuse(ErrorCode::over_limit, "needs more memory than the limit allows");
  }
  // The last word of a row.
  bool read_reference() {
    double ignored = 0;
    return number(ignored);
  }

  bool read_vertices() {
    if (has_vertices_) return refuse(ErrorCode::corrupt, "vertices twice");
    if (!has_dimension_) return refuse(ErrorCode::corrupt, "vertices before the dimension");
    has_vertices_ = true;
    Index count = 0;
    if (!read_count(4, 4 * limits_.vertices, count)) return false;
    mesh_.positions.resize(std::size_t{3} * count);
    for (std::size_t i = 0; i < mesh_.positions.size(); i += 3)
      if (!number(mesh_.positions[i]) || !number(mesh_.positions[i + 1]) ||
          !number(mesh_.positions[i + 2]) || !read_reference())
        return false;
    return true;
  }

  bool read_tetrahedra() {
    if (has_tetrahedra_) return refuse(ErrorCode::corrupt, "tetrahedra twice");
    has_tetrahedra_ = true;
    Index count = 0;
    if (!read_count(5, limits_.corners, count)) return false;
    mesh_.tetrahedra.resize(std::size_t{4} * count);
    for (std::size_t i = 0; i < mesh_.tetrahedra.size(); ++i) {
      Index& vertex = mesh_.tetrahedra[i];
      if (!number(vertex)) return false;
      if (vertex == 0) return refuse(ErrorCode::corrupt, "vertices count from 1");
      if (vertex > largest_) {
        largest_ = vertex;
        largest_at_ = at_;
      }
      --vertex;
      if (i % 4 == 3 && !read_reference()) return false;
    }
    return true;
  }

  // Vertices may come after tetrahedra.
  bool check_indices() {
    return largest_ <= mesh_.vertex_count() ||
           refuse_at(ErrorCode::corrupt, "names a vertex that is not there", largest_at_);
  }

  std::string_view text_;
  const Limits& limits_;
  std::size_t at_ = 0, next_ = 0;  // where the present word begins and ends
  std::optional<Error> error_;
  bool has_dimension_ = false, has_vertices_ = false, has_tetrahedra_ = false;
  std::uint64_t memory_ = 0;
  Index largest_ = 0;  // vertex named
  std::size_t largest_at_ = 0;
  TetraMesh mesh_;
};

}  // namespace

bool looks_like_medit(ByteView file) {
  std::string_view text = as_text(file).substr(0, 4096);
  while (!text.empty() && (is_space(text.front()) || text.front() == '#'))
    text.remove_prefix(text.front() == '#' ? std::min(text.find('\n'), text.size()) : 1);
  return text.starts_with(kFirstWord);
}

Result<TetraMesh> read_medit(ByteView file, const Limits& limits) {
  return MeditReader(file, limits).read();
}

Bytes write_tetra_strips(const TetraStrips& strips) {
  std::string out = "TetraStrips 1\n";
  std::size_t begins = 0;  // entries left of a strip's first tetrahedron
  bool is_first = true;
  for (std::size_t i = 0; i < strips.vertices.size(); ++i) {
    if (strips.replaced[i] == 0 && begins == 0) {
      if (!is_first) out += '\n';
      is_first = false;
      begins = 4;
    } else {
      out += ' ';
    }
    if (strips.replaced[i] == 0)
      --begins;
    else
      out.append(1, static_cast<char>('0' + strips.replaced[i])) += ':';
    out += std::to_string(std::uint64_t{strips.vertices[i]} + 1);
  }
  if (!is_first) out += '\n';
  const ByteView bytes = as_bytes(out);
  return {bytes.begin(), bytes.end()};
}

}  // namespace pstrips::inline formats
