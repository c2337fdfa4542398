#pragma once

#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/limits.h"
#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrips::inline formats {

// The text variant, `.pm`: the vsplit records of [Skabek11 §3.3] after a base in the manner of
// OBJ. It carries triangles, positions and one set of texture coordinates. [spec/text.md]

struct TextFile {
  Bytes bytes;
  /// What the file cannot carry and the strips had, a phrase each; in a fixed order.
  std::vector<std::string> dropped;
};

/// Replays all records and writes which triangles each of them adds and changes.
///
/// Precondition: `check(strips)` holds (formats/pstrip/payload/check.h).
/// errors  bad_argument for a map of triangles; corrupt when a record rewrites an entry that does
/// not show its parent, with the path of
///         the vsplit; over_limit when the text would exceed Limits::memory_bytes (a record names
///         every face that it changes, so hostile strips can ask for a quadratic amount)
/// cost    O(map + entries rewritten + text)
Result<TextFile> write_text(const ProgressiveStrips& strips, const Limits& limits = {});

/// One record read backwards: `removed` vanishes into `kept`.
struct TextCollapse {
  Index removed;
  Index kept;  ///< kNone: it appeared on its own
  friend bool operator==(const TextCollapse&, const TextCollapse&) = default;
};

/// A text file at full resolution, and how it gets coarser.
struct TextProgressive {
  /// Triangles in one group, vertices in the order of the file; with texture coordinates a wedge
  /// for each pair of a vertex and a texture index, and TEXCOORD_0; wedges sorted by vertex.
  Mesh mesh;
  std::vector<TextCollapse> collapses;  ///< fine to coarse, numbered as in `mesh`
  /// Where `kept` stands after each collapse, one element of `mesh.position`'s format each; empty
  /// when no record moves its parent.
  Bytes kept_position;
};

/// Reads a text file. Lines that a writer of the format's authors could have made are taken too:
/// the header comment is optional, white space is free.
///
/// errors  truncated, corrupt, over_limit with the line and byte offset; unsupported for Hoppe's
///         binary format of the same name
/// cost    O(file) expected; memory O(file)
Result<TextProgressive> read_text(ByteView file, const Limits& limits = {});

/// Whether the bytes begin with the header comment that write_text makes.
bool looks_like_text(ByteView start);
/// Whether the bytes are a progressive mesh of Hoppe's mesh processing library, which shares the
/// file name extension; reads as far as its first line that is no comment.
bool looks_like_hoppe_pm(ByteView start);

}  // namespace pstrips::inline formats
