#include "codecs/weld/weld.h"

#include <gtest/gtest.h>

#include <limits>

#include "codecs/weld/places.h"
#include "codecs/weld/unweld.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

using test::triangle_mesh;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST(Places, AreValuesAndNotBits) {
  const Mesh mesh = triangle_mesh({0, 1, 2, -0.f, 1, 2, 0, 1, 2.0000002f, 3, 0, 0, 3, -0.f, 0}, {});
  EXPECT_EQ(places(mesh.position, 0), (std::vector<Index>{0, 0, 2, 3, 3}));
}

TEST(Places, AreBallsAroundTheFirst) {
  // The third is near the second, which is in the ball of the first; the fourth opens another.
  const Mesh mesh = triangle_mesh({0, 0, 0, 0.9f, 0, 0, 1.8f, 0, 0, 2.7f, 0, 0}, {});
  EXPECT_EQ(places(mesh.position, 1), (std::vector<Index>{0, 0, 2, 2}));
}

TEST(Places, LieAcrossCells) {
  const Mesh mesh = triangle_mesh({-0.01f, -0.01f, -0.01f, 0.01f, 0.01f, 0.01f}, {});
  EXPECT_EQ(places(mesh.position, 0.1), (std::vector<Index>{0, 0}));
}

TEST(Places, HaveNobodyNearWhatIsNotFinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Mesh mesh = triangle_mesh({kNaN, 0, 0, kNaN, 0, 0, kInfinity, 0, 0, 1e38f, 0, 0}, {});
  EXPECT_EQ(places(mesh.position, 1e-3), (std::vector<Index>{0, 1, 2, 3}));
}

TEST(Welds, LeaveWhatIsWhole) {
  EXPECT_FALSE(find_welds(test::torus(8, 6), 0));
  EXPECT_FALSE(find_welds(test::cube(true), 0));
}

TEST(Welds, JoinTriangles) {
  const Mesh mesh =
      triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}, {0, 1, 2, 3, 4, 5});
  const Mesh welded = weld(mesh, *find_welds(mesh, 0));
  EXPECT_EQ(welded.vertex_count(), 4u);
  EXPECT_EQ(welded.corners, (std::vector<Index>{0, 1, 2, 2, 1, 3}));
}

TEST(Welds, KeepWedgesThatDiffer) {
  Mesh mesh =
      triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}, {0, 1, 2, 3, 4, 5});
  Attribute colour{"COLOR_0", ComponentType::u8, 1, true, {}};
  colour.data = {std::byte{1}, std::byte{1}, std::byte{2},
                 std::byte{2}, std::byte{3}, std::byte{3}};
  mesh.wedge_attributes.push_back(colour);
  const Mesh welded = weld(mesh, *find_welds(mesh, 0));
  EXPECT_EQ(welded.wedge_vertex, (std::vector<Index>{0, 1, 2, 1, 3}));
  EXPECT_EQ(welded.corners, (std::vector<Index>{0, 1, 2, 2, 3, 4}));
}

TEST(Welds, LeaveWhatNoPolygonHas) {
  Mesh mesh = triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 2});
  EXPECT_FALSE(find_welds(mesh, 0));
  mesh.groups.push_back({"", kNone, FaceKind::points});
  mesh.corners.push_back(3);
  mesh.face_first = {0, 3, 4};
  mesh.face_group = {0, 1};
  EXPECT_FALSE(find_welds(mesh, 0));
}

// Six wedges of five vertices, as in the example of the clauses.
Welding welding() {
  Welding out{.vertices = 5,
              .wedges = 6,
              .skip = {1, 0},
              .more = {0, 0},
              .corner = {0, 0, 0, 0},
              .vertex = {0, 0, 0, 1},
              .moved = {1},
              .moved_position = test::triangle_mesh({1, -0.f, 0}, {}).position};
  return out;
}

Mesh square() { return triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {0, 1, 2, 2, 1, 3}); }

TEST(Unweld, PartsCornersAndVertices) {
  const Mesh mesh = unweld(square(), welding()).value();
  EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 3, 4, 2, 5}));
  EXPECT_EQ(mesh.wedge_vertex, (std::vector<Index>{0, 1, 2, 3, 3, 4}));
  EXPECT_EQ(mesh.position,
            triangle_mesh({0, 0, 0, 1, -0.f, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {}).position);
}

TEST(Unweld, RefusesWhatDoesNotFit) {
  const auto broken = [](auto&& edit) {
    Welding out = welding();
    edit(out);
    return !unweld(square(), out);
  };
  EXPECT_TRUE(broken([](Welding& w) { w.skip = {1, 2}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.skip = {1}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.more = {0, 0xffff'ffff}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.wedges = 7; }));
  EXPECT_TRUE(broken([](Welding& w) { w.more = {0, 4}, w.wedges = 10; }));
  EXPECT_TRUE(broken([](Welding& w) { w.corner = {0, 0, 0}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.corner = {0, 0, 0, 0, 0}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.corner = {1, 0, 0, 0}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.corner = {0, 0, 1, 0}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.vertex = {0, 0, 0}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.vertex = {0, 0, 0, 2}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.vertices = 6; }));
  EXPECT_TRUE(broken([](Welding& w) { w.moved = {5}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.moved = {0, 1}; }));
  EXPECT_TRUE(broken([](Welding& w) { w.moved_position.count = 2; }));
}

}  // namespace
}  // namespace pstrips
