// The base of a mesh: what was written comes back, whatever the order and the complex; ordered
// triangles cost little; bytes that nobody wrote are refused or give some base.

#include "formats/pstrip/payload/compact/base_code.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace pstrips {
namespace {

/// So many columns of integers.
MeshCells cells_of(unsigned columns) {
  MeshCells out{PositionCells({.step = 0}, ComponentType::i16), {}};
  if (columns > 0) out.attributes.emplace_back(Cells(ComponentType::i32, 0, true), columns);
  return out;
}

Bytes write(const BaseCounts& counts, BaseMesh mesh) {
  RansWriter writer;
  const MeshCells cells = cells_of(counts.columns);
  AttributeModels attributes(cells);
  EXPECT_TRUE(BaseCode(writer, counts, cells, attributes, mesh).run());
  return writer.finish();
}

Result<BaseMesh> read(const BaseCounts& counts, ByteView bytes) {
  RansReader reader(bytes);
  BaseMesh mesh;
  const MeshCells cells = cells_of(counts.columns);
  AttributeModels attributes(cells);
  if (auto ok = BaseCode(reader, counts, cells, attributes, mesh).run(); !ok)
    return tl::unexpected(ok.error());
  if (!reader.complete()) return fail(ErrorCode::corrupt, "incomplete");
  return mesh;
}

BaseCounts counts_of(const BaseMesh& mesh, Index groups, bool single) {
  return {static_cast<Index>(mesh.positions.size()),
          static_cast<Index>(mesh.wedge_vertex.size()),
          static_cast<Index>(mesh.corners.size() / 3),
          groups,
          mesh.columns,
          single};
}

/// Triangles between random wedges: anything but a manifold.
BaseMesh random_base(std::uint32_t seed, bool single) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<Index>(random() % n); };
  BaseMesh mesh;
  const Index vertices = 3 + below(20);
  for (Index v = 0; v < vertices; ++v)
    mesh.positions.push_back({static_cast<std::int32_t>(below(2000)) - 1000,
                              static_cast<std::int32_t>(below(100)), -kMaxGrid});
  for (Index v = 0; v < vertices; ++v)
    for (Index n = single ? 1 : 1 + below(3); n > 0; --n) mesh.wedge_vertex.push_back(v);
  if (!single) std::ranges::shuffle(mesh.wedge_vertex, random);
  mesh.columns = below(4);
  for (std::size_t i = 0; i < mesh.wedge_vertex.size() * mesh.columns; ++i)
    mesh.wedge_cells.push_back(static_cast<std::int32_t>(below(512)) - 256);
  for (Index t = below(60); t > 0;) {
    std::array<Index, 3> w{};
    for (Index& each : w) each = below(static_cast<Index>(mesh.wedge_vertex.size()));
    const auto v = [&](unsigned k) { return mesh.wedge_vertex[w[k]]; };
    if (v(0) == v(1) || v(1) == v(2) || v(2) == v(0)) continue;
    mesh.corners.insert(mesh.corners.end(), w.begin(), w.end());
    mesh.group.push_back(below(3));
    --t;
  }
  return mesh;
}

/// A rolled-out grid of n by n squares in breadth-first order from one corner.
BaseMesh grid_base(Index n) {
  std::vector<std::array<Index, 3>> triangles;
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x < n; ++x) {
      const Index a = y * (n + 1) + x;
      triangles.push_back({a, a + 1, a + n + 2});
      triangles.push_back({a, a + n + 2, a + n + 1});
    }
  std::vector<std::array<Index, 3>> ordered{triangles[0]};
  std::vector<bool> used(triangles.size());
  used[0] = true;
  std::deque<std::pair<Index, Index>> gates{{1, n + 2}, {n + 2, 0}, {0, 1}};
  for (; !gates.empty(); gates.pop_front()) {
    const auto [from, to] = gates.front();
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (unsigned k = 0; k < 3; ++k) {
        const Index v0 = triangles[t][k], v1 = triangles[t][(k + 1) % 3],
                    v2 = triangles[t][(k + 2) % 3];
        if (used[t] || v0 != to || v1 != from) continue;
        used[t] = true;
        ordered.push_back({v0, v1, v2});
        gates.push_back({v1, v2});
        gates.push_back({v2, v0});
      }
  }
  BaseMesh mesh;
  std::vector<Index> number((n + 1) * (n + 1), kNone);
  for (const auto& triangle : ordered)
    for (const Index v : triangle) {
      if (number[v] == kNone) {
        number[v] = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back({static_cast<std::int32_t>(v % (n + 1) * 64),
                                  static_cast<std::int32_t>(v / (n + 1) * 64), 0});
      }
      mesh.corners.push_back(number[v]);
    }
  mesh.wedge_vertex.resize(mesh.positions.size());
  std::iota(mesh.wedge_vertex.begin(), mesh.wedge_vertex.end(), Index{0});
  mesh.group.assign(ordered.size(), 0);
  return mesh;
}

TEST(BaseCode, GivesAnyBaseBack) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const bool single = seed % 2 == 0;
    const BaseMesh mesh = random_base(seed, single);
    const BaseCounts counts = counts_of(mesh, 3, single);
    const Result<BaseMesh> back = read(counts, write(counts, mesh));
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(*back, mesh) << seed;
  }
}

TEST(BaseCode, SpendsFewBitsOnTrianglesInOrder) {
  const BaseMesh mesh = grid_base(10);
  const BaseCounts counts = counts_of(mesh, 1, true);
  const Bytes bytes = write(counts, mesh);
  EXPECT_EQ(read(counts, bytes).value(), mesh);
  EXPECT_LT(static_cast<double>(bytes.size()) * 8 / counts.triangles, 4.5);
}

TEST(BaseCode, RefusesTruncatedBytes) {
  const BaseMesh mesh = random_base(7, false);
  const BaseCounts counts = counts_of(mesh, 3, false);
  const Bytes bytes = write(counts, mesh);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_FALSE(read(counts, ByteView(bytes).first(n)));
}

TEST(BaseCode, GivesAWellFormedBaseOrAnErrorForAnyBytes) {
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    const bool single = i % 2 == 0;
    const BaseMesh mesh = random_base(static_cast<std::uint32_t>(i), single);
    const BaseCounts counts = counts_of(mesh, 3, single);
    Bytes bytes = write(counts, mesh);
    for (int n = 1 + i % 4; n > 0; --n)
      bytes[random() % bytes.size()] ^= std::byte(1u << random() % 8);
    RansReader reader(bytes);
    BaseMesh back;
    const MeshCells cells = cells_of(counts.columns);
    AttributeModels attributes(cells);
    if (!BaseCode(reader, counts, cells, attributes, back).run()) continue;
    for (std::size_t c = 0; c < back.corners.size(); ++c) {
      ASSERT_LT(back.corners[c], counts.wedges);
      const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
      ASSERT_NE(back.wedge_vertex[back.corners[c]], back.wedge_vertex[back.corners[next]]);
    }
    for (const Index v : back.wedge_vertex) ASSERT_LT(v, counts.vertices);
    for (const Index g : back.group) ASSERT_LT(g, 3u);
  }
}

}  // namespace
}  // namespace pstrips
