#include "converters/level_cost.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "codecs/stripify/delaunay.h"
#include "codecs/stripify/random.h"
#include "converters/encode.h"
#include "converters/inspect.h"
#include "tests/support/growth.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

Collapse collapse(Index removed, Index kept) {
  return {.removed = removed, .kept = kept, .error = 0, .moves = 0};
}

// Of each triangle, the first side that collapses make a point; found by making them.
std::vector<std::uint8_t> by_replay(std::span<const Index> triangles, Index vertices,
                                    std::span<const Collapse> collapses, std::uint8_t cost) {
  std::vector<Index> stands_at(vertices);
  for (Index v = 0; v < vertices; ++v) stands_at[v] = v;
  std::vector<std::uint8_t> out(triangles.size());
  std::vector<bool> vanished(triangles.size() / 3);
  for (const Collapse& c : collapses) {
    for (Index& v : stands_at)
      if (v == c.removed) v = c.kept;
    for (std::size_t t = 0; t < vanished.size(); ++t)
      for (std::size_t k = 0; k < 3 && !vanished[t]; ++k)
        if (stands_at[triangles[3 * t + k]] == stands_at[triangles[3 * t + (k + 1) % 3]]) {
          vanished[t] = true;
          out[3 * t + k] = cost;
        }
  }
  return out;
}

RC_GTEST_PROP(LevelCost, IsThatOfTheSideThatVanishesFirst, ()) {
  const auto vertices = *rc::gen::inRange<Index>(3, 30);
  const auto vertex = rc::gen::inRange<Index>(0, vertices);
  std::vector<Index> triangles;
  for (int i = *rc::gen::inRange(0, 60); i > 0; --i) {
    const Index a = *vertex, b = *vertex, c = *vertex;
    if (a != b && b != c && a != c) triangles.insert(triangles.end(), {a, b, c});
  }
  std::vector<Index> left(vertices);
  for (Index v = 0; v < vertices; ++v) left[v] = v;
  std::vector<Collapse> collapses;
  for (int i = *rc::gen::inRange(0, static_cast<int>(vertices)); i > 0; --i) {
    std::swap(left[*rc::gen::inRange<std::size_t>(0, left.size())], left.back());
    const Index removed = left.back();
    left.pop_back();
    collapses.push_back(collapse(removed, left[*rc::gen::inRange<std::size_t>(0, left.size())]));
  }
  RC_ASSERT(level_step_cost(triangles, vertices, collapses, 7) ==
            by_replay(triangles, vertices, collapses, 7));
}

// A chain in which each vertex goes to the next: what follows it link by link is quadratic.
struct Chain {
  Index vertices = 0;
  std::vector<Index> triangles;
  std::vector<Collapse> collapses;
};

Chain chain(Index vertices) {
  Chain out{vertices, {}, {}};
  for (Index v = 0; v + 2 < vertices; ++v) {
    out.triangles.insert(out.triangles.end(), {v, v + 1, v + 2});
    out.collapses.push_back(collapse(v, v + 1));
  }
  return out;
}

TEST(LevelCost, IsLinearOnLongChains) {
  const auto run = [](const Chain& c) {
    return level_step_cost(c.triangles, c.vertices, c.collapses, 1);
  };
  EXPECT_TRUE(test::grows_linearly(100'000, chain, run));
  const auto cost = run(chain(400'000));
  EXPECT_EQ(cost[0], 1);
  EXPECT_EQ(cost[3], 1);
  EXPECT_EQ(cost[4], 0);
}

// Random points, as regular meshes leave little to choose.
Mesh irregular() {
  Random random(5);
  std::vector<float> positions;
  std::vector<double> exact;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.below(1 << 20) / 1e5, y = random.below(1 << 20) / 1e5;
    for (const double c : {x, y, std::sin(x) * std::cos(y)}) {
      positions.push_back(static_cast<float>(c));
      exact.push_back(c);
    }
  }
  return test::triangle_mesh(std::move(positions), delaunay_triangles(exact, {}));
}

std::uint64_t sent_at_all_levels(std::uint32_t level_cost, std::uint64_t& full) {
  Model model;
  model.meshes = {irregular()};
  EncodeOptions options;
  options.strip_options.effort = 50;
  options.level_cost = level_cost;
  const auto strips = encode(model, options);
  EXPECT_TRUE(strips);
  const Inspection figures = inspect(*strips);
  std::uint64_t sum = 0;
  for (const auto& level : figures.levels) sum += level.vertices_sent;
  full = figures.levels.back().vertices_sent;
  return sum;
}

// Fewer entries on the way are bought with some at the end.
TEST(LevelCost, BringsDownWhatCoarseLevelsSend) {
  std::uint64_t full_without = 0, full_with = 0;
  const std::uint64_t without = sent_at_all_levels(0, full_without);
  const std::uint64_t with = sent_at_all_levels(1, full_with);
  EXPECT_LT(with * 100, without * 98);
  EXPECT_GE(full_with, full_without);
}

}  // namespace
}  // namespace pstrips
