#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
  Placement placement = Placement::subset;  ///< free: the kept vertex moves where it fits best
  Metric metric = Metric::memoryless;  ///< a fifth to a third nearer than qem, at the same cost
  unsigned threads = 0;  ///< to work with, 0: one a core; the sequence does not depend on it
};

/// What becomes of one wedge that stands at a removed vertex.
struct WedgeMove {
  Index from;
  Index to;  ///< wedge of the other vertex that replaces it; kNone: carried, it keeps its
             ///< attributes and stands at the other vertex from now on
  friend bool operator==(const WedgeMove&, const WedgeMove&) = default;
};

/// Collapse of `removed` onto `kept`, which may move. [Kim04 §2.2]
struct Collapse {
  Index removed;
  Index kept;
  float error;  ///< estimated distance after it, model units, not falling along the sequence
  Index moves;  ///< how many of the sequence's wedge moves belong to it
  friend bool operator==(const Collapse&, const Collapse&) = default;
};

/// Why a sequence ends.
enum class SimplifyStop : std::uint8_t {
  target,       ///< few enough triangles
  max_error,    ///< every collapse left is dearer than the limit
  exhausted,    ///< no edge is left that may be collapsed (all others touch locked vertices)
  interrupted,  ///< the caller's progress function said so
};

/// How often each guard spoke, see simplify().
struct GuardCounts {
  std::uint64_t border = 0, link = 0, flip = 0, texture = 0;
  friend bool operator==(const GuardCounts&, const GuardCounts&) = default;
};

struct CollapseSequence {
  std::vector<Collapse> collapses;  ///< fine to coarse
  /// Of all collapses, one after the other; every wedge that stands at the removed vertex once: of
  /// the source or carried there earlier. A wedge that a removed triangle uses is mapped to the
  /// other wedge on that edge (first triangle wins), one that only other triangles use is carried,
  /// one that no triangle uses any more is mapped to any wedge of the kept vertex.
  std::vector<WedgeMove> moves;
  std::uint64_t triangles_left = 0;
  SimplifyStop stop = SimplifyStop::target;
  /// With free placement: where the kept vertex of each collapse stands afterwards, 3 a collapse.
  /// Finite; the very coordinates it had where it has not moved yet.
  std::vector<double> placements;
  GuardCounts refused;  ///< collapses that were put off, counted each time they come up
  GuardCounts forced;   ///< taken nevertheless, since everything cheaper was used up
};

/// Orders edge collapses by error until the target is reached.
///
/// Guards keep the shape: a vertex on a border or non-manifold edge collapses only along such an
/// edge, the link condition keeps the topology, no face turns by more than about 80° or
/// degenerates, and none turns over or degenerates in the texture. A guard does not forbid: the
/// refused collapse costs its whole displacement as well, so that components and holes smaller than
/// the error of the rest vanish and every mesh can be reduced to nothing. Wedges that would be
/// carried, merged attributes and seams are priced too, and with subset placement how far the
/// removed vertex stands from the faces that replace its own: planes do not see the tip of a spike.
///
/// With free placement the kept vertex moves to where the metric is least, and its wedges keep
/// their attributes. The memoryless metric looks at the faces there are, keeps the volume under
/// them when vertices may move, and comes nearer to the source; attributes are still judged by the
/// source's.
///
/// progress  may be empty; asked every few thousand collapses
/// returns   the whole sequence; the same for the same input, whatever the number of threads
/// cost      O(n) but for sorting; about 1 µs a collapse (subset; twice that with attributes) to
///           3 µs (free, memoryless); 200 to 300 bytes a triangle at work
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
