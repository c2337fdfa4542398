// Levels of files whatever their maps are, and files that are cut.

#include "converters/decode.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "tests/support/progressive.h"

namespace pstrips {
namespace {

ProgressiveStrips random_file(std::uint32_t seed) {
  test::ProgressiveOptions options;
  options.meshes = 1 + seed % 2;
  options.encoding = static_cast<MapEncoding>(seed % 3);
  options.placement = static_cast<Placement>(seed % 2);
  options.single_wedges = seed % 5 < 2;
  options.scene = options.faces = options.order = seed % 7 < 3;
  return test::random_progressive(seed, options);
}

RC_GTEST_PROP(Decode, IsTheSameWhenPartsAreFreed, (std::uint32_t seed)) {
  const ProgressiveStrips strips = random_file(seed);
  for (std::size_t packets = 0; packets <= strips.packets.size(); ++packets)
    RC_ASSERT(decode(ProgressiveStrips(strips), packets)->meshes ==
              decode(strips, packets)->meshes);
}

RC_GTEST_PROP(Cut, HasTheLevelsThatAreLeft, (std::uint32_t seed)) {
  const ProgressiveStrips strips = random_file(seed);
  for (std::size_t left = 0; left < strips.packets.size(); ++left) {
    const ProgressiveStrips shorter = cut(strips, left);
    RC_ASSERT(shorter.packets.size() == left);
    for (std::size_t packets = 0; packets <= left; ++packets)
      RC_ASSERT(decode(shorter, packets)->meshes == decode(strips, packets)->meshes);
  }
}

// As a reader expects them of a file that is complete.
RC_GTEST_PROP(Cut, CountsWhatIsLeft, (std::uint32_t seed)) {
  const ProgressiveStrips strips = random_file(seed);
  const ProgressiveStrips shorter = cut(strips, strips.packets.size() / 2);
  for (const ProgressiveMesh& mesh : shorter.meshes) {
    RecordStart end;
    while (end.vsplit < mesh.vsplits.size()) end.skip(mesh.vsplits[end.vsplit]);
    RC_ASSERT(end == (RecordStart{mesh.vertices - mesh.base_vertices,
                                  mesh.wedge_offset_counts.size(), mesh.reassigned.size(),
                                  mesh.map_offsets.size(), mesh.new_corners.size()}));
    RC_ASSERT(std::accumulate(mesh.group_entries.begin(), mesh.group_entries.end(),
                              std::size_t{0}) == mesh.base_map.size() + mesh.new_corners.size());
    if (!mesh.triangle_group.empty()) RC_ASSERT(mesh.triangle_group.size() == mesh.triangles);
  }
}

}  // namespace
}  // namespace pstrips
