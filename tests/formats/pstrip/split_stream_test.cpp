#include "tests/support/split_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "codecs/compact/batches.h"
#include "codecs/simplify/simplify.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

using namespace test;

/// The faces of three distinct vertices, on a grid.
GridMesh on_grid(const Mesh& mesh, double scale) {
  GridMesh out;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto at = [&](std::size_t c) {
      return static_cast<std::int32_t>(std::lround(component(mesh.position, v, c) * scale));
    };
    out.positions.push_back({at(0), at(1), at(2)});
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    if (face.size() != 3) continue;
    const Index a = mesh.vertex_of(face[0]), b = mesh.vertex_of(face[1]),
                c = mesh.vertex_of(face[2]);
    if (a != b && b != c && c != a) out.triangles.insert(out.triangles.end(), {a, b, c});
  }
  return out;
}

/// Collapses along edges at random, one in twenty between any two vertices; some vertices are left.
std::vector<Collapse> random_collapses(const GridMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Index> now(mesh.positions.size());
  std::iota(now.begin(), now.end(), Index{0});
  std::vector<Index> alive = now;
  std::vector<Collapse> out;
  const auto find = [&](Index v) {
    while (now[v] != v) v = now[v];
    return v;
  };
  for (std::size_t tries = 8 * alive.size(); tries > 0 && alive.size() > 4; --tries) {
    Index kept = alive[random() % alive.size()], removed = alive[random() % alive.size()];
    if (random() % 20 != 0 && !mesh.triangles.empty()) {
      const std::size_t corner = random() % mesh.triangles.size();
      kept = find(mesh.triangles[corner]);
      removed = find(mesh.triangles[corner / 3 * 3 + (corner + 1) % 3]);
    }
    if (kept == removed) continue;
    out.push_back({.removed = removed, .kept = kept, .error = 0, .moves = 0});
    now[removed] = kept;
    std::erase(alive, removed);
  }
  return out;
}

using Triple = std::array<Index, 3>;

Triple turned(Triple t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  return t;
}

/// Triangles whose vertices are given other names; those of two equal ones vanish.
template <class Name>
std::vector<Triple> named(std::span<const Index> triangles, Name&& name) {
  std::vector<Triple> out;
  for (std::size_t c = 0; c < triangles.size(); c += 3) {
    const Triple t = {name(triangles[c]), name(triangles[c + 1]), name(triangles[c + 2])};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.push_back(turned(t));
  }
  std::ranges::sort(out);
  return out;
}

/// Decodes batch by batch and compares each level with the source and the collapses of the batches
/// that are not there yet.
void expect_every_level(const GridMesh& mesh, std::span<const Collapse> collapses,
                        const BatchOptions& options) {
  SplitStreamMap map;
  const SplitStream stream = encode_splits(mesh, collapses, options, &map);
  const auto vertices = static_cast<Index>(mesh.positions.size());
  const std::vector<Index> batch = batches_of(collapses, vertices, options);
  Result<SplitDecoder> decoder =
      SplitDecoder::start(stream.placement, stream.base, stream.vertices, stream.triangles);
  ASSERT_TRUE(decoder) << decoder.error().message;
  for (std::size_t k = 0;; ++k) {
    const auto missing = static_cast<Index>(stream.batches.size() - k);
    std::vector<Index> now(vertices);
    std::iota(now.begin(), now.end(), Index{0});
    for (std::size_t i = 0; i < collapses.size(); ++i)
      if (batch[i] < missing) now[collapses[i].removed] = collapses[i].kept;
    const auto find = [&](Index v) {
      while (now[v] != v) v = now[v];
      return v;
    };
    const GridMesh level = decoder->mesh();
    ASSERT_EQ(named(level.triangles, [&](Index v) { return find(map.vertex[v]); }),
              named(mesh.triangles, find))
        << "after " << k << " batches";
    if (options.placement == Placement::subset) {
      for (std::size_t v = 0; v < level.positions.size(); ++v)
        ASSERT_EQ(level.positions[v], mesh.positions[map.vertex[v]]);
    }
    if (missing == 0) break;
    const Result<void> added = decoder->add(stream.batches[k]);
    ASSERT_TRUE(added) << added.error().message;
  }
  const GridMesh full = decoder->mesh();
  ASSERT_EQ(full.positions.size(), mesh.positions.size());
  for (std::size_t v = 0; v < full.positions.size(); ++v)
    ASSERT_EQ(full.positions[v], mesh.positions[map.vertex[v]]);
  std::vector<Index> numbers = map.vertex;
  std::ranges::sort(numbers);
  for (Index v = 0; v < vertices; ++v) ASSERT_EQ(numbers[v], v);
  for (std::size_t f = 0; f < map.triangle.size(); ++f) {
    Triple got, want;
    for (std::size_t k = 0; k < 3; ++k) {
      got[k] = map.vertex[full.triangles[3 * f + k]];
      want[k] = mesh.triangles[std::size_t{3} * map.triangle[f] + k];
    }
    ASSERT_EQ(turned(got), turned(want)) << "triangle " << f;
  }
}

constexpr Placement kPlacements[] = {Placement::subset, Placement::optimal};

