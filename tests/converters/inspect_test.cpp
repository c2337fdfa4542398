#include "converters/inspect.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "codecs/filter/display_level.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

/// Of all meshes when the last packet has come.
DisplayStrips last_strips(const ProgressiveStrips& strips) {
  DisplayStrips out;
  for (const ProgressiveMesh& mesh : strips.meshes) {
    DisplayLevel display(mesh, Filter::dtfs);
    display.refine(kNone);
    display.update();
    display.append_display(out);
  }
  return out;
}

RC_GTEST_PROP(Inspect, CountsWhatIsDrawn, (std::uint32_t seed)) {
  test::ProgressiveOptions options;
  options.meshes = 1 + seed % 3;
  options.encoding = static_cast<MapEncoding>(seed % 2 == 0 ? 2 : 0);
  options.single_wedges = seed % 5 < 2;
  options.vsplits = 40;
  const ProgressiveStrips strips = test::random_progressive(seed, options);
  const Inspection figures = inspect(strips);
  const DisplayStrips drawn = last_strips(strips);
  const DisplayCost cost = display_cost(drawn);
  RC_ASSERT(figures.levels.size() == strips.packets.size() + 1);
  RC_ASSERT(figures.levels.back().vertices_sent == cost.vertices_sent);
  RC_ASSERT(figures.levels.back().strips == figures.strips);
  if (options.encoding != MapEncoding::triangles) return;
  RC_ASSERT(figures.strips == (drawn.empty() ? 0 : cost.restarts + 1));
  RC_ASSERT(std::accumulate(figures.strip_lengths.begin(), figures.strip_lengths.end(),
                            std::uint64_t{0}) == figures.strips);
  RC_ASSERT(figures.map_entries == 3 * figures.triangles);
}

}  // namespace
}  // namespace pstrips
