// Scenes of several meshes: how large instances are, and in which order packets come.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/scene_level.h"
#include "formats/pstrip/payload/check.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace pstrips {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Node node_of(std::array<double, 9> linear, std::vector<Index> meshes, Index parent = kNone) {
  Node node;
  node.parent = parent;
  for (std::size_t k = 0; k < 9; ++k) node.matrix[k / 3 * 4 + k % 3] = linear[k];
  node.meshes = std::move(meshes);
  return node;
}

Node scaled_by(double x, double y, double z, std::vector<Index> meshes, Index parent = kNone) {
  return node_of({x, 0, 0, 0, y, 0, 0, 0, z}, std::move(meshes), parent);
}

TEST(InstanceScales, AreTheLargestSingularValues) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const struct {
    const char* name;
    Node node;
    double scale;
  } kRows[] = {
      {"unit", scaled_by(1, 1, 1, {0}), 1},
      {"one_axis", scaled_by(1, 5, 2, {0}), 5},
      {"mirrored", scaled_by(-3, 1, 1, {0}), 3},
      {"turned", node_of({c, s, 0, -s, c, 0, 0, 0, 1}, {0}), 1},
      {"turned_and_scaled", node_of({4 * c, 4 * s, 0, -s, c, 0, 0, 0, 2}, {0}), 4},
      {"sheared", node_of({1, 0, 0, 1, 1, 0, 0, 0, 1}, {0}), (1 + std::sqrt(5)) / 2},
      {"flat", node_of({3, 4, 0, 0, 0, 0, 0, 0, 0}, {0}), 5},
      {"nothing", scaled_by(0, 0, 0, {0}), 0},
      {"huge", scaled_by(1e300, 1e300, 1e200, {0}), 1e300},
      {"tiny", scaled_by(1e-300, 0, 0, {0}), 1e-300},
      {"infinite", scaled_by(1, kInfinity, 1, {0}), 1},
      {"no_number", scaled_by(std::nan(""), 2, 2, {0}), 1},
  };
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.name);
    Scene scene;
    scene.nodes = {row.node};
    EXPECT_NEAR(instance_scales(scene, 1)[0], row.scale, 1e-8 * row.scale);
  }
}

TEST(InstanceScales, MultiplyDownTheTreeAndTakeTheLargestInstance) {
  Scene scene;
  scene.nodes = {scaled_by(2, 2, 2, {}), scaled_by(3, 1, 1, {0}, 0), scaled_by(1, 1, 0.5, {0, 1}),
                 scaled_by(0.1, 0.1, 0.1, {2}, 1)};
  const std::vector<double> scale = instance_scales(scene, 4);
  EXPECT_DOUBLE_EQ(scale[0], 6);
  EXPECT_DOUBLE_EQ(scale[1], 1);
  EXPECT_NEAR(scale[2], 0.6, 1e-12);
  EXPECT_EQ(scale[3], 1) << "no instance";
}

EncodeOptions small_packets() {
  EncodeOptions options;
  options.packet_min = 24;
  return options;
}

TEST(Encode, NextComesTheMeshWhoseScaledErrorIsLargest) {
  Model model = test::scene_of_tori(9);
  model.scene.nodes[4].matrix = {};  // scaled to nothing: comes last
  const auto strips = encode(model, small_packets());
  ASSERT_TRUE(strips);
  EXPECT_TRUE(check(*strips));
  const std::vector<double> scale = instance_scales(model.scene, 9);
  std::vector<double> now;
  for (const Packet& base : strips->bases) now.push_back(base.error * scale[base.mesh]);
  std::vector<std::size_t> left(9);
  for (const Packet& packet : strips->packets) ++left[packet.mesh];
  Index changes = 0;
  for (std::size_t k = 0; k < strips->packets.size(); ++k) {
    const Packet& packet = strips->packets[k];
    for (Index m = 0; m < 9; ++m) {
      if (left[m] > 0) {
        EXPECT_GE(now[packet.mesh], now[m]) << "packet " << k;
      }
    }
    if (k > 0 && packet.mesh != strips->packets[k - 1].mesh) ++changes;
    now[packet.mesh] = packet.error * scale[packet.mesh];
    --left[packet.mesh];
  }
  EXPECT_GT(changes, 20u);
  EXPECT_EQ(strips->packets.back().mesh, 4u);
}

TEST(Encode, RefusesASceneThatNamesWhatIsNotThere) {
  Model model = test::scene_of_tori(2);
  model.scene.nodes[1].meshes = {2};
  EXPECT_EQ(encode(model, {}).error().code, ErrorCode::bad_argument);
  model.scene.nodes[1].meshes = {1};
  model.scene.nodes[0].parent = 1;
  EXPECT_EQ(encode(model, {}).error().code, ErrorCode::bad_argument);
}

TEST(Scene, AnyPrefixOfAHundredMeshesIsBetterThanMeshAfterMesh) {
  constexpr int kPrefixes = 10;
  const auto strips = encode(test::scene_of_tori(100), small_packets());
  ASSERT_TRUE(strips);
  const ProgressiveStrips sequential = test::mesh_after_mesh(*strips);
  ASSERT_TRUE(check(sequential)) << "any order is valid";
  const auto ours = test::error_over_bytes(*strips, kPrefixes);
  const auto theirs = test::error_over_bytes(sequential, kPrefixes);
  for (int k = 0; k < kPrefixes; ++k) {
    SCOPED_TRACE(ours[k].share);
    EXPECT_LE(ours[k].max, theirs[k].max);
    EXPECT_LE(ours[k].sum, theirs[k].sum);
    if (k < 2 || k > 7) continue;  // the ends have little or everything in common
    EXPECT_LT(ours[k].max, 0.2 * theirs[k].max);
    EXPECT_LT(ours[k].sum, 0.5 * theirs[k].sum);
  }
}

TEST(SceneLevel, AddsUpWhatAllMeshesShow) {
  const Model model = test::scene_of_tori(7);
  const auto strips = encode(model, small_packets());
  ASSERT_TRUE(strips);
  const std::vector<double> scale = instance_scales(model.scene, 7);
  std::vector<Packet> now = strips->bases;
  SceneLevel level(*strips);
  for (std::size_t k = 0; k <= strips->packets.size(); ++k) {
    if (k > 0) {
      level.add(strips->packets[k - 1]);
      now[strips->packets[k - 1].mesh] = strips->packets[k - 1];
    }
    std::uint64_t vertices = 0, triangles = 0, count = 0;
    double error = 0;
    for (const Packet& p : now) {
      vertices += p.vertices;
      triangles += p.triangles;
      count += p.strips;
      error = std::max(error, p.error * scale[p.mesh]);
    }
    ASSERT_EQ(level.vertices(), vertices);
    ASSERT_EQ(level.triangles(), triangles);
    ASSERT_EQ(level.strips(), count);
    ASSERT_EQ(level.error(), error);
    ASSERT_LE(packets_for(*strips, {.error = error}), k);
  }
  EXPECT_EQ(level.error(), 0);
}

TEST(SceneLevel, OfNoMeshesIsEmpty) {
  const SceneLevel level{ProgressiveStrips{}};
  EXPECT_EQ(level.error(), 0);
  EXPECT_EQ(level.triangles(), 0u);
}

}  // namespace
}  // namespace pstrips
