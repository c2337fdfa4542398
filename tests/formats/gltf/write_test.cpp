#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "tests/formats/gltf/files.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

using Triangle = std::array<std::array<float, 3>, 3>;

Model read_back(const GltfFiles& files) {
  const auto model = read_gltf(files.main, test::among(files.others));
  EXPECT_TRUE(model) << model.error().message << ' ' << model.error().path;
  return model ? *model : Model{};
}

std::string text_of(const Model& model) {
  return std::string(as_text(write_gltf(model, {.binary = false})->main));
}

/// All triangles as positions, each turned so that its least corner is first, sorted.
std::vector<Triangle> triangles_of(const Model& model) {
  std::vector<Triangle> out;
  for (const Mesh& mesh : model.meshes)
    for (Index f = 0; f < mesh.face_count(); ++f) {
      Triangle t;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto xyz =
            test::values_of<float>(mesh.position.element(mesh.vertex_of(mesh.face(f)[k])));
        std::ranges::copy(xyz, t[k].begin());
      }
      std::ranges::rotate(t, std::ranges::min_element(t));
      out.push_back(t);
    }
  std::ranges::sort(out);
  return out;
}

TEST(WriteGltf, MeshesOfOtherFormatsKeepTheirTrianglesAndAttributes) {
  for (const Mesh& mesh : {test::grid(20), test::torus(7, 9), test::cube(false), test::cube(true)})
    for (const GltfWriteOptions& options : {GltfWriteOptions{}, GltfWriteOptions{.binary = false},
                                            GltfWriteOptions{.binary = false, .embed = true}}) {
      const auto files = write_gltf(test::model_of(mesh), options);
      ASSERT_TRUE(files);
      EXPECT_TRUE(files->dropped.empty());
      EXPECT_EQ(files->others.size(), !options.binary && !options.embed ? 1u : 0u);
      const Model model = read_back(*files);
      ASSERT_EQ(model.meshes.size(), 1u);
      EXPECT_EQ(model.meshes[0].corners, mesh.corners);
      EXPECT_EQ(model.meshes[0].wedge_attributes, mesh.wedge_attributes);
      EXPECT_EQ(triangles_of(model), triangles_of(test::model_of(mesh)));
      EXPECT_EQ(model.scene.nodes.size(), 1u);
    }
}

TEST(WriteGltf, RandomSoupComesBackTheSameFromTheFirstReadingOn) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = test::random_soup(seed, seed % 20, 3 * (seed % 30));
    const auto files = write_gltf(test::model_of(mesh));
    ASSERT_TRUE(files);
    const Model once = read_back(*files);
    if (mesh.face_count() > 0) {
      EXPECT_EQ(triangles_of(once), triangles_of(test::model_of(mesh)));
    }
    const Model twice = read_back(*write_gltf(once, {.binary = false}));
    EXPECT_TRUE(twice == once);
  }
}

TEST(WriteGltf, StripsShowTheSameTriangles) {
  for (const Mesh& mesh : {test::grid(9), test::torus(8, 5), test::cube(true)})
    for (const auto topology : {GltfTopology::strips, GltfTopology::joined_strips}) {
      const auto files = write_gltf(test::model_of(mesh), {.topology = topology});
      ASSERT_TRUE(files);
      const Model model = read_back(*files);
      EXPECT_EQ(triangles_of(model), triangles_of(test::model_of(mesh)));
      if (topology == GltfTopology::joined_strips) {
        EXPECT_EQ(model.meshes[0].groups.size(), 1u);
      }
    }
}

/// Faces in strip order are found again as the strips they came from.
TEST(WriteGltf, StripsKeepTheStripsOfTheFaceOrder) {
  const std::vector<std::vector<Index>> strips = {{0, 1, 2, 3, 4, 5}, {7, 8, 6, 9}, {1, 5, 9}};
  Mesh mesh = test::triangle_mesh(std::vector<float>(30), {});
  for (const auto& strip : strips)
    for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
      const bool odd = i % 2 != 0;
      mesh.corners.insert(mesh.corners.end(), {strip[i + odd], strip[i + !odd], strip[i + 2]});
    }
  const Model model =
      read_back(*write_gltf(test::model_of(mesh), {.topology = GltfTopology::strips}));
  EXPECT_EQ(model.meshes[0].groups.size(), strips.size());
  EXPECT_EQ(model.meshes[0].corners, mesh.corners);
}

