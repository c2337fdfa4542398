#include "formats/pstrip/payload/check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/progressive.h"

namespace pstrips {
namespace {

ProgressiveStrips strips_with_all() {
  return test::random_progressive(7, {.meshes = 2,
                                      .base_vertices = 4,
                                      .vsplits = 5,
                                      .encoding = MapEncoding::offset,
                                      .placement = Placement::optimal,
                                      .single_wedges = false,
                                      .scene = true,
                                      .faces = true,
                                      .order = true,
                                      .digest = true});
}

struct BadStrips {
  const char* name;
  void (*spoil)(ProgressiveStrips&);
  const char* path;
};

constexpr BadStrips kRows[] = {
    {"parent_after_child", [](auto& s) { s.scene.nodes[0].parent = 1; }, "/scene/nodes/0"},
    {"own_parent", [](auto& s) { s.scene.nodes[1].parent = 1; }, "/scene/nodes/1"},
    {"mesh_of_node", [](auto& s) { s.scene.nodes[1].meshes = {2}; }, "/scene/nodes/1"},
    {"image", [](auto& s) { s.scene.materials[0].maps[0].image = 2; }, "/scene/materials/0"},
    {"no_components", [](auto& s) { s.meshes[0].position.count = 0; }, "/meshes/0/position"},
    {"no_group", [](auto& s) { s.meshes[1].groups.clear(); }, "/meshes/1"},
    {"material", [](auto& s) { s.meshes[1].groups[0].material = 2; }, "/meshes/1/groups/0"},
    {"group_entries", [](auto& s) { ++s.meshes[0].group_entries[0]; }, "/meshes/0"},
    {"attributes",
     [](auto& s) { s.meshes[0].wedge_attributes.resize(1025, {.semantic = "", .data = {}}); },
     "/meshes/0"},
    {"base_too_large", [](auto& s) { s.meshes[0].base_wedges = s.meshes[0].wedges + 1; },
     "/meshes/0"},
    {"triangles", [](auto& s) { s.meshes[0].triangles = kMaxCount; }, "/meshes/0"},
    {"single_wedges", [](auto& s) { s.meshes[0].single_wedges = true; }, "/meshes/0"},
    {"wedge_vertex", [](auto& s) { s.meshes[0].base_wedge_vertex[2] = 4; },
     "/meshes/0/base_wedge_vertex/2"},
    {"wedge_vertices", [](auto& s) { s.meshes[0].base_wedge_vertex.pop_back(); }, "/meshes/0"},
    {"map", [](auto& s) { s.meshes[0].base_map[1] = s.meshes[0].base_wedges; },
     "/meshes/0/base_map/1"},
    {"symbol_outside", [](auto& s) { s.meshes[0].base_map[0] = kSameAsMinus1; },
     "/meshes/0/base_map/0"},
    {"symbol_circle",
     [](auto& s) {
       s.meshes[0].base_map[0] = kSameAsPlus1;
       s.meshes[0].base_map[1] = kSameAsMinus1;
     },
     "/meshes/0/base_map/0"},
    {"naive_symbol",
     [](auto& s) {
       s.meshes[0].encoding = MapEncoding::naive;
       s.meshes[0].base_map.front() = kSameAsPlus1;
     },
     "/meshes/0/base_map/0"},
    {"bases", [](auto& s) { s.bases.pop_back(); }, "/bases"},
    {"base_mesh", [](auto& s) { s.bases[1].mesh = 0; }, "/bases/1"},
    {"packet_mesh", [](auto& s) { s.packets[2].mesh = 2; }, "/packets/2"},
    {"packet_first", [](auto& s) { ++s.packets[0].first_vsplit; }, "/packets/0"},
    {"packet_too_long", [](auto& s) { s.packets[0].vsplits = 0xffff'ffff; }, "/packets/0"},
    {"packet_vertices", [](auto& s) { ++s.packets[1].vertices; }, "/packets/1"},
    {"parent", [](auto& s) { s.meshes[0].vsplits[3].parent = 8; }, "/meshes/0/vsplits/3"},
    {"wedges_wrap", [](auto& s) { s.meshes[0].vsplits[3].wedges = 0xffff'ffff; }, "/meshes/0"},
    {"places_short", [](auto& s) { s.meshes[0].map_offsets.pop_back(); }, "/meshes/0"},
    {"places_long", [](auto& s) { s.meshes[0].map_offsets.push_back(0); }, "/meshes/0"},
    {"position_short", [](auto& s) { s.meshes[0].position.data.pop_back(); }, "/meshes/0"},
    {"parent_position", [](auto& s) { s.meshes[1].parent_position.clear(); }, "/meshes/1"},
    {"missing_packet",
     [](auto& s) { std::erase_if(s.packets, [](const Packet& p) { return p.error == 0; }); },
     "/meshes/0"},
    {"face_bounds", [](auto& s) { s.meshes[0].faces.first[1] = 0xffff'fff0; }, "/meshes/0/faces"},
    {"face_corner", [](auto& s) { s.meshes[0].faces.corners[0] = s.meshes[0].wedges; },
     "/meshes/0/faces"},
    {"face_group", [](auto& s) { s.meshes[0].faces.group[0] = 9; }, "/meshes/0/faces"},
    {"replaced", [](auto& s) { s.meshes[0].faces.replaced[0] = s.meshes[0].triangles; },
     "/meshes/0/faces"},
    {"replaced_twice",
     [](auto& s) { s.meshes[0].faces.replaced[1] = s.meshes[0].faces.replaced[0]; },
     "/meshes/0/faces"},
    {"no_face_attribute", [](auto& s) { s.meshes[0].faces.attributes.clear(); }, "/meshes/0/faces"},
    {"face_attribute", [](auto& s) { s.meshes[0].faces.attributes[0].data.push_back({}); },
     "/meshes/0/faces"},
    {"order_short", [](auto& s) { s.meshes[0].order.face.pop_back(); }, "/meshes/0/order"},
    {"order_range", [](auto& s) { s.meshes[0].order.wedge[1] = s.meshes[0].wedges; },
     "/meshes/0/order/wedge/1"},
    {"order_twice", [](auto& s) { s.meshes[0].order.vertex[1] = s.meshes[0].order.vertex[0]; },
     "/meshes/0/order/vertex/1"},
    {"rotation", [](auto& s) { s.meshes[0].order.rotation[0] = 200; },
     "/meshes/0/order/rotation/0"},
    {"digest", [](auto& s) { s.meshes[1].digest.pop_back(); }, "/meshes/1"},
};

TEST(Check, NamesWhatIsWrong) {
  const ProgressiveStrips good = strips_with_all();
  ASSERT_TRUE(check(good));
  ASSERT_GE(good.meshes[0].faces.replaced.size(), 2u);
  for (const BadStrips& row : kRows) {
    SCOPED_TRACE(row.name);
    ProgressiveStrips bad = good;
    row.spoil(bad);
    const Result<void> result = check(bad);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::corrupt);
    EXPECT_EQ(result.error().path, row.path) << result.error().message;
  }
}

/// The fault of strips whose first mesh is spoilt.
template <class Spoil>
Fault fault_when(ProgressiveStrips strips, Spoil&& spoil) {
  spoil(strips.meshes[0]);
  const Result<void> result = check(strips);
  return result ? Fault::none : result.error().fault;
}

TEST(Check, JudgesMeshesByTheProfile) {
  ProgressiveStrips good = test::random_progressive(3, {.encoding = MapEncoding::triangles});
  good.profile = Profile::compact;
  ProgressiveMesh& mesh = good.meshes[0];
  ASSERT_EQ(mesh.position.type, ComponentType::f32);
  mesh.grid = {.step = 0.25f};
  EXPECT_TRUE(check(good));
  const auto fault_of = [&](auto spoil) { return fault_when(good, spoil); };
  using M = ProgressiveMesh;
  EXPECT_EQ(fault_of([](M& m) { m.encoding = MapEncoding::naive; }), Fault::profile_encoding);
  EXPECT_EQ(fault_of([](M& m) { m.grid.step = 0; }), Fault::position_grid);
  EXPECT_EQ(fault_of([](M& m) { m.grid = {.step = 0.75f, .exact = false}; }), Fault::position_grid);
  EXPECT_EQ(fault_of([](M& m) { m.grid = {.step = 0.5f, .exact = false}; }), Fault::none);
}

TEST(Check, ChangesOfMapsOfTrianglesStayInRange) {
  const ProgressiveStrips good = test::random_progressive(
      5, {.vsplits = 9, .encoding = MapEncoding::triangles, .single_wedges = false});
  ASSERT_TRUE(check(good));
  const ProgressiveMesh& mesh = good.meshes[0];
  ASSERT_GE(mesh.new_corners.size(), 9u);
  ASSERT_FALSE(mesh.map_offsets.empty());
  const auto fault_of = [&](auto spoil) { return fault_when(good, spoil); };
  using M = ProgressiveMesh;
  for (std::size_t i = 0; i < mesh.new_corners.size(); ++i)
    EXPECT_EQ(fault_of([&](M& m) { m.new_corners[i] = m.wedges; }), Fault::corner_not_there);
  EXPECT_EQ(fault_of([](M& m) { m.map_offsets[0] = 3 * m.triangles; }), Fault::offset_past_end);
  EXPECT_EQ(fault_of([](M& m) { m.base_map[1] = kRestart; }), Fault::map_triangles);
  EXPECT_EQ(fault_of([](M& m) { m.base_map.push_back(0); }), Fault::map_triangles);
  EXPECT_EQ(fault_of([](M& m) { m.new_corners.push_back(0); }), Fault::list_length);
  EXPECT_EQ(fault_of([](M& m) {
              ++m.triangles;
              m.group_entries[0] += 3;
            }),
            Fault::triangle_growth);
  EXPECT_EQ(fault_of([](M& m) { ++m.triangles; }), Fault::group_entries);
}

TEST(Check, RecordsStayInRange) {
  const ProgressiveStrips good = strips_with_all();
  const ProgressiveMesh& mesh = good.meshes[0];
  // Every place on a restart or past the end, every reassigned wedge past those that are there.
  for (std::size_t i = 0; i < mesh.map_offsets.size(); ++i)
    for (const Index place :
         {static_cast<Index>(mesh.base_map.size()), kNone,
          static_cast<Index>(std::ranges::find(mesh.base_map, kRestart) - mesh.base_map.begin())}) {
      ProgressiveStrips bad = good;
      bad.meshes[0].map_offsets[i] = place;
      EXPECT_FALSE(check(bad)) << i << " " << place;
    }
  for (std::size_t i = 0; i < mesh.reassigned.size(); ++i) {
    ProgressiveStrips bad = good;
    bad.meshes[0].reassigned[i] = mesh.wedges - 1;
    EXPECT_FALSE(check(bad)) << i;
  }
  EXPECT_FALSE(mesh.map_offsets.empty());
  EXPECT_FALSE(mesh.reassigned.empty());
}

TEST(Check, PacketsFollowEachOther) {
  const ProgressiveStrips good = strips_with_all();
  for (Index m = 0; m < 2; ++m) {
    const ProgressiveMesh& mesh = good.meshes[m];
    PacketStart at = first_packet(mesh);
    for (const Packet& packet : good.packets)
      if (packet.mesh == m) at = packet_after(mesh, at, packet.vsplits);
    EXPECT_EQ(at, (PacketStart{mesh.vsplits.size(), mesh.wedge_offset_counts.size(),
                               mesh.reassigned.size(), mesh.map_offsets.size(),
                               mesh.new_corners.size(), mesh.vertices, mesh.wedges}));
  }
}

}  // namespace
}  // namespace pstrips
