#pragma once

#include "core/progressive_strips.h"

namespace pstrips::test {

// Small valid files, made by hand so that a test may say which byte of them it breaks.

template <class T>
Bytes bytes_of(std::initializer_list<T> values) {
  const auto view = std::as_bytes(std::span(values.begin(), values.size()));
  return Bytes(view.begin(), view.end());
}

/// Single wedges, naive, one group: a square pyramid without its bottom, one more split of the
/// apex, and an isolated vertex. Two packets.
ProgressiveStrips roof();

/// The same with symbols.
ProgressiveStrips symbols();

/// The same with an attribute of each face.
ProgressiveStrips numbered_faces();

/// Several wedges a vertex, optimal placement, three groups, a polygon, a line, face attributes,
/// the original order and a digest.
ProgressiveStrips seam();

/// A map of triangles in two groups, several wedges a vertex: the roof of a square, a seam along
/// one edge, one more split of the apex, and an isolated vertex.
ProgressiveStrips growing();

/// Of the compact profile: the same roof and split, with single wedges and on a grid, as batches.
ProgressiveStrips compact();

/// A file of the compact profile: one mesh with a seam in batches of splits, of which FINE brings
/// the last bits.
ProgressiveStrips batches();

/// The same with the effort `small`.
ProgressiveStrips small();

/// Two triangles whose corners are six wedges of five vertices, welded into four.
ProgressiveStrips welded();

/// The same with normals and tangents on squares of 8 and 5 bits.
ProgressiveStrips directions();

/// The seam without faces, order and digest.
ProgressiveStrips bare_seam();

/// Two meshes with nodes, a material, images, foreign entries and an unknown chunk.
ProgressiveStrips scene();

/// A strip of symbols that all lead to its first entry, which each record writes: decoding changes
/// entries × records values.
ProgressiveStrips chained(Index entries, Index records);

/// No mesh at all.
ProgressiveStrips empty();

/// A mesh without vertices.
ProgressiveStrips empty_mesh();

/// Computes the digest of each mesh.
void set_digests(ProgressiveStrips& strips);

}  // namespace pstrips::test
