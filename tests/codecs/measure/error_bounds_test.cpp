#include "codecs/measure/error_bounds.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "codecs/measure/measure.h"
#include "codecs/simplify/simplify.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kUnbounded = std::numeric_limits<float>::max();

struct Owned {
  std::vector<double> positions;
  std::vector<Index> triangles;
  std::vector<Collapse> collapses{};
  std::vector<double> placements{};

  CollapsedSurface view() const {
    CollapsedSurface out{{}, triangles, collapses, placements};
    for (std::size_t i = 0; i < positions.size(); i += 3)
      out.positions.push_back({positions[i], positions[i + 1], positions[i + 2]});
    return out;
  }
  ErrorBounds last() const { return error_bounds(view()).back(); }
};

Owned of_mesh(const Mesh& mesh) {
  Owned out{positions_as_double(mesh), {}};
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const Index a = mesh.vertex_of(mesh.corners[i]), b = mesh.vertex_of(mesh.corners[i + 1]),
                c = mesh.vertex_of(mesh.corners[i + 2]);
    if (a != b && b != c && c != a) out.triangles.insert(out.triangles.end(), {a, b, c});
  }
  return out;
}

Owned simplified(Owned out, const SimplifyOptions& options) {
  const CollapseSequence sequence =
      simplify({out.positions, {}, out.triangles, {}, {}, 0}, options);
  out.collapses = sequence.collapses;
  out.placements = sequence.placements;
  return out;
}

// Triangles of the level after so many collapses, and the points of its vertices that had a
// triangle, as triangles without extent.
Owned level(const Owned& full, std::size_t collapses) {
  Owned out{full.positions, {}};
  std::vector<Index> stands_for(full.positions.size() / 3);
  std::iota(stands_for.begin(), stands_for.end(), Index{0});
  for (std::size_t i = collapses; i-- > 0;)
    stands_for[full.collapses[i].removed] = stands_for[full.collapses[i].kept];
  for (std::size_t i = 0; !full.placements.empty() && i < 3 * collapses; ++i)
    out.positions[std::size_t{3} * full.collapses[i / 3].kept + i % 3] = full.placements[i];
  for (std::size_t t = 0; t < full.triangles.size(); t += 3) {
    const Index a = stands_for[full.triangles[t]], b = stands_for[full.triangles[t + 1]],
                c = stands_for[full.triangles[t + 2]];
    if (a != b && b != c && a != c) out.triangles.insert(out.triangles.end(), {a, b, c});
    for (const Index v : {a, b, c}) out.triangles.insert(out.triangles.end(), {v, v, v});
  }
  return out;
}

// How much larger than a distance its bound may be: a factor, and a share of the diagonal of all
// places where vertices ever stand.
struct Slack {
  double factor = 1;
  double share = 1;
};

double diagonal_of(const Owned& full) {
  std::vector<double> places = full.positions;
  places.insert(places.end(), full.placements.begin(), full.placements.end());
  return bounding_box_diagonal(places);
}

// What is wrong with the bounds of all levels, or of each `step`th one; empty when they hold and
// are no larger than `slack` allows.
std::string broken_bound(const Owned& full, std::size_t step = 1, Slack slack = {}) {
  const std::vector<ErrorBounds> bounds = error_bounds(full.view());
  if (bounds.size() != full.collapses.size() + 1) return "not one for each level";
  if (bounds[0] != ErrorBounds{}) return "not zero at full resolution";
  const Owned all = level(full, 0);
  // Distances are roots of sums of squares of differences between coordinates.
  const double rounding = 1e-7 * bounding_box_diagonal(all.positions);
  const double diagonal = diagonal_of(full);
  for (std::size_t i = 1; i < bounds.size(); ++i) {
    const ErrorBounds &bound = bounds[i], &last = bounds[i - 1];
    const std::string where = " after " + std::to_string(i) + " collapses";
    if (bound.two_sided < last.two_sided || bound.one_sided < last.one_sided)
      return "falls" + where;
    if (bound.one_sided > bound.two_sided) return "one side is more than both" + where;
    if (i % step != 0 && i + 1 != bounds.size()) continue;
    const Owned now = level(full, i);
    const Distance d =
        measure_distance({all.positions, all.triangles}, {now.positions, now.triangles}, 500);
    if (d.hausdorff > bound.two_sided + rounding || d.a_to_b.maximum > bound.one_sided + rounding)
      return std::to_string(d.a_to_b.maximum) + " there, " + std::to_string(d.b_to_a.maximum) +
             " back, yet " + std::to_string(bound.two_sided) + " promised" + where;
    if (bound.two_sided > slack.factor * d.hausdorff + slack.share * diagonal)
      return std::to_string(bound.two_sided) + " is loose for " + std::to_string(d.hausdorff) +
             where;
  }
  return "";
}

