#pragma once

#include <limits>
#include <vector>

#include "codecs/collapse.h"
#include "codecs/measure/error_bounds.h"
#include "codecs/triangulate/triangulate.h"
#include "core/mesh.h"

namespace pstrips::inline converters {

/// error_bounds() of a mesh, with placements rounded as files store them.
std::vector<ErrorBounds> level_bounds(const Mesh& mesh, const Triangulation& triangles,
                                      const CollapseSequence& sequence,
                                      double most = std::numeric_limits<double>::infinity());

/// Drops the collapses after those whose two-sided bound is at most `most`, and their bounds. Takes
/// the bounds of all levels up to the first one that is dropped.
void cut_back(const Mesh& mesh, const Triangulation& triangles, double most,
              CollapseSequence& sequence, std::vector<ErrorBounds>& bounds);

}  // namespace pstrips::inline converters
