#pragma once

#include <span>
#include <string>

#include "codecs/stripify/stripify.h"
#include "core/mesh.h"

namespace pstrip::test {

/// What is wrong with `strips` as a stripification of `input`, as a phrase; empty when they cover
/// every triangle exactly once with its winding, in ascending order of group, no strip across
/// groups, none without a triangle. Decodes the indices by itself; cost O(n log n).
std::string find_strip_fault(const StripInput& input, std::span<const Index> strips);

/// The triangles of a mesh that strips can show, and their groups.
struct StripMesh {
  std::vector<Index> triangles, group;
  Index wedge_count = 0;
  std::vector<double> positions = {};  ///< 3 a wedge
  StripInput input() const { return {triangles, group, wedge_count, positions}; }
};

/// The triangular faces with three distinct vertices, with their groups.
StripMesh strip_mesh(const Mesh& mesh);

}  // namespace pstrip::test
