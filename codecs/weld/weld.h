#pragma once

#include <optional>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// Which vertices and wedges of a mesh become one. Numbers go up as sets first appear.
struct Welds {
  std::vector<Index> vertex, wedge;            ///< for each, the number of its set
  std::vector<Index> vertex_from, wedge_from;  ///< for each set, the first in it
};

/// Vertices of polygons that stand at one place are one vertex, and wedges at it with the same
/// bytes in each attribute are one wedge. What no polygon has stays by itself.
///
/// distance  see places()
/// returns   nothing where all stay as they are
/// cost      O(size)
std::optional<Welds> find_welds(const Mesh& mesh, double distance);

/// The mesh with the first vertex and wedge of each set in place of all. Faces keep their places.
Mesh weld(const Mesh& mesh, const Welds& welds);

}  // namespace pstrips::inline codecs
