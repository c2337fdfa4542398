#pragma once

#include <vector>

#include "codecs/compact/batches.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"

namespace pstrips::inline codecs {

struct BatchRecording {
  Recording recording;
  /// The triangles of the map at full resolution, in wedges of the source.
  StripMap map;
  /// How many vsplits each batch has, coarse to fine. Those of vertices that no triangle uses come
  /// after all batches.
  std::vector<Index> batches;
  /// The collapses that the batches undo, the last vsplit's first: what bounds of the levels
  /// follow. Without wedge moves.
  CollapseSequence collapses;
};

/// Records a sequence of collapses as vsplits of a map of triangles, in batches of splits that are
/// independent of each other. [spec/compact.md §2]
///
/// The base is numbered as base_order() says, the rest as plan_splits() does. New wedges of a
/// record are numbered as they are first met: at the corners that move, around the fan if they are
/// one, then at those of the new triangles, then those that no triangle shows any more. A coarse
/// level shows at a vertex the wedges that CollapseSequence::moves would leave there, had its rule
/// been followed in the order of the batches; a vertex with one wedge keeps to that one.
///
/// Vertices that no triangle uses come last, as vsplits without a parent, unless they collapse.
///
/// sequence  any: a vertex is removed once at most and takes part in nothing afterwards. With
///           optimal placement (the sequence has placements) as for record()
/// cost      O(triangles + vertices * batches), of which there are at most kMostBatches. Collapses
///           for which those do not suffice (thousands onto one vertex) are left out: the base is
///           larger
/// source    batches of independent splits [Pajarola00]; wedges [Hoppe98 §3]
BatchRecording record_batches(const Mesh& mesh, const Triangulation& triangles,
                              const CollapseSequence& sequence, const BatchOptions& options = {});

/// Thirty or forty take any usual mesh to its base.
inline constexpr Index kMostBatches = 256;

}  // namespace pstrips::inline codecs
