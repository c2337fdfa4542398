#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// Faces to be covered by strips that choose the diagonals as they go. Half-edge h runs from corner
/// h to the next corner of its face.
struct StripFaces {
  std::vector<Index> corners;         ///< wedges, all faces one after the other
  std::vector<Index> first;           ///< first corner of each face, and one past the end
  std::vector<Index> group;           ///< one a face; empty: all in group 0
  std::vector<Index> opposite;        ///< as opposite_half_edges()
  std::vector<Index> face;            ///< of each half-edge
  std::vector<std::uint8_t> may_cut;  ///< of quads: bit k, from corner k to corner k + 2
  Index wedge_count = 0;

  Index count() const { return first.empty() ? 0 : static_cast<Index>(first.size() - 1); }
  Index size(Index f) const { return first[f + 1] - first[f]; }
  /// The face over half-edge h, or kNone.
  Index neighbor(Index h) const { return opposite[h] == kNone ? kNone : face[opposite[h]]; }
  /// The half-edge `steps` further around the same face. Precondition: steps <= size of the face.
  Index turned(Index h, Index steps) const {
    const Index f = face[h];
    return h + steps < first[f + 1] ? h + steps : h + steps - size(f);
  }
};

/// Which diagonals are open:
/// - A quad may be cut along a diagonal when, seen along its Newell normal, both triangles have
///   positive area: both ways when it is convex, one way when it is not. When neither way will do
///   (bow ties, flat ones) it is cut as triangulate() does.
/// - Where two faces meet in two neighbouring edges, one of them is cut from the corner between:
///   else both would show the triangle over these edges, back to back. Of two quads that is the
///   one with the lower index if its shape allows, else the other. [Vanecek05 §7.3, figure 7.6]
/// - Larger polygons that are strictly convex and have no such corner are cut in any way; others
///   are replaced by the triangles of triangulate().
/// Without positions every face is convex.
///
/// cost  O(n) on meshes, see make_dual_graph()
StripFaces make_strip_faces(const PolygonInput& input);

/// All of them triangles.
StripFaces make_strip_faces(const StripInput& input);

/// A face on the way of a strip: entered and left over two of its half-edges. The first face of a
/// strip has no entry, the last one no exit (kNone).
struct FaceVisit {
  Index face = kNone;
  Index entry = kNone;
  Index exit = kNone;
};

/// The fewest swaps of a strip up to the last triangle of a face, for both ways in which that one
/// can be wound into the strip.
struct SwapCounts {
  static constexpr std::uint32_t kImpossible = 0x4000'0000;
  std::array<std::uint32_t, 2> by_last_step{0, 0};
  std::uint32_t fewest() const;
};

/// The counts after one face more. Impossible when the diagonal this takes is not open.
SwapCounts pass(const StripFaces& faces, const FaceVisit& visit, const SwapCounts& before);

/// Cuts the faces along the strips so that these have the fewest swaps, and writes the strips as
/// emit_strips() does.
///
/// visits  the strips one after the other, each beginning with a visit without entry; each face
///         once, consecutive ones joined over opposite half-edges, each by itself possible to pass
/// cost    O(corners)
Strips emit_face_strips(const StripFaces& faces, std::span<const FaceVisit> visits);

}  // namespace pstrips::inline codecs