TEST(WriteGltf, StripsSayWhichTrianglesTheyCannotShow) {
  const Mesh mesh = test::triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 1, 1, 2});
  const auto files = write_gltf(test::model_of(mesh), {.topology = GltfTopology::strips});
  EXPECT_EQ(files->dropped,
            std::vector<std::string>{"1 degenerate triangles, which strips cannot show"});
  EXPECT_EQ(read_back(*files).meshes[0].face_count(), 1u);
  EXPECT_TRUE(write_gltf(test::model_of(mesh))->dropped.empty());
}

TEST(WriteGltf, IndicesTakeTheSmallestTypeButNeverItsLargestValue) {
  struct Case {
    Index largest;
    int type;
  };
  for (const auto& [largest, type] :
       {Case{2, 5121}, Case{254, 5121}, Case{255, 5123}, Case{65534, 5123}, Case{65535, 5125}}) {
    const Mesh mesh = test::triangle_mesh(std::vector<float>(3 * (largest + 1)), {0, 1, largest});
    const std::string json = text_of(test::model_of(mesh));
    for (const int t : {5121, 5123, 5125})
      EXPECT_EQ(json.find(std::to_string(t)) != std::string::npos, t == type) << largest;
  }
}

TEST(WriteGltf, VerticesThatAreNoNumbersGoWithTheirFaces) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const auto files = write_gltf(test::model_of(test::triangle_mesh(
      {0.1f, -2, 0, nan, 0, 0, 3, 4, 0, 0, -inf, 0, 5, 5, 5}, {0, 1, 2, 0, 2, 4, 4, 2, 3})));
  EXPECT_EQ(files->dropped,
            (std::vector<std::string>{"2 vertices at NaN, infinity or beyond the range of f32",
                                      "2 faces at such vertices"}));
  const Mesh back = read_back(*files).meshes[0];
  EXPECT_EQ(test::values_of<float>(back.position.data),
            (std::vector<float>{0.1f, -2, 0, 3, 4, 0, 5, 5, 5}));
  EXPECT_EQ(back.corners, (std::vector<Index>{0, 1, 2}));
}

TEST(WriteGltf, ConvertsWhatGltfDoesNotKnowAndSaysSo) {
  Mesh mesh = test::triangle_mesh({}, {0, 1, 2, 3});
  mesh.face_first = {0, 4};
  mesh.position.type = ComponentType::f64;
  mesh.position.data = test::bytes_of<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.1});
  mesh.wedge_attributes.push_back(
      {"quality", ComponentType::i32, 1, false, test::bytes_of<std::int32_t>({1, -2, 3, 4})});
  mesh.wedge_attributes.push_back(
      {"COLOR_0", ComponentType::u8, 3, true,
       test::bytes_of<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})});
  mesh.wedge_attributes.push_back({"wide", ComponentType::u8, 5, false, Bytes(20)});
  mesh.face_attributes.push_back({"flags", ComponentType::u8, 1, false, Bytes(1)});
  mesh.groups[0].name = "side";
  const auto files = write_gltf(test::model_of(mesh));
  ASSERT_TRUE(files);
  const std::vector<std::string> dropped = {
      "face attribute flags",
      "group names of mesh ",
      "attribute wide of 5 components",
  };
  EXPECT_EQ(files->dropped, dropped);
  const std::vector<std::string> converted = {
      "the type f64 of positions, written as f32, at most 1.49e-09 away",
      "the name of attribute quality, written as _QUALITY",
      "the type i32 of attribute quality, written as f32",
      "the name of attribute wide, written as _WIDE",
  };
  EXPECT_EQ(files->converted, converted);
  const Mesh back = read_back(*files).meshes[0];
  EXPECT_EQ(back.corners, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  ASSERT_EQ(back.wedge_attributes.size(), 2u);
  EXPECT_EQ(back.wedge_attributes[0], mesh.wedge_attributes[1]);
  EXPECT_EQ(back.wedge_attributes[1].semantic, "_QUALITY");
  EXPECT_EQ(back.wedge_attributes[1].data, test::bytes_of<float>({1, -2, 3, 4}));
  EXPECT_EQ(test::values_of<float>(back.position.data)[11], 0.1f);
}

TEST(WriteGltf, VerticesAloneBecomePoints) {
  const Model model =
      read_back(*write_gltf(test::model_of(test::triangle_mesh({0, 0, 0, 1, 2, 3}, {}))));
  EXPECT_EQ(model.meshes[0].groups[0].kind, FaceKind::points);
  EXPECT_EQ(model.meshes[0].vertex_count(), 2u);
}

TEST(WriteGltf, LinesOfSeveralCornersAreCutWhenThereAreMany) {
  Mesh mesh = test::triangle_mesh(std::vector<float>(12), {0, 1, 2, 2, 3});
  mesh.groups[0].kind = FaceKind::lines;
  mesh.face_first = {0, 3, 5};
  const auto files = write_gltf(test::model_of(mesh));
  EXPECT_EQ(files->dropped, std::vector<std::string>{"1 polylines, cut into segments"});
  EXPECT_EQ(read_back(*files).meshes[0].corners, (std::vector<Index>{0, 1, 1, 2, 2, 3}));
}

