#include "codecs/stripify/stripify.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "codecs/stripify/stats.h"
#include "tests/support/growth.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::find_strip_fault;
using test::StripMesh;

// Two triangles over three wedges, back to back: all three edges join them, only one may be used.
StripMesh back_to_back() { return {{0, 1, 2, 0, 2, 1}, {}, 3, {}}; }

// `blades` triangles around the edge 0-1, every other one with the other direction.
StripMesh book(Index blades) {
  StripMesh mesh{{}, {}, 2 + blades, {}};
  for (Index i = 0; i < blades; ++i)
    mesh.triangles.insert(mesh.triangles.end(), {i % 2, 1 - i % 2, 2 + i});
  return mesh;
}

// The same triangle again and again.
StripMesh pile(Index copies) {
  StripMesh mesh{{}, {}, 3, {}};
  for (Index i = 0; i < copies; ++i) mesh.triangles.insert(mesh.triangles.end(), {0, 1, 2});
  return mesh;
}

// Closed fan: the strip around the hub swaps at every second triangle.
StripMesh fan(Index blades) {
  StripMesh mesh{{}, {}, 1 + blades, {}};
  for (Index i = 0; i < blades; ++i)
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % blades});
  return mesh;
}

// A torus that lost one triangle in seven: irregular, with borders everywhere.
StripMesh moth_eaten() {
  StripMesh mesh = test::strip_mesh(test::torus(40, 40));
  for (std::size_t t = mesh.group.size(); t-- > 0;) {
    if (t * t % 7 != 2) continue;
    const auto corner = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t);
    mesh.triangles.erase(corner, corner + 3);
    mesh.group.erase(mesh.group.begin() + static_cast<std::ptrdiff_t>(t));
  }
  return mesh;
}

struct NamedMesh {
  const char* name;
  StripMesh mesh;
};

std::vector<NamedMesh> meshes() {
  const Mesh lone = test::triangle_mesh(std::vector<float>(3 * 9), {7, 3, 5});
  return {
      {"empty", {}},
      {"isolated wedges only", {{}, {}, 5, {}}},
      {"one triangle among isolated wedges", test::strip_mesh(lone)},
      {"back to back", back_to_back()},
      {"book of 2", book(2)},
      {"book of 7", book(7)},
      {"pile", pile(5)},
      {"fan", fan(9)},
      {"cube", test::strip_mesh(test::cube(false))},
      {"cube with seams", test::strip_mesh(test::cube(true))},
      {"grid", test::strip_mesh(test::grid(12))},
      {"torus", test::strip_mesh(test::torus(20, 50))},
      {"thin torus", test::strip_mesh(test::torus(3, 3))},
      {"moth-eaten torus", moth_eaten()},
      {"soup", test::strip_mesh(test::random_soup(7, 30, 400))},
      {"groups not in order", {{0, 1, 2, 2, 1, 3, 4, 5, 6, 2, 3, 4}, {2, 0, 2, 0}, 7, {}}},
  };
}

TEST(Stripifiers, CoverEveryMeshOnce) {
  for (const NamedStripifier& stripifier : stripifiers())
    for (const auto& [name, mesh] : meshes()) {
      SCOPED_TRACE(testing::Message() << stripifier.name << " of " << name);
      EXPECT_EQ(find_strip_fault(mesh.input(), stripifier.run(mesh.input(), {})), "");
    }
}

RC_GTEST_PROP(Stripifiers, CoverRandomSoupsOnce, (std::uint32_t seed)) {
  const auto vertices = *rc::gen::inRange<Index>(1, 40);
  const auto faces = *rc::gen::inRange<Index>(0, 300);
  const StripMesh mesh = test::strip_mesh(test::random_soup(seed, vertices, faces));
  for (const NamedStripifier& stripifier : stripifiers()) {
    const Strips strips = stripifier.run(mesh.input(), {});
    RC_LOG() << stripifier.name;
    RC_ASSERT(find_strip_fault(mesh.input(), strips) == "");
    RC_ASSERT(stripifier.run(mesh.input(), {}) == strips);
  }
}

TEST(Stripifiers, FindByName) {
  for (const NamedStripifier& stripifier : stripifiers())
    EXPECT_EQ(find_stripifier(stripifier.name), &stripifier);
  EXPECT_EQ(find_stripifier("no such"), nullptr);
}

// Seams cut the cube into its six sides.
TEST(Stripifiers, DoNotCrossSeams) {
  const StripMesh mesh = test::strip_mesh(test::cube(true));
  for (const NamedStripifier& stripifier : stripifiers())
    EXPECT_EQ(strip_stats(stripifier.run(mesh.input(), {})).strips, 6u) << stripifier.name;
}

// [Vanecek05 table 8.9]: one strip, and one less than there are sides, unless turns around them
// meet their own beginning.
TEST(Sgi, NearsTheThesisOnATorus) {
  constexpr std::pair<Index, std::uint64_t> kMaxByVertices[] = {
      {20, 19}, {50, 9}, {100, 19}, {200, 19}};
  for (const auto& [segments, strips] : kMaxByVertices) {
    const StripMesh mesh = test::strip_mesh(test::torus(segments, 20));
    EXPECT_EQ(strip_stats(find_stripifier("sgi-strips")->run(mesh.input(), {})).strips, 1u);
    EXPECT_EQ(strip_stats(find_stripifier("sgi-vertices")->run(mesh.input(), {})).strips, strips);
  }
}

