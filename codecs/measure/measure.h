#pragma once

#include <cstdint>
#include <span>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// A surface: its triangles, or its vertices as points when it has none. Triangles and points with
/// a NaN or an infinity do not belong to it; vertices outside all triangles neither, unless there
/// are no triangles.
struct Surface {
  std::span<const double> positions;  ///< 3 a vertex
  std::span<const Index> triangles;   ///< 3 n vertices
};

/// From samples of one surface to the nearest points of another, in model units.
struct OneSidedDistance {
  double maximum = 0;
  double rms = 0;
};

/// How far apart two surfaces are. Both empty: 0; one empty: infinity.
struct Distance {
  OneSidedDistance a_to_b, b_to_a;
  double hausdorff = 0;  ///< the larger maximum
  double rms = 0;        ///< over the samples of both sides, each side counting half
};

/// Measures the distance between two surfaces by sampling.
///
/// samples  on each surface, spread evenly by area, at fixed places; all vertices of triangles
///          count for the maximum besides
/// cost     O((samples + size) log size), about 1 µs a sample between similar surfaces;
///          120 bytes a triangle; deterministic
/// source   the measure of [Cignoni98], stratified instead of scan-converted
Distance measure_distance(const Surface& a, const Surface& b, std::uint64_t samples = 1'000'000);

/// Length of the bounding box's diagonal over the finite vertices; 0 when there are none.
double bounding_box_diagonal(std::span<const double> positions);

}  // namespace pstrips::inline codecs