TEST(WriteGltf, ANewSceneKeepsNodesMaterialsAndImages) {
  Model model;
  model.meshes = {test::cube(true), test::grid(3)};
  model.meshes[0].groups[0].material = 0;
  Material material;
  material.name = "wood";
  material.base_color = {0.5, 0.25, 1, 1};
  material.maps = {{.image = 1}};
  model.scene.materials = {material};
  model.scene.images = {{"in", "", "image/png", test::bytes_of<std::uint8_t>({1, 2, 3})},
                        {"", "folder\\a b.png", "", {}},
                        {"", "c.KTX2", "", {}}};
  Node child{.name = "child", .parent = 0, .meshes = {0, 1}};
  child.matrix[12] = 4;
  model.scene.nodes = {{.name = "top", .meshes = {}}, child};
  const auto files = write_gltf(model);
  ASSERT_TRUE(files);
  EXPECT_TRUE(files->dropped.empty()) << files->dropped[0];
  const Scene scene = read_back(*files).scene;
  EXPECT_EQ(scene.materials, model.scene.materials);
  EXPECT_EQ(scene.images[0], model.scene.images[0]);
  EXPECT_EQ(scene.images[1].uri, "folder/a b.png");
  EXPECT_NE(as_text(files->main).find(R"("KHR_texture_basisu":{"source":2})"),
            std::string_view::npos);
  ASSERT_EQ(scene.nodes.size(), 4u);  // two meshes at a node make two children
  EXPECT_EQ(scene.nodes[1].matrix, child.matrix);
  EXPECT_EQ(scene.nodes[2].meshes, std::vector<Index>{0});
  EXPECT_EQ(scene.nodes[3].parent, 1u);
}

Model animated_model() {
  test::Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.floats("SCALAR", 1, {0});
  return test::read_text(
             asset.json(
                 R"("animations":[{"name":"move","samplers":[{"input":1,"output":1}],"channels":[]}],)"
                 R"("nodes":[{"mesh":0,"name":"n"}],)"
                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}],"name":"m"}])"))
      .value();
}

TEST(WriteGltf, AModelWithOtherMeshesBecomesANewAsset) {
  Model model = animated_model();
  EXPECT_NE(text_of(model).find("move"), std::string::npos);
  model.meshes.push_back(test::grid(2));
  const auto files = write_gltf(model);
  ASSERT_TRUE(files);
  ASSERT_EQ(files->dropped.size(), 1u);
  const Model back = read_back(*files);
  EXPECT_EQ(back.meshes.size(), 2u);
  EXPECT_EQ(back.scene.nodes[0].name, "n");
  EXPECT_EQ(as_text(files->main).find("move"), std::string_view::npos);
}

TEST(WriteGltf, AChangedMeshKeepsTheAsset) {
  Model model = animated_model();
  model.meshes[0] = test::grid(4);
  const auto files = write_gltf(model);
  EXPECT_TRUE(files->dropped.empty());
  EXPECT_NE(as_text(files->main).find("move"), std::string_view::npos);
  EXPECT_EQ(triangles_of(read_back(*files)), triangles_of(model));
}

/// What a format keeps for itself travels through other files, so it may come back as anything.
TEST(WriteGltf, DamagedForeignDataDoesNoHarm) {
  const Model good = animated_model();
  std::mt19937 random(3);
  for (int round = 0; round < 4000; ++round) {
    Model model = good;
    Bytes& data = model.scene.foreign[random() % model.scene.foreign.size()].data;
    data[random() % data.size()] = static_cast<std::byte>(random());
    const auto files = write_gltf(model);
    ASSERT_TRUE(files) << "round " << round;
    const auto back = read_gltf(files->main, {});
    if (back) {
      EXPECT_LE(back->meshes.size(), 1u);
    }
  }
}

TEST(WriteGltf, UnknownChunksComeBack) {
  const Bytes chunk = test::bytes_of<std::uint32_t>({4, 0x12345678, 99});
  const auto file = gltf::join(R"({"asset":{"version":"2.0"}})", {}, chunk).value();
  const auto model = read_gltf(file, {});
  ASSERT_TRUE(model);
  EXPECT_EQ(write_gltf(*model)->main, file);
  EXPECT_EQ(write_gltf(*model, {.binary = false})->dropped.size(), 1u);
}

}  // namespace
}  // namespace pstrips
