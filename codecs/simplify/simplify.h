#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codecs/collapse.h"
#include "core/mesh.h"
#include "core/progress.h"
#include "core/progressive_strips.h"

namespace pstrips::inline codecs {

/// A triangle complex of any kind: non-manifold, doubled faces, several components, borders.
struct SimplifyInput {
  /// 3 a vertex. A vertex with a NaN or an infinity is neither removed nor collapsed onto.
  std::span<const double> positions;
  std::span<const Index> wedge_vertex;  ///< a vertex for each wedge; empty: wedge i is vertex i
  std::span<const Index> triangles;  ///< 3 n wedges; the three vertices of a triangle are distinct
  std::span<const Index> group;      ///< one a triangle; empty: all in group 0
  /// Wedge attributes as finite numbers, `attribute_count` a wedge, scaled so that a difference of
  /// 1 costs as much as a displacement of the bounding-box diagonal; empty: none.
  std::span<const float> attributes;
  std::uint32_t attribute_count = 0;
  /// The first of two attributes that are texture coordinates, whose triangles shall not turn over;
  /// kNone: none.
  std::uint32_t texture = kNone;
};

/// By what collapses are ordered, and vertices placed.
enum class Metric : std::uint8_t {
  qem,         ///< squared distance to the planes of all faces ever replaced [Garland97]
  memoryless,  ///< to those of the faces there are, with their volume kept [Lindstrom98]
};

struct SimplifyOptions {
  std::uint64_t target_triangles = 0;  ///< stop at this many triangles or fewer
  /// Take no collapse whose error (model units) is larger; negative: no limit.
  double max_error = -1;
  /// Components do not vanish: each keeps four triangles, or all if it has fewer, as long as that
  /// is no more than so many in all; the target gives way. 0: they may.
  std::uint64_t component_triangles = 0;
  Placement placement = Placement::subset;  ///< optimal: the kept vertex moves where it fits best
  Metric metric = Metric::memoryless;  ///< a fifth to a third nearer than qem, at the same cost
  /// With subset placement: the sequence falls into batches of which no two collapses share a
  /// vertex, one after the other, sized as BatchSchedule says; where hardly any two do not, its
  /// rest is in plain order.
  bool in_batches = false;
  CollapseOrder order = CollapseOrder::error;  ///< bits: with subset placement
  unsigned threads = 0;  ///< to work with, 0: one a core; the sequence does not depend on it
};

/// Orders edge collapses by error until the target is reached.
///
/// Constraints keep the shape: a vertex on a border or non-manifold edge collapses only along such
/// an edge, the link condition keeps the topology, no face turns by more than about 80° or
/// degenerates, and none turns over or degenerates in the texture. A constraint does not forbid:
/// the refused collapse costs its whole displacement as well, so that components and holes smaller
/// than the error of the rest vanish and every mesh can be reduced to nothing, unless
/// `component_triangles` holds them. Wedges that would be
/// reassigned, merged attributes and seams are priced too, and with subset placement how far the
/// removed vertex stands from the faces that replace its own: planes do not see the tip of a spike.
///
/// With optimal placement the kept vertex moves to where the metric is least, and its wedges keep
/// their attributes. The memoryless metric looks at the faces there are, keeps the volume under
/// them when vertices may move, and comes nearer to the source; attributes are still judged by the
/// source's.
///
/// progress  may be empty; called every few thousand collapses
/// returns   the whole sequence; the same for the same input, whatever the number of threads
/// cost      O(n) but for sorting; about 1 µs a collapse (subset; twice that with attributes) to
///           3 µs (optimal, memoryless); 200 to 300 bytes a triangle at work
/// source    [Garland97 §3-5; Lindstrom98 §3; Lindstrom99; Hoppe99b §3 attribute quadrics;
///           Kim04 §5; Skabek11 §2.3]. Differs: quadrics are relative to their vertex, hence exact
///           enough in single precision; collapses are ordered in steps of about 5 % of their cost,
///           by what a vertex cost when it was last looked at, which is checked when it comes up;
///           faces count by their area with both metrics, borders by planes that stand on them.
///           `error` is an estimate with a history for either metric: by accumulated quadrics, or
///           where there are none by the sum of each step's squares.
CollapseSequence simplify(const SimplifyInput& input, const SimplifyOptions& options,
                          const Progress& progress = {});

}  // namespace pstrips::inline codecs
