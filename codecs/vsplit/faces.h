#pragma once

#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"

namespace pstrip {

/// What a recording needs besides to give the source mesh back.
struct FaceRecord {
  FaceTable faces;
  OriginalOrder order;
};

/// Compares the strips' triangles with the faces of the source: fills the table with everything
/// that is not one plain triangle, and finds where each vertex, wedge and face came from.
///
/// Preconditions: `strips` holds each triangle of `triangles` once, in its group; `recording` was
/// made from both. Cost O(map + faces).
FaceRecord record_faces(const Mesh& source, const Triangulation& triangles, const StripMap& strips,
                        const Recording& recording);

}  // namespace pstrip
