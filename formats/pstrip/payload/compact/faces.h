#pragma once

#include "core/bytes.h"
#include "core/fault_list.h"
#include "core/progressive_strips.h"

// For formats/pstrip/payload/compact: the run of fACE. [spec/compact.md §11]

namespace pstrips::inline formats {

/// The run of a face table, and how many of its faces are listed there: all but the polygons at its
/// front that joins of triangles give.
struct CodedFaces {
  Index listed = 0;
  Bytes run;
};

/// Precondition: the records of the mesh are those of its map of triangles, all of them.
/// Cost O(triangles + corners).
CodedFaces code_faces(const ProgressiveMesh& mesh);

/// Fills the lists of the face table; its attributes stay. Indices in it may be anything.
///
/// listed  as CodedFaces says
/// errors  corrupt: a run that no code_faces() made
Result<void> read_faces(ByteView run, Index listed, ProgressiveMesh& mesh);

}  // namespace pstrips::inline formats
