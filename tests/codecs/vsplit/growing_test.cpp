// Levels of maps that grow by triangles.

#include "tests/support/growing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "codecs/vsplit/level.h"
#include "tests/support/progressive.h"
#include "tests/support/shown.h"

namespace pstrips {
namespace {

RC_GTEST_PROP(GrowingLevel, IsWhatTheDefinitionSays, (std::uint32_t seed)) {
  test::ProgressiveOptions options;
  options.encoding = MapEncoding::triangles;
  options.placement = static_cast<Placement>(seed % 2);
  options.single_wedges = seed % 3 == 0;
  options.scene = options.faces = seed % 5 < 2;
  options.vsplits = seed % 30;
  const ProgressiveMesh mesh = test::random_progressive(seed, options).meshes[0];
  Level level(mesh);
  for (std::size_t done = 0; done <= mesh.vsplits.size(); ++done) {
    RC_ASSERT(mesh_of(level).value() == test::decode_slowly(mesh, done));
    level.refine(1);
  }
}

RC_GTEST_PROP(GrowingLevel, ShowsTheTrianglesOfTheStrips, (std::uint32_t seed)) {
  test::ProgressiveOptions options;
  options.encoding = static_cast<MapEncoding>(seed % 2);
  options.single_wedges = seed % 3 == 0;
  options.vsplits = 30;
  const ProgressiveMesh strips = test::random_progressive(seed, options).meshes[0];
  const ProgressiveMesh grows = test::growing(strips);
  Level level(grows), expected(strips);
  for (std::size_t done = 0; done <= strips.vsplits.size(); ++done) {
    RC_ASSERT(test::triangles_of(level) == test::triangles_of(expected));
    level.refine(1);
    expected.refine(1);
  }
}

}  // namespace
}  // namespace pstrips
