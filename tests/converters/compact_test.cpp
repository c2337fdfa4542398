// The compact profile from model to records: batches, the grid of positions, bounds, packets.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "codecs/measure/measure.h"
#include "codecs/vsplit/level.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/position_grid.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/compact/cells.h"
#include "formats/pstrip/payload/digest.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.meshes = std::move(meshes);
  return model;
}

Mesh shifted(Mesh mesh, double scale, double by) {
  for (std::size_t i = 0; i < mesh.position.elements() * 3; ++i)
    set_component(mesh.position, 0, i, component(mesh.position, 0, i) * scale + by);
  return mesh;
}

Mesh with_positions(const Mesh& mesh, ComponentType type) {
  Mesh out = mesh;
  out.position = {"POSITION", type, 3, false, {}};
  out.position.data.resize(out.position.element_bytes() * mesh.vertex_count());
  for (std::size_t i = 0; i < 3 * std::size_t{mesh.vertex_count()}; ++i)
    set_component(out.position, 0, i, 12 * component(mesh.position, 0, i));
  return out;
}

ProgressiveStrips encoded(const Model& model, const EncodeOptions& options) {
  auto strips = encode(model, options);
  EXPECT_TRUE(strips) << strips.error().message;
  const auto ok = check(*strips);
  EXPECT_TRUE(ok) << ok.error().message << " at " << ok.error().path;
  return std::move(strips).value();
}

constexpr Placement kPlacements[] = {Placement::subset, Placement::optimal};

TEST(Compact, AnySoupComesBackExactly) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Model model = model_of({test::random_soup(seed, seed % 60, 2 * (seed % 50)),
                                  test::polygon_soup(seed, 4 + seed % 30, seed % 40)});
    for (const Placement placement : kPlacements)
      for (const std::optional<double> base_error : {std::optional<double>(), {0.2}, {1e9}}) {
        const ProgressiveStrips strips = encoded(model, {.profile = Profile::compact,
                                                         .base_error = base_error,
                                                         .placement = placement,
                                                         .keep_order = true});
        ASSERT_EQ(decode(strips)->meshes, model.meshes);
        for (std::size_t m = 0; m < 2 && base_error; ++m)
          ASSERT_LE(strips.bases[m].error, static_cast<float>(*base_error));
      }
  }
}

TEST(Compact, MapsOfTrianglesGoIntoThePlainProfile) {
  const Model model = model_of({test::torus(30, 20)});
  for (const Placement placement : kPlacements) {
    const ProgressiveStrips strips = encoded(
        model, {.encoding = MapEncoding::triangles, .placement = placement, .keep_order = true});
    EXPECT_EQ(strips.profile, Profile::plain);
    EXPECT_EQ(strips.meshes[0].encoding, MapEncoding::triangles);
    EXPECT_EQ(decode(strips)->meshes, model.meshes);
  }
}

// Each packet is a batch; the base has some 200 vertices.
TEST(Compact, PacketsGrowByAShare) {
  const ProgressiveStrips strips =
      encoded(model_of({test::torus(100, 80)}), {.profile = Profile::compact});
  EXPECT_LE(strips.bases[0].triangles, kCompactBaseTriangles);
  EXPECT_GT(strips.bases[0].triangles, kCompactBaseTriangles / 2);
  Index before = strips.bases[0].vertices;
  for (const Packet& packet : strips.packets) {
    EXPECT_EQ(packet.strips, packet.triangles);
    EXPECT_LE(packet.vsplits, 0.6 * before);
    before = packet.vertices;
  }
  EXPECT_EQ(before, 8000u);
  EXPECT_LT(strips.packets.size(), 25u);
}

// The order by bits does what it is for: files of fewer bytes.
TEST(Compact, OrderByBitsTakesFewer) {
  const Model model = model_of({test::grid(120)});
  const auto bytes = [&](CollapseOrder order) {
    const ProgressiveStrips strips =
        encoded(model, {.profile = Profile::compact, .position_bits = 12, .order = order});
    const auto file = write_binary(strips);
    EXPECT_TRUE(file) << file.error().message;
    return file->size();
  };
  EXPECT_LT(bytes(CollapseOrder::bits), bytes(CollapseOrder::error));
}

// What bounds claim, by sampling: the surfaces are no farther apart.
// The effort does as well, and both decode to the same.
TEST(Compact, SmallTakesFewer) {
  const Model model = model_of({test::torus(120, 60)});
  const auto strips_of = [&](Effort effort) {
    return encoded(model, {.profile = Profile::compact, .position_bits = 12, .effort = effort});
  };
  const ProgressiveStrips fast = strips_of(Effort::fast), small = strips_of(Effort::small);
  EXPECT_EQ(decode(fast)->meshes, decode(small)->meshes);
  const auto bytes = [](const ProgressiveStrips& strips) { return write_binary(strips)->size(); };
  EXPECT_LT(bytes(small), bytes(fast) * 99 / 100);
}

