// Encode and decode as a whole: exact return, packets, levels, cuts, interleaving.

#include "converters/encode.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "codecs/stripify/stripify.h"
#include "converters/decode.h"
#include "formats/pstrip/check.h"
#include "formats/pstrip/digest.h"
#include "tests/support/meshes.h"

namespace pstrip {
namespace {

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.meshes = std::move(meshes);
  return model;
}

ProgressiveStrips encoded(const Model& model, const EncodeOptions& options) {
  auto strips = encode(model, options);
  EXPECT_TRUE(strips) << strips.error().message;
  EXPECT_TRUE(check(*strips)) << check(*strips).error().message << check(*strips).error().path;
  return std::move(strips).value();
}

RC_GTEST_PROP(Encode, AnySoupComesBackExactlyInBothEncodings, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(0, 60);
  const auto faces = *rc::gen::inRange<Index>(0, 120);
  const Model model = model_of({test::random_soup(seed, vertices, faces)});
  for (const MapEncoding encoding : {MapEncoding::naive, MapEncoding::offset_difference}) {
    EncodeOptions options;
    options.encoding = encoding;
    options.keep_order = true;
    options.packet_min = 3;
    const auto strips = encode(model, options);
    RC_ASSERT(strips);
    RC_ASSERT(check(*strips).has_value());
    RC_ASSERT(decode(*strips)->meshes == model.meshes);
  }
}

TEST(Encode, EveryStripifierGivesTheMeshBack) {
  for (const NamedStripifier& stripifier : stripifiers())
    for (const Mesh& mesh : {test::grid(20), test::torus(12, 9), test::cube(true)}) {
      SCOPED_TRACE(stripifier.name);
      EncodeOptions options;
      options.stripifier = stripifier.name;
      options.keep_order = true;
      EXPECT_EQ(decode(encoded(model_of({mesh}), options))->meshes[0], mesh);
    }
}

TEST(Encode, TheSameModelGivesTheSameStrips) {
  const Model model = model_of({test::torus(30, 20), test::cube(true)});
  EXPECT_EQ(encoded(model, {}), encoded(model, {}));
}

TEST(Encode, EmptyModelsAreFine) {
  EXPECT_TRUE(decode(encoded({}, {}))->meshes.empty());
  const Model no_faces = model_of({test::triangle_mesh({0, 0, 0, 1, 1, 1}, {})});
  EXPECT_EQ(decode(encoded(no_faces, {.keep_order = true}))->meshes, no_faces.meshes);
  const Model nothing = model_of({test::triangle_mesh({}, {})});
  EXPECT_EQ(decode(encoded(nothing, {.keep_order = true}))->meshes, nothing.meshes);
}

TEST(Encode, TheBaseIsAsSmallAsAsked) {
  const Model model = model_of({test::torus(40, 40)});
  EncodeOptions options;
  options.base_share = 0.1;
  EXPECT_LE(encoded(model, options).bases[0].triangles, 320u);
  options.base_triangles = 50;
  EXPECT_LE(encoded(model, options).bases[0].triangles, 50u);
  options.base_triangles.reset();
  options.base_error = 0.05;
  const ProgressiveStrips by_error = encoded(model, options);
  EXPECT_LE(by_error.bases[0].error, 0.05f);
  EXPECT_LT(by_error.bases[0].triangles, 3200u);
}

TEST(Encode, LevelsSayWhatTheyShow) {
  const ProgressiveStrips strips = encoded(model_of({test::grid(30)}), {.packet_min = 20});
  ASSERT_GT(strips.packets.size(), 5u);
  for (std::size_t k = 0; k <= strips.packets.size(); ++k) {
    const Mesh mesh = decode(strips, k)->meshes[0];
    const Packet& said = k == 0 ? strips.bases[0] : strips.packets[k - 1];
    EXPECT_EQ(mesh.vertex_count(), said.vertices);
    EXPECT_EQ(mesh.face_count(), said.triangles);
    EXPECT_EQ(find_inconsistency(mesh), "");
  }
  EXPECT_EQ(strips.packets.back().error, 0);
}

TEST(Encode, PacketsOfSeveralMeshesAreInterleavedByError) {
  const ProgressiveStrips strips =
      encoded(model_of({test::grid(25), test::torus(25, 20)}), {.packet_min = 30});
  std::vector<float> error{strips.bases[0].error, strips.bases[1].error};
  bool switched = false;
  for (std::size_t k = 0; k < strips.packets.size(); ++k) {
    const Packet& p = strips.packets[k];
    if (k > 0) switched |= p.mesh != strips.packets[k - 1].mesh;
    const Index other = 1 - p.mesh;
    const bool other_is_done = error[other] == 0;
    if (!other_is_done) {
      EXPECT_GE(error[p.mesh], error[other]);
    }
    error[p.mesh] = p.error;
  }
  EXPECT_TRUE(switched);
}

TEST(PacketsFor, FindsTheLevelAsked) {
  const ProgressiveStrips strips = encoded(model_of({test::torus(40, 30)}), {.packet_min = 40});
  const std::size_t all = strips.packets.size();
  EXPECT_EQ(packets_for(strips, {}), all);
  EXPECT_EQ(packets_for(strips, {.packets = 3}), 3u);
  EXPECT_EQ(packets_for(strips, {.packets = 1'000'000}), all);
  EXPECT_EQ(packets_for(strips, {.triangles = 0}), 0u);
  EXPECT_EQ(packets_for(strips, {.triangles = strips.packets[4].triangles}), 5u);
  EXPECT_EQ(packets_for(strips, {.error = 0}), all);
  EXPECT_EQ(packets_for(strips, {.error = strips.packets[2].error}), 3u);
}

TEST(Cut, MakesAShorterFileOfTheSameLevels) {
  const ProgressiveStrips whole =
      encoded(model_of({test::grid(20), test::cube(true)}), {.keep_order = true, .packet_min = 10});
  for (std::size_t k = 0; k < whole.packets.size(); ++k) {
    const ProgressiveStrips shorter = cut(whole, k);
    ASSERT_TRUE(check(shorter)) << k;
    const Model a = decode(shorter).value(), b = decode(whole, k).value();
    for (std::size_t m = 0; m < a.meshes.size(); ++m)
      EXPECT_EQ(a.meshes[m].corners.size(), b.meshes[m].corners.size());
  }
  EXPECT_EQ(cut(whole, whole.packets.size()), whole);
}

TEST(Digest, IsThatOfTheDecodedMesh) {
  const ProgressiveStrips strips = encoded(model_of({test::cube(true)}), {});
  const auto sum = digest(decode(strips)->meshes[0]);
  EXPECT_TRUE(std::ranges::equal(sum, strips.meshes[0].digest));
}

TEST(Encode, StopsWhenToldTo) {
  const auto strips =
      encode(model_of({test::grid(10)}), {}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(strips);
  EXPECT_EQ(strips.error().code, ErrorCode::interrupted);
}

TEST(Encode, RefusesWhatIsNoMesh) {
  Model model = model_of({test::grid(3)});
  model.meshes[0].corners[0] = 99;
  EXPECT_EQ(encode(model, {}).error().code, ErrorCode::bad_argument);
  EncodeOptions options;
  options.stripifier = "none such";
  EXPECT_EQ(encode({}, options).error().code, ErrorCode::bad_argument);
}

TEST(KeepAttributes, JoinsWedgesThatThenAreTheSame) {
  Model model = model_of({test::cube(true)});
  keep_attributes(model, {});
  EXPECT_EQ(model.meshes[0].wedge_count(), 8u);
  EXPECT_EQ(find_inconsistency(model.meshes[0]), "");
  Model normals = model_of({test::cube(true)});
  keep_attributes(normals, {"NORMAL"});
  EXPECT_EQ(normals.meshes[0].wedge_count(), 24u);
  EXPECT_EQ(normals.meshes[0].wedge_attributes.size(), 1u);
}

}  // namespace
}  // namespace pstrip
