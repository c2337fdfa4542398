// FINE: a mesh whose numbers are known to their cells becomes the mesh that was written.

#include "formats/pstrip/payload/compact/fine.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/progressive.h"

namespace pstrips {
namespace {

ProgressiveMesh mesh_with(Placement placement, std::uint32_t seed) {
  test::ProgressiveOptions options;
  options.encoding = MapEncoding::naive;
  options.vsplits = 30;
  ProgressiveMesh mesh = test::random_progressive(seed, options).meshes[0];
  std::mt19937_64 random(seed);
  const auto fill = [&](Attribute& a, ComponentType type, std::size_t elements) {
    a.type = type;
    a.count = 3;
    a.data.resize(elements * a.element_bytes());
    for (std::byte& b : a.data) b = static_cast<std::byte>(random());
  };
  fill(mesh.position, ComponentType::f32, mesh.vertices);
  mesh.placement = placement;
  mesh.parent_position.clear();
  if (placement == Placement::optimal) {
    mesh.parent_position.resize(mesh.vsplits.size() * mesh.position.element_bytes());
    for (std::byte& b : mesh.parent_position) b = static_cast<std::byte>(random());
  }
  mesh.wedge_attributes.resize(2);
  fill(mesh.wedge_attributes[0], ComponentType::f64, mesh.wedges);
  fill(mesh.wedge_attributes[1], ComponentType::u32, mesh.wedges);
  return mesh;
}

MeshCells cells_of_mesh() {
  return {PositionCells({.step = 0.125f, .exact = false}, ComponentType::f32),
          {{Cells(ComponentType::f64, -10, false), 3}, {Cells(ComponentType::u32, 9, false), 3}}};
}

/// Replaces each number by what stands for its cell.
void forget_fine_bits(ProgressiveMesh& mesh, const MeshCells& cells) {
  const auto forget = [](Bytes& data, const Cells& of) {
    for (std::size_t at = 0; at < data.size(); at += size_of(of.type())) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, data.data() + at, size_of(of.type()));
      bits = of.middle(of.cell_of(bits));
      std::memcpy(data.data() + at, &bits, size_of(of.type()));
    }
  };
  forget(mesh.position.data, *cells.positions.cells());
  for (std::size_t a = 0; a < 2; ++a)
    forget(mesh.wedge_attributes[a].data, cells.attributes[a].own());
}

TEST(Fine, BringsTheBitsBelowTheCells) {
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    const ProgressiveMesh mesh = mesh_with(Placement::subset, seed);
    const MeshCells cells = cells_of_mesh();
    ASSERT_FALSE(is_exact(cells));
    Bytes bytes(fine_bytes(mesh, cells));
    write_fine(mesh, cells, bytes);
    ProgressiveMesh coarse = mesh;
    forget_fine_bits(coarse, cells);
    ASSERT_NE(coarse, mesh);
    ASSERT_EQ(fine_bytes(coarse, cells), bytes.size());
    ASSERT_TRUE(read_fine(bytes, cells, coarse));
    EXPECT_EQ(coarse, mesh);
  }
}

TEST(Fine, IsOfTheLastPositionOfEachVertex) {
  const ProgressiveMesh mesh = mesh_with(Placement::optimal, 3);
  const MeshCells cells = cells_of_mesh();
  Bytes bytes(fine_bytes(mesh, cells));
  write_fine(mesh, cells, bytes);
  ProgressiveMesh changed = mesh;
  // Bits of positions that are passed on the way count for nothing.
  std::vector<bool> is_last(mesh.vsplits.size());
  std::vector<Index> last(mesh.vertices, kNone);
  for (Index i = 0; i < mesh.vsplits.size(); ++i) last[mesh.vsplits[i].parent] = i;
  for (Index v = 0; v < mesh.vertices; ++v)
    if (last[v] != kNone) is_last[last[v]] = true;
  const std::size_t size = mesh.position.element_bytes();
  for (Index i = 0; i < mesh.vsplits.size(); ++i)
    if (!is_last[i])
      std::fill_n(changed.parent_position.begin() + i * std::ptrdiff_t(size), size, std::byte{0});
  EXPECT_EQ(fine_bytes(changed, cells), bytes.size());
  Bytes again(bytes.size());
  write_fine(changed, cells, again);
  EXPECT_EQ(again, bytes);
}

TEST(Fine, RefusesAnotherLengthAndBitsBehindTheLast) {
  ProgressiveMesh mesh = mesh_with(Placement::subset, 4);
  const ProgressiveMesh before = mesh;
  const MeshCells cells = cells_of_mesh();
  Bytes bytes(fine_bytes(mesh, cells));
  write_fine(mesh, cells, bytes);
  EXPECT_FALSE(read_fine(ByteView(bytes).first(bytes.size() - 1), cells, mesh));
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(read_fine(longer, cells, mesh));
  EXPECT_EQ(mesh, before);
}

TEST(Fine, IsNotNeededForExactCells) {
  EXPECT_TRUE(is_exact({PositionCells({.step = 0.1f}, ComponentType::f32),
                        {{Cells(ComponentType::u8, 0, true), 1}}}));
}

}  // namespace
}  // namespace pstrips