TEST(Compact, BoundsHoldAtTheEndOfBatches) {
  const Model model = model_of({test::torus(60, 40)});
  for (const Placement placement : kPlacements)
    for (const unsigned bits : {0u, 12u}) {
      const ProgressiveStrips strips = encoded(
          model, {.profile = Profile::compact, .position_bits = bits, .placement = placement});
      const Mesh full = decode(strips)->meshes[0];
      const std::vector<double> all = positions_as_double(full);
      for (std::size_t k = 0; k < strips.packets.size(); k += 3) {
        const float bound = k == 0 ? strips.bases[0].error : strips.packets[k - 1].error;
        const Mesh level = decode(strips, k)->meshes[0];
        const std::vector<double> at = positions_as_double(level);
        const Surface surface{at, level.corners};
        EXPECT_LE(measure_distance(surface, {all, full.corners}, 2000).hausdorff, bound) << k;
      }
      EXPECT_EQ(strips.packets.back().error, 0);
    }
}

TEST(Compact, QuantizedPositionsLieOnOneGrid) {
  const Model model = model_of({test::torus(30, 20), shifted(test::grid(20), 0.1, -3),
                                with_positions(test::cube(true), ComponentType::f64)});
  for (const unsigned bits : {8u, 12u, 16u, 24u}) {
    std::vector<SimplifyReport> reports;
    const auto strips =
        encode(model, {.profile = Profile::compact, .position_bits = bits, .keep_order = true}, {},
               &reports);
    ASSERT_TRUE(strips) << strips.error().message;
    ASSERT_TRUE(check(*strips));
    const std::vector<Mesh> back = decode(*strips)->meshes;
    const PositionGrid grid = strips->meshes[0].grid;
    EXPECT_TRUE(grid.exact);
    const double most = std::sqrt(3.0) * (0.501 * grid.step + 0x1p-23 * 12);
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_EQ(strips->meshes[m].grid, grid);
      EXPECT_LE(reports[m].moved, most);
      const PositionCells cells(grid, ComponentType::f32);
      EXPECT_EQ(back[m].position.type, ComponentType::f32);
      const Attribute &at = back[m].position, &from = model.meshes[m].position;
      for (std::size_t i = 0; i < at.elements() * 3; ++i) {
        const auto axis = static_cast<unsigned>(i % 3);
        const std::uint64_t bits_at = bits_of(at, i / 3, axis);
        ASSERT_EQ(cells.component(cells.cell_of(bits_at, axis), axis), bits_at);
        const double x = component(from, 0, i);
        // Doubles become floats before, points of the grid afterwards.
        ASSERT_LE(std::abs(component(at, 0, i) - x), 0.501 * grid.step + 0x1p-23 * std::abs(x));
      }
      EXPECT_EQ(back[m].corners, model.meshes[m].corners);
    }
  }
}

// The compact profile takes for granted where parents stand before a split.
TEST(Compact, MiddlesAreOfTheGrid) {
  for (const Mesh& mesh :
       {test::torus(30, 20), with_positions(test::torus(30, 20), ComponentType::i16)})
    for (const unsigned bits : {0u, 12u}) {
      if (bits > 0 && mesh.position.type != ComponentType::f32) continue;
      const ProgressiveStrips strips = encoded(
          model_of({mesh}),
          {.profile = Profile::compact, .position_bits = bits, .placement = Placement::optimal});
      const ProgressiveMesh& to = strips.meshes[0];
      const PositionCells cells(to.grid, to.position.type);
      Attribute parents = to.position.format();
      parents.data = to.parent_position;
      Attribute now = to.position;
      for (std::size_t k = 0; k < to.vsplits.size(); ++k)
        for (unsigned c = 0; c < 3; ++c) {
          const Index parent = to.vsplits[k].parent;
          const std::int32_t before = cells.cell_of(bits_of(now, parent, c), c),
                             after = cells.cell_of(bits_of(parents, k, c), c),
                             added = cells.cell_of(bits_of(now, to.base_vertices + k, c), c);
          ASSERT_EQ(before, after + ((added - after) >> 1));
          ASSERT_EQ(bits_of(now, parent, c), cells.component(before, c));
          set_bits(now, parent, c, bits_of(parents, k, c));
        }
    }
}

