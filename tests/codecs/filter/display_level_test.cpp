#include "codecs/filter/display_level.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/support/progressive.h"
#include "tests/support/shown.h"

namespace pstrips {
namespace {

/// Refines `mesh` and compares what is drawn with what the level shows; "" when they agree.
std::string first_difference(const ProgressiveMesh& mesh, Filter filter, Index vsplits) {
  DisplayLevel display(mesh, filter);
  for (std::size_t done = 0;; done += vsplits) {
    DisplayStrips drawn;
    display.append_display(drawn);
    const Level& level = display.level();
    if (test::triangles_of(drawn, level) != test::triangles_of(level))
      return "after " + std::to_string(level.vsplits_done()) + " vsplits";
    if (done >= mesh.vsplits.size()) return "";
    display.refine(vsplits);
    display.update();
  }
}

// Strips change by what is written to them, by symbols, and by wedges that go over to another
// vertex.
RC_GTEST_PROP(DisplayLevel, DrawsTheLevelWhateverChangesIt, (std::uint32_t seed)) {
  test::ProgressiveOptions options;
  options.encoding = static_cast<MapEncoding>(seed % 3);
  options.single_wedges = seed % 5 == 0;
  options.vsplits = 30;
  const ProgressiveMesh mesh = test::random_progressive(seed, options).meshes[0];
  for (const NamedFilter& named : display_filters())
    for (const Index vsplits : {1u, 4u})
      RC_ASSERT(first_difference(mesh, named.filter, vsplits) == "");
}

// A wedge that every entry shows goes to and fro until the work for it is spent.
TEST(DisplayLevel, DrawsTheLevelWhenWorkIsSpent) {
  constexpr Index kWrites = 400;
  ProgressiveMesh mesh;
  mesh.single_wedges = false;
  mesh.groups.resize(1);
  mesh.base_vertices = mesh.base_wedges = 3;
  mesh.base_wedge_vertex = {0, 1, 1};
  for (Index strip = 0; strip < 300; ++strip)
    mesh.base_map.insert(mesh.base_map.end(), {0, 1, 2, kRestart});
  mesh.group_entries = {static_cast<Index>(mesh.base_map.size())};
  mesh.vsplits.assign(kWrites, {1, 0, 1, 0});
  for (Index i = 0; i < kWrites; ++i) {
    mesh.vsplits[i].parent = i == 0 ? 1 : 2 + i;
    mesh.reassigned.push_back(2);
  }
  mesh.position.data.resize(12 * std::size_t{3 + kWrites});
  EXPECT_EQ(first_difference(mesh, Filter::dtfs, 1), "");
  EXPECT_EQ(first_difference(mesh, Filter::dtfs, kWrites), "");
}

}  // namespace
}  // namespace pstrips
