#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/result.h"
#include "formats/obj/numbers.h"

namespace pstrips::inline formats::obj {

/// The lines of one kind that corners refer to; they may follow later in the file.
struct Referenced {
  std::uint64_t count = 0;
  std::uint64_t largest = 0;        ///< index referred to, from 1
  std::uint64_t total = kMaxCount;  ///< the largest that may be
  std::uint64_t missing = 0;        ///< corners that name a line of vt or vn that is not there
};

/// What a file has of each attribute, its values and which of them fit a float.
struct VertexValues {
  std::vector<double> position;     ///< three a vertex
  std::vector<double> color;        ///< four a vertex up to the last that has one
  std::vector<double> weight;       ///< one a vertex up to the last that has one
  std::vector<std::uint8_t> flags;  ///< of ObjPresent, one a vertex, or empty: all 0
  bool position_fits = true, color_fits = true, weight_fits = true;
};

// Which numbers of a `vt` line fit a float.
inline constexpr std::uint8_t kUvFit = 1, kTexWFits = 2;

/// What the statements v, vt, vn and f of a text say, in their order.
struct Geometry {
  Referenced vertices, texcoords, normals;
  VertexValues values;
  std::vector<double> texcoord, normal;  ///< three a line
  std::vector<std::uint8_t> texcoord_flags, texcoord_fits, normal_fits;
  std::vector<Index> corner_vertex;
  std::vector<Index> corner_texcoord, corner_normal;  ///< empty: all kNone
  std::vector<Index> face_first{0};

  /// What these arrays take, with the mesh that is made of them.
  std::uint64_t bytes() const;
};

inline constexpr std::uint64_t kVertexBytes = 96, kTupleBytes = 32, kCornerBytes = 36;

inline std::uint64_t max_vertices(const Limits& limits) {
  return std::min<std::uint64_t>(limits.vertices, kMaxCount);
}
inline std::uint64_t max_tuples(const Limits& limits) {
  return std::min<std::uint64_t>(limits.wedges, kMaxCount);
}
inline std::uint64_t max_corners(const Limits& limits) {
  return std::min<std::uint64_t>(limits.corners, kMaxCount);
}

/// A place in a line, and what is wrong there.
struct Cursor {
  const char *p = nullptr, *end = nullptr;
  bool at_last = false;  ///< no line end follows: a statement that stops short may be cut
  ErrorCode code = ErrorCode::corrupt;
  std::string message{};

  void skip_space() {
    while (p != end && is_space(*p)) ++p;
  }
  /// Of the statement; a comment ends it, too.
  bool at_end() {
    skip_space();
    return p == end || *p == '#';
  }
  std::string_view rest() const { return {p, static_cast<std::size_t>(end - p)}; }
  bool refuse(ErrorCode with, std::string what);
  bool refuse_short(std::string what);
};

// Each reads the rest of a statement behind its word; false with a message at cursor.p. A face is
// not closed: its corners are added to corner_vertex and its like.
bool read_vertex(Cursor& cursor, Geometry& out, const Limits& limits);
bool read_texcoord(Cursor& cursor, Geometry& out, const Limits& limits);
bool read_normal(Cursor& cursor, Geometry& out, const Limits& limits);
/// One corner: v, v/vt, v//vn or v/vt/vn, where "v/" and "v//" occur and mean v.
bool read_corner(Cursor& cursor, Geometry& out);

/// How much of each kind a geometry has, or a part of it up to some line.
struct Extent {
  std::size_t vertices = 0, texcoords = 0, normals = 0, corners = 0, faces = 0;
};
Extent extent_of(const Geometry& geometry);

/// Appends what lies between two places of another text's geometry; the indices of corners are
/// those of the whole file in both.
void append(Geometry& all, const Geometry& more, const Extent& from, const Extent& to);

}  // namespace pstrips::inline formats::obj