TEST(Compact, GridsFitWhatTheyAreFor) {
  const auto grid_of = [](const std::vector<Mesh>& meshes, unsigned bits = 0) {
    const auto grid = position_grid(model_of(meshes), bits);
    EXPECT_TRUE(grid) << grid.error().message;
    return *grid;
  };
  const Mesh torus = test::torus(20, 10);
  // Cells: a power of two, none finer than numbers are told by.
  const PositionGrid cells = grid_of({torus});
  EXPECT_FALSE(cells.exact);
  EXPECT_TRUE(PositionCells::is_valid(cells, ComponentType::f32));
  EXPECT_GE(grid_of({shifted(torus, 1, 1e6)}).step, 1e6 / (1 << 23));
  EXPECT_TRUE(PositionCells::is_valid(grid_of({shifted(torus, 1e-44, 0)}), ComponentType::f32));
  EXPECT_TRUE(PositionCells::is_valid(grid_of({shifted(torus, 1e37, 0)}), ComponentType::f32));
  EXPECT_TRUE(PositionCells::is_valid(grid_of({with_positions(torus, ComponentType::f64)}),
                                      ComponentType::f64));
  // Whole numbers are points of a grid as they are.
  const Mesh block = shifted(test::voxel_torus(12), 4, 0);
  const PositionGrid own = grid_of({block});
  EXPECT_TRUE(own.exact);
  Mesh moved = block;
  EXPECT_EQ(move_to_grid(moved, own), 0);
  EXPECT_EQ(moved, block);
  EXPECT_EQ(grid_of({with_positions(torus, ComponentType::u8)}), PositionGrid{});
  for (const unsigned bits : {8u, 24u}) {
    for (const double scale : {1e-44, 1e-3, 1e6, 1e37})
      for (const double by : {0.0, 1e6, -1e-30}) {
        const PositionGrid grid = grid_of({shifted(torus, scale, by)}, bits);
        EXPECT_TRUE(PositionCells::is_valid(grid, ComponentType::f32)) << scale << " " << by;
      }
    EXPECT_TRUE(PositionCells::is_valid(grid_of({shifted(torus, 0, 5)}, bits), ComponentType::f32));
    EXPECT_TRUE(PositionCells::is_valid(grid_of({Mesh()}, bits), ComponentType::f32));
  }
}

TEST(Compact, IntegersOf32BitsComeBackExactly) {
  for (const ComponentType type : {ComponentType::i32, ComponentType::u32})
    for (const double scale : {1.0, 1000.0, 0x1p27}) {
      Mesh mesh = with_positions(test::torus(24, 17), ComponentType::f64);
      const Attribute from = mesh.position;
      mesh.position = {"POSITION", type, 3, false, {}};
      mesh.position.data.resize(mesh.position.element_bytes() * from.elements());
      for (std::size_t i = 0; i < 3 * from.elements(); ++i)
        set_component(mesh.position, 0, i,
                      std::round(component(from, 0, i) * scale / 16) +
                          (type == ComponentType::u32 ? 2 * scale : 0));
      set_component(mesh.position, 5, 0, type == ComponentType::u32 ? 0xffff'ffff : -0x8000'0000ll);
      for (const Placement placement : kPlacements) {
        const ProgressiveStrips strips =
            encoded(model_of({mesh}),
                    {.profile = Profile::compact, .placement = placement, .keep_order = true});
        const auto file = write_binary(strips);
        ASSERT_TRUE(file) << file.error().message;
        const auto read = read_binary(*file);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(decode(*read)->meshes[0], mesh);
      }
    }
}

TEST(Compact, WhatNoGridTakesIsRefused) {
  const Mesh torus = test::torus(8, 6);
  Mesh hole = torus;
  set_component(hole.position, 3, 1, std::numeric_limits<double>::quiet_NaN());
  const auto code = [](const Mesh& mesh, unsigned bits, Profile profile = Profile::compact) {
    const auto strips =
        encode(model_of({mesh}), {.profile = profile, .position_bits = bits, .keep_order = true});
    if (strips) {
      EXPECT_EQ(decode(*strips)->meshes[0].corners, mesh.corners);
    }
    return strips ? std::optional<ErrorCode>() : strips.error().code;
  };
  EXPECT_EQ(code(hole, 12), ErrorCode::unsupported);
  EXPECT_EQ(code(hole, 0), std::nullopt);
  EXPECT_EQ(code(with_positions(torus, ComponentType::f64), 12), std::nullopt);
  EXPECT_EQ(code(with_positions(torus, ComponentType::f64), 0), std::nullopt);
  EXPECT_EQ(code(with_positions(torus, ComponentType::i16), 12), ErrorCode::unsupported);
  EXPECT_EQ(code(with_positions(torus, ComponentType::i16), 0), std::nullopt);
  EXPECT_EQ(code(with_positions(torus, ComponentType::i32), 12), ErrorCode::unsupported);
  EXPECT_EQ(code(torus, 7), ErrorCode::bad_argument);
  EXPECT_EQ(code(torus, 25), ErrorCode::bad_argument);
  EXPECT_EQ(code(torus, 12, Profile::plain), ErrorCode::bad_argument);
}

}  // namespace
}  // namespace pstrips