TEST(SplitStream, EveryLevelOfMeshesIsTheSourcesWithSomeCollapses) {
  const std::pair<const char*, GridMesh> kMeshes[] = {
      {"grid", on_grid(test::grid(20), 100)},
      {"torus", on_grid(test::torus(30, 12), 1000)},
      {"cube", on_grid(test::cube(false), 1)},
      {"flat", on_grid(test::torus(16, 8), 0)},  // all at one point
      {"empty", {}},
  };
  for (const auto& [name, mesh] : kMeshes)
    for (const Placement placement : kPlacements)
      for (std::uint32_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(name + std::string(" ") + std::to_string(seed));
        expect_every_level(mesh, random_collapses(mesh, seed), {.placement = placement});
      }
}

TEST(SplitStream, EveryLevelOfAnyComplex) {
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const GridMesh mesh = on_grid(test::random_soup(seed, 4 + seed % 40, seed), 50);
    for (const Placement placement : kPlacements)
      expect_every_level(mesh, random_collapses(mesh, seed), {.placement = placement});
  }
}

TEST(SplitStream, BatchesOfAnyShare) {
  const GridMesh mesh = on_grid(test::torus(20, 10), 1000);
  for (const double share : {0.001, 0.1, 0.5, 1.0})
    for (const double window : {0.1, 1.0, 2.0})
      expect_every_level(mesh, random_collapses(mesh, 1),
                         {.schedule = {{share, 1}, {share, 1}, 0.5}, .window = window});
}

TEST(SplitStream, FarthestCornersOfTheGrid) {
  GridMesh mesh = on_grid(test::torus(12, 8), 1);
  std::mt19937 random(3);
  for (GridPoint& p : mesh.positions) {
    const auto end = [&] { return random() % 2 == 0 ? kMaxGrid : -kMaxGrid; };
    p = {end(), end(), end()};
  }
  for (const Placement placement : kPlacements)
    for (std::uint32_t seed = 0; seed < 10; ++seed)
      expect_every_level(mesh, random_collapses(mesh, seed), {.placement = placement});
}

TEST(SplitStream, NamesOfVerticesAreCheap) {
  // A regular torus: what is not geometry costs few bits.
  const Mesh torus = test::torus(64, 32);
  const GridMesh mesh = on_grid(torus, 0);
  const std::vector<double> positions = positions_as_double(torus);
  SimplifyInput input;
  input.positions = positions;
  input.triangles = mesh.triangles;
  const std::vector<Collapse> collapses = simplify(input, {.target_triangles = 100}).collapses;
  const SplitStream stream = encode_splits(mesh, collapses);
  std::size_t bytes = 0;
  for (const Bytes& b : stream.batches) bytes += b.size();
  EXPECT_LT(8.0 * static_cast<double>(bytes), 8.0 * static_cast<double>(collapses.size()));
}

TEST(SplitStream, DamagedBatchesAreRefusedOrGiveAMesh) {
  const GridMesh mesh = on_grid(test::torus(20, 10), 1000);
  const SplitStream stream = encode_splits(mesh, random_collapses(mesh, 2));
  std::mt19937 random(11);
  std::size_t refused = 0, runs = 3000;
  for (std::size_t run = 0; run < runs; ++run) {
    SplitStream bad = stream;
    Bytes& batch = bad.batches[random() % bad.batches.size()];
    if (run % 3 == 0)
      batch.resize(random() % batch.size());
    else
      batch[random() % batch.size()] ^= static_cast<std::byte>(1 + random() % 255);
    auto decoder = SplitDecoder::start(bad.placement, bad.base, bad.vertices, bad.triangles);
    ASSERT_TRUE(decoder);
    bool ok = true;
    for (const Bytes& b : bad.batches) ok = ok && decoder->add(b).has_value();
    refused += ok ? 0 : 1;
    const GridMesh got = decoder->mesh();
    ASSERT_LE(got.positions.size(), mesh.positions.size());
    ASSERT_LE(got.triangles.size(), mesh.triangles.size());
    for (std::size_t c = 0; c < got.triangles.size(); c += 3) {
      const Index a = got.triangles[c], b = got.triangles[c + 1], d = got.triangles[c + 2];
      ASSERT_LT(std::max({a, b, d}), got.positions.size());
      ASSERT_TRUE(a != b && b != d && d != a);
    }
  }
  EXPECT_GT(refused, runs * 99 / 100);
}

TEST(SplitStream, BasesOutOfRangeAreRefused) {
  const GridMesh good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}};
  const auto starts = [](const GridMesh& base) {
    return SplitDecoder::start(Placement::subset, base, 3, 1).has_value();
  };
  EXPECT_TRUE(starts(good));
  GridMesh bad = good;
  bad.triangles[1] = 3;
  EXPECT_FALSE(starts(bad));
  bad.triangles[1] = 0;
  EXPECT_FALSE(starts(bad));
  bad = good;
  bad.positions[2].z = kMaxGrid + 1;
  EXPECT_FALSE(starts(bad));
  bad = good;
  bad.positions.push_back({});
  EXPECT_FALSE(starts(bad));
}

}  // namespace
}  // namespace pstrips
