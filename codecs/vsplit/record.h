#pragma once

#include <span>
#include <vector>

#include "codecs/collapse.h"
#include "core/progressive_strips.h"

namespace pstrips::inline codecs {

/// What a level of a recording shows.
struct LevelCounts {
  Index triangles = 0;
  Index strips = 0;  ///< with at least one triangle
};

/// A progressive mesh and how its numbering relates to the mesh it was made from.
struct Recording {
  ProgressiveMesh mesh;             ///< faces, order and digest are left empty
  std::vector<LevelCounts> levels;  ///< after 0, 1 … all vsplits
  std::vector<Index> vertex_from;   ///< for each vertex, its index in the source mesh
  std::vector<Index> wedge_from;    ///< for each wedge, likewise
};

/// Full-resolution strips of a mesh, ordered by group; or its triangles, in any order.
struct StripMap {
  std::vector<Index> entries;        ///< wedges and restarts, no symbols; or three a triangle
  std::vector<Index> group_entries;  ///< entries of each group of the mesh
};

/// Performs strip-edge collapses on the strips and records the vsplits that undo them.
///
/// Exact whatever the collapses are: a record says which entries to write, nothing is inferred.
/// Vertices that stand in no strip come last, as vsplits without a parent. A wedge that the
/// sequence keeps but no strip holds appears with its vertex instead.
///
/// With optimal placement (the sequence has placements) each record says where its parent stood
/// before the collapse, in the format of the mesh's positions, to which placements are rounded.
///
/// sequence  as simplify() makes it: each removed vertex once, with every wedge that stands at it
/// cost      O(map + rewritten entries); deterministic
/// source    [Kim04 §3.2 strip-edge collapse, §3.3 symbols, §3.4 exceptions]. Differs: a symbol may
///           also name an entry that the same collapse has just rewritten, which keeps more
///           entries out of the records.
Recording record(const Mesh& mesh, const StripMap& strips, const CollapseSequence& sequence,
                 MapEncoding encoding);

}  // namespace pstrips::inline codecs
