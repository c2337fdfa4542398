#include "formats/pstrip/payload/digest.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "tests/support/meshes.h"

namespace pstrips {
namespace {

// The bytes of the digest of spec/example.md were worked out apart from this code; its test holds
// the value. Here: what must and what must not change it.

TEST(Digest, DoesNotSeeHowOptionalListsAreWritten) {
  const Mesh brief = test::grid(4);
  Mesh full = brief;
  full.wedge_vertex.resize(full.vertex_count());
  std::iota(full.wedge_vertex.begin(), full.wedge_vertex.end(), Index{0});
  for (Index f = 0; f <= brief.face_count(); ++f) full.face_first.push_back(3 * f);
  full.face_group.resize(brief.face_count());
  EXPECT_EQ(digest(full), digest(brief));
}

TEST(Digest, DoesNotSeeNamesAndMaterials) {
  Mesh mesh = test::cube(true);
  const Digest before = digest(mesh);
  mesh.name = "cube";
  mesh.groups[0] = {"sides", 3, FaceKind::polygons};
  EXPECT_EQ(digest(mesh), before);
}

TEST(Digest, SeesEverythingElse) {
  Mesh mesh = test::cube(true);
  mesh.groups.resize(2);
  mesh.face_attributes.push_back({"_ID", ComponentType::u8, 1, false, Bytes(12)});
  void (*const kChanges[])(Mesh&) = {
      [](Mesh&) {},
      [](Mesh& m) { m.position.data[0] ^= std::byte{0x80}; },
      [](Mesh& m) { m.position.semantic = "position"; },
      [](Mesh& m) {
        m.wedge_vertex[0] = 1;
        m.wedge_vertex[4] = 0;
      },
      [](Mesh& m) { m.wedge_attributes[1].data[0] ^= std::byte{1}; },
      [](Mesh& m) { m.wedge_attributes[1].semantic = "TEXCOORD_1"; },
      [](Mesh& m) { std::swap(m.wedge_attributes[0], m.wedge_attributes[1]); },
      [](Mesh& m) { m.corners[0] = 1; },
      [](Mesh& m) {
        m.face_group.assign(12, 0);
        m.face_group[3] = 1;
      },
      [](Mesh& m) { m.face_attributes[0].data[11] = std::byte{1}; },
      [](Mesh& m) { m.face_attributes[0].normalized = true; },
      [](Mesh& m) { m.face_attributes.clear(); },
      [](Mesh& m) {  // the same corners in a hexagon and ten triangles
        m.face_first = {0};
        for (Index c = 6; c <= 36; c += 3) m.face_first.push_back(c);
        m.face_attributes[0].data.resize(11);
      },
  };
  std::set<Digest> digests;
  for (const auto change : kChanges) {
    Mesh changed = mesh;
    change(changed);
    ASSERT_EQ(find_inconsistency(changed), "");
    EXPECT_TRUE(digests.insert(digest(changed)).second) << digests.size();
  }
}

TEST(Digest, OfNothingIsSomething) { EXPECT_NE(digest(test::triangle_mesh({}, {})), Digest{}); }

}  // namespace
}  // namespace pstrips
