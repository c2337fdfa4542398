#pragma once

#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats {

/// Reads points in text, one a line: x y z, parted by blanks, commas or semicolons.
///
/// file     the whole file; nothing points into it afterwards
/// returns  a model of one mesh without faces: POSITION as f64, in the order of the file
/// columns  beyond the third are passed over, whatever they say
/// lines    "#" begins a comment; empty lines mean nothing. Before the first point there may be
///          lines of something else, as programs write them: column names, a count
/// numbers  decimals in the range of a double, correctly rounded; "nan" and "inf" in any case
/// errors   corrupt for a line of fewer than three numbers, truncated when it is the last one and
///          has no end, both with its offset and "line N"; over_limit
/// cost     O(size)
Result<Model> read_xyz(ByteView file, const Limits& limits = {});

}  // namespace pstrips::inline formats
