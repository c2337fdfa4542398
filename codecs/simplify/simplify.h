#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh.h"
#include "core/progress.h"

namespace pstrip {

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
};

struct SimplifyOptions {
  std::uint64_t target_triangles = 0;  ///< stop at this many triangles or fewer
  /// Take no collapse whose error (model units) is larger; negative: no limit.
  double max_error = -1;
};

/// What becomes of one wedge that stands at a removed vertex.
struct WedgeMove {
  Index from;
  Index to;  ///< wedge of the other vertex that replaces it; kNone: carried, it keeps its
             ///< attributes and stands at the other vertex from now on
  friend bool operator==(const WedgeMove&, const WedgeMove&) = default;
};

/// Half-edge collapse of `removed` onto `kept`. [Kim04 §2.2]
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

struct CollapseSequence {
  std::vector<Collapse> collapses;  ///< fine to coarse
  /// Of all collapses, one after the other; every wedge that stands at the removed vertex once: of
  /// the source or carried there earlier. A wedge that a removed triangle uses is mapped to the
  /// other wedge on that edge (first triangle wins), one that only other triangles use is carried,
  /// one that no triangle uses any more is mapped to any wedge of the kept vertex.
  std::vector<WedgeMove> moves;
  std::uint64_t triangles_left = 0;
  SimplifyStop stop = SimplifyStop::target;
  /// Collapses taken against a guard, since everything cheaper was used up: the first guard that
  /// refused each. A dearer price was paid for them, see simplify().
  std::uint64_t forced_border = 0, forced_link = 0, forced_flip = 0;
};

/// Orders half-edge collapses by quadric error until the target is reached.
///
/// Guards keep the shape: a vertex on a border or non-manifold edge collapses only along such an
/// edge, the link condition keeps the topology, no face turns by more than about 80° or becomes
/// a sliver. A guard does not forbid: the refused collapse costs its whole displacement
/// as well, so that components and holes smaller than the error of the rest vanish and every mesh
/// can be reduced to nothing. Wedges that would be carried, merged attributes and seams are priced
/// too.
///
/// progress  may be empty; asked every few thousand collapses
/// returns   the whole sequence; same input, same sequence
/// cost      O(n log n); about 1 µs a collapse and 200 bytes a triangle at work
/// source    [Garland97 §3-5; Hoppe99 §3 attribute quadrics; Kim04 §5; Skabek11 §2.3]. Differs:
///           quadrics are relative to their vertex, hence exact enough in single precision; a
///           vertex stands in the heap once, under a lower bound that is checked when it comes up.
CollapseSequence simplify(const SimplifyInput& input, const SimplifyOptions& options,
                          const Progress& progress = {});

}  // namespace pstrip
