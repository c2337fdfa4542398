#pragma once

#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"

namespace pstrips::inline codecs {

/// What a recording needs besides to give the source mesh back.
struct FaceRecord {
  FaceTable faces;
  OriginalOrder order;
};

/// Compares the map's triangles with the faces of the source: fills the table with everything
/// that is not one plain triangle, and finds where each vertex, wedge and face came from.
///
/// Preconditions: `strips`, or the triangles that stand in its place in a recording of a map of
/// triangles, holds each triangle of `triangles` once, in its group; `recording` was made from
/// both. Cost O(map + faces); without the order next to nothing for plain triangles
/// without attributes.
///
/// with_order  else `order` stays empty
FaceRecord record_faces(const Mesh& source, const Triangulation& triangles, const StripMap& strips,
                        const Recording& recording, bool with_order = true);

/// The mesh that decoders end with, put together from the source and not from the records: its
/// digest tells whether a decoder and the records have done what they should.
///
/// Precondition: `recording.mesh.faces` is what record_faces() found.
Mesh mesh_to_decode(const Mesh& source, const StripMap& strips, const Recording& recording);

}  // namespace pstrips::inline codecs
