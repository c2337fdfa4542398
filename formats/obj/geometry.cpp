#include "formats/obj/geometry.h"

#include <algorithm>
#include <array>

#include "formats/obj/obj.h"

namespace pstrips::inline formats::obj {
namespace {

/// A list with an element for each corner or vertex that stays empty until one differs from
/// `usual`.
template <class T>
void append_sparse(std::vector<T>& list, std::size_t before, T value, T usual) {
  if (list.empty()) {
    if (value == usual) return;
    list.assign(before, usual);
  }
  list.push_back(value);
}

/// The same for elements [from, to) of another such list.
template <class T>
void append_sparse(std::vector<T>& list, std::size_t before, const std::vector<T>& more,
                   std::size_t from, std::size_t to, T usual) {
  const auto part = more.empty() ? std::span<const T>() : std::span(more).subspan(from, to - from);
  if (list.empty()) {
    if (std::ranges::all_of(part, [&](T value) { return value == usual; })) return;
    list.assign(before, usual);
  }
  if (part.empty())
    list.resize(before + to - from, usual);
  else
    list.insert(list.end(), part.begin(), part.end());
}

template <class T>
void append_part(std::vector<T>& list, const std::vector<T>& more, std::size_t from,
                 std::size_t to) {
  list.insert(list.end(), more.begin() + static_cast<std::ptrdiff_t>(from),
              more.begin() + static_cast<std::ptrdiff_t>(to));
}

/// Appends to a list of `width` values a vertex that ends with the last vertex that has some.
void append_values(std::vector<double>& list, std::size_t before, const std::vector<double>& more,
                   std::size_t from, std::size_t to, std::size_t width) {
  to = std::min(to, more.size() / width);
  if (from >= to) return;
  list.resize(width * before);
  append_part(list, more, width * from, width * to);
}

/// Reads the numbers of a statement up to its end; refuses fewer than `least` or more than fit.
template <std::size_t n>
bool read_numbers(Cursor& cursor, std::array<Number, n>& numbers, std::size_t least,
                  std::size_t& count) {
  for (count = 0; !cursor.at_end(); ++count) {
    if (count == n)
      return cursor.refuse(ErrorCode::corrupt, "more numbers than the statement takes");
    const char* const next = parse_number(cursor.p, cursor.end, numbers[count]);
    if (!next) {
      const std::string_view rest = cursor.rest();
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r"));
      return cursor.refuse(ErrorCode::corrupt, word.find(',') == word.npos
                                                   ? "not a number, or not in the range of a double"
                                                   : "a decimal comma; OBJ has points");
    }
    cursor.p = next;
  }
  return count >= least || cursor.refuse_short("fewer numbers than the statement needs");
}

bool check_tuple_count(Cursor& cursor, std::uint64_t count, const Limits& limits) {
  return count <= max_tuples(limits) ||
         cursor.refuse(ErrorCode::over_limit,
                       over_limit_message(count, "vt or vn lines", max_tuples(limits)));
}

bool at_part_end(const Cursor& cursor) {
  return cursor.p == cursor.end || *cursor.p == '/' || is_space(*cursor.p);
}

/// A reference to the lines of one kind: from 1, or from -1 back from the newest. One that leads
/// nowhere is an error, or leaves `index` as it is and is counted.
bool read_index(Cursor& cursor, Referenced& lines, bool may_miss, Index& index) {
  const char *p = cursor.p, *const end = cursor.end;
  const bool relative = p != end && *p == '-';
  p += relative;
  constexpr std::uint64_t kPastAll = std::uint64_t{1} << 40;
  std::uint64_t value = 0;
  const char* const digits = p;
  for (; p != end && *p >= '0' && *p <= '9'; ++p)
    if (value < kPastAll) value = 10 * value + static_cast<std::uint64_t>(*p - '0');
  if (p == digits) {
    cursor.p = p;
    return relative ? cursor.refuse_short("not an index")
                    : cursor.refuse(ErrorCode::corrupt, "not an index");
  }
  const bool misses = value == 0 || value > (relative ? lines.count : lines.total);
  if (misses && may_miss) {
    ++lines.missing;
    cursor.p = p;
    return true;
  }
  if (misses)
    return cursor.refuse(ErrorCode::corrupt, value == 0 ? "index 0" : "index out of range");
  if (relative) value = lines.count + 1 - value;
  lines.largest = std::max(lines.largest, value);
  index = static_cast<Index>(value - 1);
  cursor.p = p;
  return true;
}

}  // namespace

std::uint64_t Geometry::bytes() const {
  return vertices.count * kVertexBytes + (texcoords.count + normals.count) * kTupleBytes +
         corner_vertex.size() * kCornerBytes;
}

bool Cursor::refuse(ErrorCode with, std::string what) {
  code = with;
  message = std::move(what);
  return false;
}

bool Cursor::refuse_short(std::string what) {
  const bool cut = at_last && p == end;
  return refuse(cut ? ErrorCode::truncated : ErrorCode::corrupt, std::move(what));
}

bool read_vertex(Cursor& cursor, Geometry& out, const Limits& limits) {
  std::array<Number, 7> numbers;
  std::size_t count = 0;
  if (!read_numbers(cursor, numbers, 3, count)) return false;
  if (count == 5) return cursor.refuse(ErrorCode::corrupt, "five numbers in a vertex");
  Referenced& vertices = out.vertices;
  VertexValues& values = out.values;
  if (vertices.count >= max_vertices(limits))
    return cursor.refuse(ErrorCode::over_limit,
                         over_limit_message(vertices.count + 1, "vertices", max_vertices(limits)));
  for (std::size_t i = 0; i < 3; ++i) {
    values.position.push_back(numbers[i].value);
    values.position_fits &= numbers[i].fits_f32;
  }
  std::uint8_t flags = 0;
  if (count == 4) flags = kHasWeight;
  if (count >= 6) flags = kHasColor;
  if (count == 7) flags |= kHasAlpha;
  append_sparse(values.flags, vertices.count, flags, std::uint8_t{0});
  if (flags & kHasWeight) {
    values.weight.resize(vertices.count);
    values.weight.push_back(numbers[3].value);
    values.weight_fits &= numbers[3].fits_f32;
  }
  if (flags & kHasColor) {
    values.color.resize(4 * vertices.count);
    for (std::size_t i = 3; i < 7; ++i) {
      values.color.push_back(numbers[i].value);
      values.color_fits &= numbers[i].fits_f32;
    }
  }
  ++vertices.count;
  return true;
}

bool read_texcoord(Cursor& cursor, Geometry& out, const Limits& limits) {
  std::array<Number, 3> numbers;
  std::size_t count = 0;
  if (!read_numbers(cursor, numbers, 1, count)) return false;
  for (const Number& number : numbers) out.texcoord.push_back(number.value);
  std::uint8_t flags = kHasTexcoord;
  if (count >= 2) flags |= kHasTexV;
  if (count == 3) flags |= kHasTexW;
  out.texcoord_flags.push_back(flags);
  const bool uv_fit = numbers[0].fits_f32 && numbers[1].fits_f32;
  out.texcoord_fits.push_back(
      static_cast<std::uint8_t>((uv_fit ? kUvFit : 0) | (numbers[2].fits_f32 ? kTexWFits : 0)));
  return check_tuple_count(cursor, ++out.texcoords.count, limits);
}

bool read_normal(Cursor& cursor, Geometry& out, const Limits& limits) {
  std::array<Number, 3> numbers;
  std::size_t count = 0;
  if (!read_numbers(cursor, numbers, 3, count)) return false;
  bool fits = true;
  for (const Number& number : numbers) {
    out.normal.push_back(number.value);
    fits &= number.fits_f32;
  }
  out.normal_fits.push_back(fits);
  return check_tuple_count(cursor, ++out.normals.count, limits);
}

bool read_corner(Cursor& cursor, Geometry& out) {
  Index v = kNone, vt = kNone, vn = kNone;
  if (!read_index(cursor, out.vertices, false, v)) return false;
  if (cursor.p != cursor.end && *cursor.p == '/') {
    ++cursor.p;
    if (!at_part_end(cursor) && !read_index(cursor, out.texcoords, true, vt)) return false;
    if (cursor.p != cursor.end && *cursor.p == '/') {
      ++cursor.p;
      if (!at_part_end(cursor) && !read_index(cursor, out.normals, true, vn)) return false;
    }
  }
  if (cursor.p != cursor.end && !is_space(*cursor.p))
    return cursor.refuse(ErrorCode::corrupt, "not a face corner");
  append_sparse(out.corner_texcoord, out.corner_vertex.size(), vt, kNone);
  append_sparse(out.corner_normal, out.corner_vertex.size(), vn, kNone);
  out.corner_vertex.push_back(v);
  return true;
}

Extent extent_of(const Geometry& geometry) {
  return {geometry.vertices.count, geometry.texcoords.count, geometry.normals.count,
          geometry.corner_vertex.size(), geometry.face_first.size() - 1};
}

void append(Geometry& all, const Geometry& more, const Extent& from, const Extent& to) {
  const Extent before = extent_of(all);
  append_part(all.values.position, more.values.position, 3 * from.vertices, 3 * to.vertices);
  append_values(all.values.color, before.vertices, more.values.color, from.vertices, to.vertices,
                4);
  append_values(all.values.weight, before.vertices, more.values.weight, from.vertices, to.vertices,
                1);
  append_sparse(all.values.flags, before.vertices, more.values.flags, from.vertices, to.vertices,
                std::uint8_t{0});
  all.values.position_fits &= more.values.position_fits;
  all.values.color_fits &= more.values.color_fits;
  all.values.weight_fits &= more.values.weight_fits;

  append_part(all.texcoord, more.texcoord, 3 * from.texcoords, 3 * to.texcoords);
  append_part(all.texcoord_flags, more.texcoord_flags, from.texcoords, to.texcoords);
  append_part(all.texcoord_fits, more.texcoord_fits, from.texcoords, to.texcoords);
  append_part(all.normal, more.normal, 3 * from.normals, 3 * to.normals);
  append_part(all.normal_fits, more.normal_fits, from.normals, to.normals);

  append_sparse(all.corner_texcoord, before.corners, more.corner_texcoord, from.corners, to.corners,
                kNone);
  append_sparse(all.corner_normal, before.corners, more.corner_normal, from.corners, to.corners,
                kNone);
  append_part(all.corner_vertex, more.corner_vertex, from.corners, to.corners);
  for (std::size_t f = from.faces; f < to.faces; ++f)
    all.face_first.push_back(
        static_cast<Index>(before.corners + more.face_first[f + 1] - from.corners));

  const auto count = [](Referenced& lines, const Referenced& others, std::size_t added) {
    lines.count += added;
    lines.largest = std::max(lines.largest, others.largest);
  };
  count(all.vertices, more.vertices, to.vertices - from.vertices);
  count(all.texcoords, more.texcoords, to.texcoords - from.texcoords);
  count(all.normals, more.normals, to.normals - from.normals);
}

}  // namespace pstrips::inline formats::obj