// A square of four corners around vertex 4.
Owned pyramid(double height, bool closed) {
  Owned out{{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, height},
            {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}};
  if (!closed) out.triangles.resize(9);  // without the side at x = 0
  return out;
}

TEST(ErrorBounds, OfNoCollapsesIsZero) {
  EXPECT_EQ(error_bounds({}), std::vector{ErrorBounds{}});
  EXPECT_EQ(error_bounds(pyramid(1, true).view()), std::vector{ErrorBounds{}});
}

TEST(ErrorBounds, OfAPyramidIsItsHeight) {
  for (const double height : {0.25, -2.0, 1e-30, 1e30}) {
    Owned surface = pyramid(height, true);
    if (height == 1e30)
      for (double& x : surface.positions) x = x < 1e30 ? x * 1e30 : x;
    surface.collapses = {{4, 0, 0, 0}};
    EXPECT_GE(surface.last().two_sided, std::abs(height));
    EXPECT_NEAR(surface.last().two_sided, std::abs(height),
                1e-6 * std::abs(height) + 1e-12 * std::abs(surface.positions[3]));
    EXPECT_EQ(broken_bound(surface), "");
  }
}

TEST(ErrorBounds, WaysThereAndBackCancelOut) {
  // The apex goes down, then up again by half: half its height is left.
  Owned surface = pyramid(1, true);
  surface.positions.insert(surface.positions.end(), {0.5, -1, 0});  // beside the border
  surface.triangles.insert(surface.triangles.end(), {1, 0, 5});
  surface.collapses = {{5, 0, 0, 0}, {4, 0, 0, 0}};
  surface.placements = {0, 0, 0, 0, 0, 0};
  EXPECT_EQ(broken_bound(surface), "");
  surface = pyramid(1, true);
  for (const double z : {1.0, 0.0}) {  // between the neighbours 0 and 2, above the square
    surface.collapses = {{4, 0, 0, 0}};
    surface.placements = {0.5, 0.5, z};
    EXPECT_EQ(broken_bound(surface), "");
  }
}

TEST(ErrorBounds, OfFlatGridsIsNearlyZero) {
  Mesh mesh = test::grid(20);
  for (Index v = 0; v < mesh.vertex_count(); ++v) set_component(mesh.position, v, 2, 0);
  for (const Placement placement : {Placement::subset, Placement::optimal}) {
    const Owned surface =
        simplified(of_mesh(mesh), {.target_triangles = 2, .placement = placement});
    ASSERT_GT(surface.collapses.size(), 390u);
    // Optimal placements are computed in single precision and leave the border a little.
    const double rounding = placement == Placement::subset ? 1e-12 : 1e-5;
    EXPECT_LT(surface.last().two_sided, rounding * bounding_box_diagonal(surface.positions));
    EXPECT_EQ(broken_bound(surface, 50), "");
  }
}

TEST(ErrorBounds, OfABorderIsWhatLeavesIt) {
  // A square whose lower side has two vertices more, pulled out by 0.01.
  Owned surface{{0, 0, 0, 0.4, -0.01, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.6, -0.01, 0},
                {0, 1, 4, 1, 3, 4, 1, 5, 3, 5, 2, 3}};
  surface.collapses = {{1, 0, 0, 0}};
  EXPECT_GE(surface.last().two_sided, 0.003f);
  EXPECT_LT(surface.last().two_sided, 0.0101f);
  EXPECT_EQ(broken_bound(surface), "");
  surface.collapses = {{5, 1, 0, 0}};
  surface.placements = {0.5, -0.01, 0};  // slides along
  EXPECT_LT(surface.last().two_sided, 0.003f);
  EXPECT_EQ(broken_bound(surface), "");
}

TEST(ErrorBounds, HoldForFansOfManyTrianglesAtOneEdge) {
  // Eight pages of a book: the edge from 0 to 1 has eight triangles.
  Owned surface{{0, 0, 0, 0, 0, 1}, {}};
  for (Index k = 0; k < 8; ++k) {
    surface.positions.insert(surface.positions.end(), {std::cos(k), std::sin(k), 0.5});
    surface.triangles.insert(surface.triangles.end(), {0, 1, k + 2});
  }
  surface.collapses = {{2, 0, 0, 0}, {3, 1, 0, 0}, {1, 0, 0, 0}, {4, 0, 0, 0}};
  EXPECT_EQ(broken_bound(surface), "");
  surface.placements = {0, 0, 0.1, 0, 0, 0.9, 0, 0, 0.5, 0.1, 0, 0.5};
  EXPECT_EQ(broken_bound(surface), "");
}

