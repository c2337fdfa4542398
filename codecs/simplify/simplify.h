#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh.h"

namespace pstrip {

/// A triangle complex of any kind: non-manifold, doubled faces, several components, borders.
struct SimplifyInput {
  std::span<const double> positions;  ///< 3 a vertex; vertices with a NaN or infinity are never moved or removed
  std::span<const Index> wedge_vertex;  ///< a vertex for each wedge; empty: wedge i is vertex i
  std::span<const Index> triangles;     ///< 3 n wedges; the three vertices of a triangle are distinct
  std::span<const Index> group;         ///< one a triangle; empty: all in group 0
  /// Wedge attributes as numbers, `attribute_count` a wedge, scaled so that a difference of 1 costs
  /// as much as a displacement of the bounding-box diagonal; empty: none.
  std::span<const float> attributes;
  std::uint32_t attribute_count = 0;
};

struct SimplifyOptions {
  std::uint64_t target_triangles = 0;  ///< stop at this many triangles or fewer
  double max_error = -1;               ///< stop before a collapse whose error (model units) is larger; negative: no limit
};

/// What becomes of one wedge of a removed vertex.
struct WedgeMove {
  Index from;  ///< wedge that stands at the removed vertex
  Index to;    ///< wedge of the other vertex that replaces it; kNone: carried, it keeps its attributes and moves
};

/// Half-edge collapse of `removed` onto `kept`. [Kim04 §2.2]
struct Collapse {
  Index removed;
  Index kept;
  float error;   ///< distance estimate after it, model units, not falling along the sequence
  Index moves;   ///< how many of the sequence's wedge moves belong to it
};

struct CollapseSequence {
  std::vector<Collapse> collapses;  ///< fine to coarse
  std::vector<WedgeMove> moves;     ///< of all collapses, one after the other; every wedge of each removed vertex once
  std::uint64_t triangles_left = 0;
  bool reached_target = false;
  // Candidate edges refused at the end, by guard.
  std::uint64_t refused_flip = 0, refused_link = 0, refused_border = 0;
};

/// Orders half-edge collapses by quadric error until the target is reached.
/// [Garland97 §3-5; Kim04 §5; Skabek11 §2.3]
CollapseSequence simplify(const SimplifyInput& input, const SimplifyOptions& options);

}  // namespace pstrip
