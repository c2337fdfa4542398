#pragma once

#include "codecs/stripify/tetra_strips.h"

namespace pstrips::inline codecs {

/// Generalized strips of tetrahedra, few and of about the same length.
///
/// tetrahedra  4 n vertices < vertex_count; of any kind, see TetraGraph for what joins two of them
/// returns     every tetrahedron once, oriented as it is
/// options     seed; effort: how long ends are moved, 0 not at all; stop
/// cost        O(n) expected for each unit of effort
/// source      [Vanecek05 §4.2, §6.4]: many paths are grown at once, the next link always at a
///             tetrahedron of the lowest class U1, C1, U2, C2, U3, C3, U4 (alone, or the end of a
///             strip; how many it can still be linked to). The thesis does not say which one of a
///             class; here the one that came into it first. On Delaunay meshes of random points the
///             strips have 180 to 220 tetrahedra (published: 68 to 186)
///
/// Then ends of strips are moved about until they meet; this is ours, after [Stewart01]. Effort 1
/// makes it 600 to 700 tetrahedra a strip.
TetraStrips tetra_multi_path(std::span<const Index> tetrahedra, Index vertex_count,
                             const StripOptions& options);

}  // namespace pstrips::inline codecs