TEST(ErrorBounds, PartsThatVanishLeaveAPoint) {
  // A triangle far from all others: three corners at most √2 from the one that is left.
  Owned surface = pyramid(0.1, true);
  surface.positions.insert(surface.positions.end(), {9, 9, 9, 10, 9, 9, 9, 10, 9});
  surface.triangles.insert(surface.triangles.end(), {5, 6, 7});
  surface.collapses = {{6, 7, 0, 0}, {7, 5, 0, 0}};
  const std::vector<ErrorBounds> bounds = error_bounds(surface.view());
  EXPECT_GE(bounds[2].two_sided, 1.0f);
  EXPECT_LE(bounds[2].two_sided, 2.5f);
  EXPECT_EQ(broken_bound(surface), "");
}

TEST(ErrorBounds, AreTheLargestFloatWhereNothingIsKnown) {
  Owned surface = pyramid(1, true);
  surface.collapses = {{4, 0, 0, 0}, {3, 0, 0, 0}};
  for (const Index v : {0u, 4u}) {
    Owned odd = surface;
    odd.positions[std::size_t{3} * v + 1] = kNaN;
    const std::vector<ErrorBounds> bounds = error_bounds(odd.view());
    EXPECT_EQ(bounds[1].two_sided, kUnbounded);
    EXPECT_EQ(bounds[2].one_sided, kUnbounded);
  }
  Owned vast = surface;
  for (double& x : vast.positions) x *= 1e100;
  EXPECT_EQ(vast.last().two_sided, kUnbounded);
  // One that is not touched does not matter.
  surface.positions[3 * 2] = kNaN;
  EXPECT_LT(surface.last().two_sided, 3.0f);
}

TEST(ErrorBounds, EndAfterTheFirstThatIsTooLarge) {
  const Owned surface = simplified(of_mesh(test::torus(30, 20)), {.target_triangles = 20});
  const std::vector<ErrorBounds> all = error_bounds(surface.view());
  const double most = all[all.size() / 2].two_sided;
  const std::vector<ErrorBounds> some = error_bounds(surface.view(), most);
  ASSERT_LT(some.size(), all.size());
  EXPECT_GT(some.back().two_sided, most);
  EXPECT_LE(some[some.size() - 2].two_sided, most);
  EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
}

TEST(ErrorBounds, HoldAndAreTightOnSmoothSurfaces) {
  for (const Placement placement : {Placement::subset, Placement::optimal})
    for (const Metric metric : {Metric::qem, Metric::memoryless})
      for (const Mesh& mesh : {test::torus(30, 20), test::grid(25), test::cube(false)})
        EXPECT_EQ(broken_bound(
                      simplified(of_mesh(mesh),
                                 {.target_triangles = 4, .placement = placement, .metric = metric}),
                      150, {.factor = 12, .share = 1e-3}),
                  "");
}

TEST(ErrorBounds, AreTightOnSmoothSurfaces) {
  for (const Mesh& mesh : {test::torus(40, 30), test::grid(30)}) {
    const Owned surface = simplified(of_mesh(mesh), {.target_triangles = 4});
    for (const double share : {0.5, 0.8}) {
      const auto collapses =
          static_cast<std::size_t>(share * static_cast<double>(surface.collapses.size()));
      const Owned all = level(surface, 0), now = level(surface, collapses);
      const Distance d =
          measure_distance({all.positions, all.triangles}, {now.positions, now.triangles}, 100'000);
      EXPECT_LT(error_bounds(surface.view())[collapses].two_sided, 8 * d.hausdorff) << share;
    }
  }
}

// Collapses that nobody would choose, between any two vertices, to anywhere.
RC_GTEST_PROP(ErrorBounds, HoldForAnyCollapses, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(3, 14);
  Owned surface = of_mesh(test::random_soup(seed, vertices, *rc::gen::inRange<Index>(1, 30)));
  if (*rc::gen::arbitrary<bool>()) surface = of_mesh(test::grid(vertices / 3 + 2));
  std::vector<Index> live;
  for (const Index v : surface.triangles)
    if (std::ranges::find(live, v) == live.end()) live.push_back(v);
  const bool moves = *rc::gen::arbitrary<bool>();
  while (live.size() > 1) {
    const auto k = *rc::gen::inRange<std::size_t>(0, live.size());
    const Index removed = live[k];
    live.erase(live.begin() + static_cast<std::ptrdiff_t>(k));
    const Index kept = *rc::gen::elementOf(live);
    surface.collapses.push_back({removed, kept, 0, 0});
    if (moves)
      for (int i = 0; i < 3; ++i) surface.placements.push_back(*rc::gen::inRange(-8, 9) / 4.0);
  }
  const std::string wrong = broken_bound(surface, 1, {.factor = 1, .share = 8});
  RC_ASSERT(wrong == "");
}

}  // namespace
}  // namespace pstrips
