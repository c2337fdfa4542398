#include "converters/strip_mesh.h"

#include <algorithm>

namespace pstrip {

StripMap strip_mesh(const Mesh& mesh, const Triangulation& triangles, Stripifier stripifier,
                    const StripOptions& options) {
  const std::size_t groups = mesh.groups.size();
  StripMap out;
  out.group_entries.assign(groups, 0);

  // Triangles by group, each group with wedge numbers of its own, so that a stripifier's arrays
  // are as large as the group and not as the mesh.
  std::vector<std::size_t> first(groups + 1, 0);
  for (const Index f : triangles.face) ++first[mesh.group_of(f) + 1];
  for (std::size_t g = 0; g < groups; ++g) first[g + 1] += first[g];
  std::vector<Index> sorted(triangles.face.size());
  std::vector<std::size_t> at(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < sorted.size(); ++t)
    sorted[at[mesh.group_of(triangles.face[t])]++] = static_cast<Index>(t);

  std::vector<Index> local(mesh.wedge_count(), kNone), global, corners;
  for (std::size_t g = 0; g < groups; ++g) {
    if (first[g] == first[g + 1]) continue;
    global.clear();
    corners.clear();
    for (std::size_t k = first[g]; k < first[g + 1]; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        const Index wedge = triangles.corners[std::size_t{3} * sorted[k] + c];
        if (local[wedge] == kNone) {
          local[wedge] = static_cast<Index>(global.size());
          global.push_back(wedge);
        }
        corners.push_back(local[wedge]);
      }
    const Strips strips = stripifier(
        {.triangles = corners, .group = {}, .wedge_count = static_cast<Index>(global.size())},
        options);
    const std::size_t before = out.entries.size();
    for (const Index entry : strips)
      out.entries.push_back(entry == kRestart ? kRestart : global[entry]);
    if (first[g + 1] < sorted.size()) out.entries.push_back(kRestart);
    out.group_entries[g] = static_cast<Index>(out.entries.size() - before);
    for (const Index wedge : global) local[wedge] = kNone;
  }
  return out;
}

}  // namespace pstrip