std::uint64_t indices_sent(const StripMesh& mesh, const char* name, const StripOptions& options) {
  const Strips strips = find_stripifier(name)->run(mesh.input(), options);
  EXPECT_EQ(find_strip_fault(mesh.input(), strips), "");
  return strip_stats(strips).indices_sent;
}

// What the start of a strip may cost is no part of the annealed cost: one index at most a strip.
TEST(Best, SendsFewerIndicesThanTheOthers) {
  for (const NamedMesh& named : meshes()) {
    if (named.mesh.triangles.size() < 3 * 100) continue;
    SCOPED_TRACE(named.name);
    const std::uint64_t best = indices_sent(named.mesh, "best", {.effort = 20});
    EXPECT_LE(best, indices_sent(named.mesh, "sgi-strips", {}) + 2);
    EXPECT_LE(best, indices_sent(named.mesh, "sgi-vertices", {}) + 2);
  }
}

TEST(Best, GainsByEffort) {
  const StripMesh mesh = moth_eaten();
  const std::uint64_t fast = indices_sent(mesh, "best", {});
  const std::uint64_t high = indices_sent(mesh, "best", {.effort = kEffortHigh});
  EXPECT_LT(high, fast);
}

TEST(Best, MakesFewerStripsForAHigherPrice) {
  const StripMesh mesh = moth_eaten();
  const auto strips = [&](std::uint32_t price) {
    const StripOptions options{.effort = 50, .strip_price = price};
    return strip_stats(find_stripifier("best")->run(mesh.input(), options)).strips;
  };
  EXPECT_LT(strips(10), strips(3));
}

// Between the goals: a price buys strips for indices.
TEST(Best, PaysNoMoreThanThePriceForAStrip) {
  const StripMesh mesh = moth_eaten();
  const auto stats = [&](StripGoal goal, std::uint32_t price) {
    const StripOptions options{.goal = goal, .effort = 100, .strip_price = price};
    return strip_stats(find_stripifier("best")->run(mesh.input(), options));
  };
  const StripStats cheap = stats(StripGoal::indices, 3), between = stats(StripGoal::indices, 30),
                   few = stats(StripGoal::strips, 3);
  EXPECT_LT(between.strips, cheap.strips);
  EXPECT_LE(few.strips, between.strips);
  EXPECT_LT(cheap.indices_sent, between.indices_sent);
  EXPECT_LE(between.swaps, cheap.swaps + 30 * (cheap.strips - between.strips));
}

std::uint64_t fewest_strips(const StripMesh& mesh) {
  const StripOptions options{.goal = StripGoal::strips, .effort = 200};
  const Strips strips = find_stripifier("best")->run(mesh.input(), options);
  EXPECT_EQ(find_strip_fault(mesh.input(), strips), "");
  return strip_stats(strips).strips;
}

// Links leave out at least one edge of every triangle with three neighbours. Those of a grid of
// n x n cells cannot be paired up: 2 (n - 1) stay alone, so that n strips are the least.
TEST(Best, MakesAsFewStripsAsThereCanBe) {
  EXPECT_EQ(fewest_strips(test::strip_mesh(test::torus(20, 50))), 1u);
  EXPECT_EQ(fewest_strips(test::strip_mesh(test::grid(30))), 29u);
  EXPECT_EQ(fewest_strips(test::strip_mesh(test::cube(true))), 6u);
  EXPECT_EQ(fewest_strips(fan(9)), 1u);
  EXPECT_EQ(fewest_strips(pile(5)), 5u);
  EXPECT_EQ(fewest_strips({}), 0u);
}

RC_GTEST_PROP(Best, CoversRandomSoupsByFewStrips, (std::uint32_t seed)) {
  const auto vertices = *rc::gen::inRange<Index>(3, 20);
  const StripMesh mesh = test::strip_mesh(test::random_soup(seed, vertices, 200));
  const std::uint64_t many = strip_stats(find_stripifier("best")->run(mesh.input(), {})).strips;
  RC_ASSERT(fewest_strips(mesh) <= many);
}

// Stopped at the first question, after a part of the first sweep or none of the walks.
TEST(Best, KeepsCompleteStripsWhenStopped) {
  const StripMesh mesh = moth_eaten();
  for (const StripGoal goal : {StripGoal::indices, StripGoal::strips})
    for (const int asked_most : {1, 2, 5}) {
      int asked = 0;
      const StripOptions options{
          .goal = goal, .effort = kEffortMax, .stop = [&] { return ++asked >= asked_most; }};
      EXPECT_GT(indices_sent(mesh, "best", options), 0u);
      EXPECT_EQ(asked, asked_most);
    }
}

TEST(Best, ChangesWithTheSeedAlone) {
  const StripMesh mesh = test::strip_mesh(test::torus(20, 30));
  const auto strips = [&](std::uint32_t seed) {
    return find_stripifier("best")->run(mesh.input(), {.seed = seed, .effort = 5});
  };
  EXPECT_EQ(strips(1), strips(1));
  EXPECT_NE(strips(1), strips(2));
}

// A hub of 160,000 triangles, and as many around one edge.
TEST(Stripifiers, AreLinearAroundOneVertexAndOneEdge) {
  for (const auto& make : {fan, book, pile})
    for (const NamedStripifier& stripifier : stripifiers()) {
      SCOPED_TRACE(stripifier.name);
      Strips strips;
      const auto run = [&](const StripMesh& mesh) { strips = stripifier.run(mesh.input(), {}); };
      EXPECT_TRUE(test::grows_linearly(40'000, make, run));
      EXPECT_EQ(find_strip_fault(make(160'000).input(), strips), "");
    }
}

}  // namespace
}  // namespace pstrips
