#pragma once

#include "core/limits.h"
#include "core/result.h"
#include "core/tetra.h"

namespace pstrips::inline formats {

/// Whether the text begins as MEDIT's does.
bool looks_like_medit(ByteView file);

/// Reads the vertices and tetrahedra of a MEDIT .mesh file in text. [Frey01 §7.2]
///
/// file     the whole file; nothing points into it afterwards
/// returns  vertices and tetrahedra in the order of the file, indices from 0; reference numbers are
///          passed over, as are all other sections up to the next keyword, unknown ones included.
///          A file without tetrahedra gives none. "End" may be missing
/// errors   corrupt, with the offset and "line N": no MEDIT file, a keyword twice, vertices before
///          the dimension, an index that names no vertex, what is no number; truncated when a
///          section ends before its count; over_limit; unsupported for two dimensions and for the
///          binary variant
/// cost     O(size); a count is checked against the bytes left before anything is allocated for it
Result<TetraMesh> read_medit(ByteView file, const Limits& limits = {});

/// Writes strips as text. [spec/tetra.md]
Bytes write_tetra_strips(const TetraStrips& strips);

}  // namespace pstrips::inline formats
