#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh.h"

// Simplifiers of others, for levels_bench. Each reduces a mesh to so many triangles and measures
// itself: what the library's user has to do before, such as building its half-edge mesh, does not
// count.

namespace pstrips::bench {

struct Shape {
  std::vector<double> positions;  ///< 3 a vertex
  std::vector<Index> triangles;
};

struct Timed {
  Shape shape;
  double seconds = 0;  ///< of processor
};

/// The processor time of this process so far.
double cpu_seconds();

#ifdef PSTRIPS_CGAL
Timed cgal_garland_heckbert(const Shape& source, std::uint64_t target_triangles);
Timed cgal_lindstrom_turk(const Shape& source, std::uint64_t target_triangles);
#endif

}  // namespace pstrips::bench
