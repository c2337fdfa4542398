#include <gtest/gtest.h>

#include <array>

#include "tests/formats/gltf/files.h"

namespace pstrips {
namespace {

using test::Asset;
using test::read_text;
using Corners = std::vector<Index>;

std::string mesh_of(const std::string& primitives) {
  return R"("meshes":[{"primitives":[)" + primitives + "]}]";
}

Model read_good(const std::string& json) {
  const Result<Model> model = read_text(json);
  EXPECT_TRUE(model) << model.error().message << ' ' << model.error().path;
  if (!model) return {};
  for (const Mesh& mesh : model->meshes) EXPECT_EQ(find_inconsistency(mesh), "");
  for (const bool binary : {true, false}) {
    const auto files = write_gltf(*model, {.binary = binary});
    EXPECT_TRUE(files && files->dropped.empty());
    const auto again = read_gltf(files->main, test::among(files->others));
    EXPECT_TRUE(again && *again == *model) << as_text(files->main);
  }
  return *model;
}

TEST(ReadGltf, WeldsWedgesWithEqualPositionsInOrder) {
  Asset asset;
  asset.floats("VEC3", 4, {5, 0, 0, 1, 0, 0, 5, 0, 0, 2, 2, 2});
  asset.floats("VEC2", 4, {0, 0, 0, 1, 1, 0, 1, 1});
  asset.shorts({0, 1, 3, 3, 1, 2});
  const Model model = read_good(asset.json(
      R"("materials":[{},{}],)" +
      mesh_of(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":1})")));
  ASSERT_EQ(model.meshes.size(), 1u);
  const Mesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.wedge_vertex, (Corners{0, 1, 0, 2}));
  EXPECT_EQ(mesh.position.data, test::bytes_of<float>({5, 0, 0, 1, 0, 0, 2, 2, 2}));
  EXPECT_EQ(mesh.corners, (Corners{0, 1, 3, 3, 1, 2}));
  EXPECT_EQ(mesh.groups[0].material, 1u);
}

TEST(ReadGltf, KeepsZerosOfBothSignsApart) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, -0.f, 0, 0, 0, 0, 0});
  EXPECT_EQ(
      read_good(asset.json(mesh_of(R"({"attributes":{"POSITION":0}})"))).meshes[0].wedge_vertex,
      (Corners{0, 1, 0}));
}

TEST(ReadGltf, UnfoldsEveryMode) {
  struct Case {
    int mode;
    std::initializer_list<std::uint16_t> indices;
    Corners corners, face_first;
    FaceKind kind;
  };
  const Case cases[] = {
      {0, {2, 0}, {2, 0}, {0, 1, 2}, FaceKind::points},
      {1, {0, 1, 2, 3}, {0, 1, 2, 3}, {0, 2, 4}, FaceKind::lines},
      {2, {0, 1, 2}, {0, 1, 2, 0}, {0, 4}, FaceKind::lines},
      {3, {0, 1, 2, 4}, {0, 1, 2, 4}, {0, 4}, FaceKind::lines},
      {3, {0}, {}, {}, FaceKind::lines},
      {4, {0, 1, 2, 3, 3, 4}, {0, 1, 2, 3, 3, 4}, {}, FaceKind::polygons},
      {5, {0, 1, 2, 3, 4}, {0, 1, 2, 2, 1, 3, 2, 3, 4}, {}, FaceKind::polygons},
      {5, {0, 1, 2, 2, 3, 3, 4, 1}, {0, 1, 2, 4, 3, 1}, {}, FaceKind::polygons},
      {5, {0, 0, 0}, {}, {}, FaceKind::polygons},
      {6, {0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {}, FaceKind::polygons},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::Message() << "mode " << c.mode << ", " << c.indices.size() << " indices");
    Asset asset;
    asset.floats("VEC3", 5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 2, 0});
    asset.shorts(c.indices);
    const Model model = read_good(asset.json(mesh_of(
        R"({"attributes":{"POSITION":0},"indices":1,"mode":)" + std::to_string(c.mode) + "}")));
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].corners, c.corners);
    EXPECT_EQ(model.meshes[0].face_first, c.face_first);
    EXPECT_EQ(model.meshes[0].groups[0].kind, c.kind);
  }
}

TEST(ReadGltf, DrawsAllVerticesWithoutIndices) {
  Asset asset;
  asset.floats("VEC3", 4, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const Model model = read_good(asset.json(mesh_of(R"({"attributes":{"POSITION":0},"mode":5})")));
  EXPECT_EQ(model.meshes[0].corners, (Corners{0, 1, 2, 2, 1, 3}));
}

TEST(ReadGltf, SaysWhichIndicesAreLeftOver) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.shorts({0, 1, 2, 0});
  std::vector<std::string> dropped;
  const auto model =
      read_text(asset.json(mesh_of(R"({"attributes":{"POSITION":0},"indices":1})")), {}, &dropped);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes[0].face_count(), 1u);
  EXPECT_EQ(dropped,
            std::vector<std::string>{"indices beyond whole faces of /meshes/0/primitives/0"});
}

TEST(ReadGltf, TakesStridesSparseValuesZerosAndEveryComponentType) {
  Asset asset;
  // Two positions 16 bytes apart.
  asset.view(test::bytes_of<float>({1, 2, 3, -1, 4, 5, 6, -1}), R"(,"byteStride":16)");
  asset.accessor(5126, 2, "VEC3", R"(,"bufferView":0)");
  asset.view(test::bytes_of<std::int8_t>({1, -2, 3, -128}));
  asset.accessor(5120, 2, "VEC2", R"(,"bufferView":1,"normalized":true)");
  asset.view(test::bytes_of<std::int16_t>({-300, 300}));
  asset.accessor(5122, 2, "SCALAR", R"(,"bufferView":2)");
  asset.view(test::bytes_of<std::uint8_t>({1}));
  asset.view(test::bytes_of<std::uint16_t>({7, 8, 9, 10}));
  asset.accessor(5123, 2, "VEC4",
                 R"(,"sparse":{"count":1,"indices":{"bufferView":3,"componentType":5121},)"
                 R"("values":{"bufferView":4}})");
  asset.accessor(5126, 2, "SCALAR");
  asset.view(test::bytes_of<std::uint32_t>({70000, 1}));
  asset.accessor(5125, 2, "SCALAR", R"(,"bufferView":5)");
  const Model model = read_good(asset.json(
      mesh_of(R"({"attributes":{"POSITION":0,"_A":1,"_B":2,"_C":3,"_D":4,"_E":5},"mode":0})")));
  const Mesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.position.data, test::bytes_of<float>({1, 2, 3, 4, 5, 6}));
  const Attribute expected[] = {
      {"_A", ComponentType::i8, 2, true, test::bytes_of<std::int8_t>({1, -2, 3, -128})},
      {"_B", ComponentType::i16, 1, false, test::bytes_of<std::int16_t>({-300, 300})},
      {"_C", ComponentType::u16, 4, false,
       test::bytes_of<std::uint16_t>({0, 0, 0, 0, 7, 8, 9, 10})},
      {"_D", ComponentType::f32, 1, false, test::bytes_of<float>({0, 0})},
      {"_E", ComponentType::u32, 1, false, test::bytes_of<std::uint32_t>({70000, 1})},
  };
  ASSERT_EQ(mesh.wedge_attributes.size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i)
    EXPECT_EQ(mesh.wedge_attributes[i], expected[i]) << expected[i].semantic;
}

TEST(ReadGltf, TakesThePaddingOutOfMatrixColumns) {
  Asset asset;
  asset.floats("VEC3", 1, {0, 0, 0});
  asset.view(test::bytes_of<std::uint8_t>({1, 2, 0, 0, 3, 4, 0, 0}));
  asset.accessor(5121, 1, "MAT2", R"(,"bufferView":1)");
  asset.view(test::bytes_of<std::uint16_t>({1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0}));
  asset.accessor(5123, 1, "MAT3", R"(,"bufferView":2)");
  const Model model =
      read_good(asset.json(mesh_of(R"({"attributes":{"POSITION":0,"_M":1,"_N":2},"mode":0})")));
  EXPECT_EQ(model.meshes[0].wedge_attributes[0].data, test::bytes_of<std::uint8_t>({1, 2, 3, 4}));
  EXPECT_EQ(model.meshes[0].wedge_attributes[1].data,
            test::bytes_of<std::uint16_t>({1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(ReadGltf, KeepsQuantizedPositionsAsTheyAre) {
  Asset asset;
  asset.view(test::bytes_of<std::int16_t>({1, 2, 3, 0, -4, 5, 6, 0}), R"(,"byteStride":8)");
  asset.accessor(5122, 2, "VEC3", R"(,"bufferView":0,"normalized":true)");
  const Model model = read_good(asset.json(R"("extensionsUsed":["KHR_mesh_quantization"],)"
                                           R"("extensionsRequired":["KHR_mesh_quantization"],)" +
                                           mesh_of(R"({"attributes":{"POSITION":0},"mode":0})")));
  EXPECT_EQ(model.meshes[0].position.type, ComponentType::i16);
  EXPECT_TRUE(model.meshes[0].position.normalized);
  const auto files = write_gltf(model, {.binary = false});
  EXPECT_NE(as_text(files->main).find("\"extensionsRequired\""), std::string_view::npos);
}

TEST(ReadGltf, SharesWedgesOfPrimitivesWithTheSameAccessors) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.shorts({0, 1, 2});
  asset.shorts({2, 1, 0});
  const Model model =
      read_good(asset.json(mesh_of(R"({"attributes":{"POSITION":0},"indices":1},)"
                                   R"({"attributes":{"POSITION":0},"indices":2})")));
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].wedge_count(), 3u);
  EXPECT_EQ(model.meshes[0].corners, (Corners{0, 1, 2, 2, 1, 0}));
  EXPECT_EQ(model.meshes[0].face_group, (Corners{0, 1}));
}

TEST(ReadGltf, JoinsPrimitivesOfOneLayoutAndPartsOthers) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.floats("VEC3", 3, {1, 0, 0, 0, 1, 0, 1, 1, 0});
  asset.floats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const Model model = read_good(asset.json(
      R"("nodes":[{"mesh":0}],)" +
      mesh_of(R"({"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"mode":3},)"
              R"({"attributes":{"POSITION":0,"NORMAL":2}},{"attributes":{"POSITION":1}})")));
  ASSERT_EQ(model.meshes.size(), 3u);
  EXPECT_EQ(model.meshes[0].groups.size(), 2u);
  EXPECT_EQ(model.meshes[0].wedge_vertex, (Corners{0, 1, 2, 1, 2, 3}));
  EXPECT_EQ(model.meshes[1].groups[0].kind, FaceKind::lines);
  EXPECT_EQ(model.meshes[2].wedge_attributes[0].semantic, "NORMAL");
  EXPECT_EQ(model.scene.nodes[0].meshes, (Corners{0, 1, 2}));
}

TEST(ReadGltf, NamesMorphTargetsByNumber) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.floats("VEC3", 3, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  const Model model = read_good(
      asset.json(mesh_of(R"({"attributes":{"POSITION":0},"targets":[{},{"POSITION":1},{}]})")));
  ASSERT_EQ(model.meshes[0].wedge_attributes.size(), 1u);
  EXPECT_EQ(model.meshes[0].wedge_attributes[0].semantic, "TARGET_1/POSITION");
}

TEST(ReadGltf, KeepsPrimitivesWithoutPositionsForTheWayBack) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.floats("VEC3", 1, {0, 0, 1});
  const Model model = read_good(
      asset.json(mesh_of(R"({"attributes":{"NORMAL":1},"mode":0},{"attributes":{"POSITION":0}})")));
  EXPECT_EQ(model.meshes.size(), 1u);
}

TEST(ReadGltf, ReadsEmptyPrimitivesAndMeshes) {
  Asset asset;
  asset.accessor(5126, 0, "VEC3");
  const Model model = read_good(asset.json(
      R"("meshes":[{"name":"none","primitives":[]},{"name":"empty","primitives":[{"attributes":{"POSITION":0}}]}])"));
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].name, "empty");
  EXPECT_EQ(model.meshes[0].wedge_count(), 0u);
}

TEST(ReadGltf, OrdersNodesParentsFirst) {
  const Model model = read_good(Asset().json(
      R"("nodes":[{"name":"leaf","translation":[1,2,3],"scale":[2,2,2]},)"
      R"({"name":"root","children":[2,0]},)"
      R"({"name":"turned","rotation":[0,0,0.6,0.8]},)"
      R"({"name":"other","children":[0],"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,7,8,9,1]}])"));
  const auto& nodes = model.scene.nodes;
  ASSERT_EQ(nodes.size(), 5u);  // leaf has two parents
  const char* names[] = {"root", "turned", "leaf", "other", "leaf"};
  const Index parents[] = {kNone, 0, 0, kNone, 3};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_EQ(nodes[i].name, names[i]);
    EXPECT_EQ(nodes[i].parent, parents[i]);
  }
  EXPECT_NEAR(nodes[1].matrix[0], 1 - 2 * 0.36, 1e-12);
  EXPECT_NEAR(nodes[1].matrix[1], 2 * 0.6 * 0.8, 1e-12);
  EXPECT_NEAR(nodes[1].matrix[4], -2 * 0.6 * 0.8, 1e-12);
  EXPECT_EQ(nodes[2].matrix,
            (std::array<double, 16>{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1}));
  EXPECT_EQ(nodes[3].matrix[14], 9);
}

TEST(ReadGltf, FillsMaterialsAndImages) {
  Asset asset;
  asset.view(as_bytes("\xff\xd8\xff picture"));
  const Model model = read_good(asset.json(
      R"("images":[{"uri":"a%20b.png"},{"bufferView":0},{"uri":"data:image/png;base64,AAEC","name":"n"}],)"
      R"("textures":[{"source":1},{"extensions":{"KHR_texture_basisu":{"source":2}}}],)"
      R"("materials":[{"name":"m","doubleSided":true,"emissiveFactor":[1,0.5,0],)"
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,)"
      R"("roughnessFactor":0.25,"baseColorTexture":{"index":1}}},{}])"));
  const Scene& scene = model.scene;
  EXPECT_EQ(scene.images[0].uri, "a b.png");
  EXPECT_EQ(scene.images[1].mime_type, "image/jpeg");
  EXPECT_EQ(as_text(scene.images[1].data), "\xff\xd8\xff picture");
  EXPECT_EQ(scene.images[2],
            (Image{"n", "", "image/png", test::bytes_of<std::uint8_t>({0, 1, 2})}));
  Material expected;
  expected.name = "m";
  expected.base_color = {0.1, 0.2, 0.3, 0.4};
  expected.emissive = {1, 0.5, 0};
  expected.metallic = 0.5;
  expected.roughness = 0.25;
  expected.maps = {{.image = 2}};
  expected.double_sided = true;
  EXPECT_EQ(scene.materials[0], expected);
  EXPECT_EQ(scene.materials[1], Material{});
}

TEST(ReadGltf, KeepsAnimationsSkinsAndExtensionsButNoGeometry) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.floats("SCALAR", 2, {0, 1});
  asset.floats("VEC3", 2, {0, 0, 0, 0, 1, 0});
  asset.floats("MAT4", 1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  asset.floats("VEC3", 1, {9, 9, 9});
  asset.view(as_bytes("table"));
  const Model model = read_good(asset.json(
      R"("animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}],)"
      R"("skins":[{"inverseBindMatrices":3,"joints":[0]}],)"
      R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":4}}}}],)"
      R"("extensions":{"X_sound":{"clips":[{"bufferView":5}]}},"extras":{"bufferView":77},)" +
      mesh_of(R"({"attributes":{"POSITION":0},"extras":{"a":1}})")));
  const auto find = [&](std::string_view key) {
    for (const Foreign& foreign : model.scene.foreign)
      if (foreign.key == key) return std::string(as_text(foreign.data));
    return std::string();
  };
  // Times, translations, matrix, instance, and the table at the next multiple of eight.
  EXPECT_EQ(find("gltf/bin").size(), 8u + 24 + 64 + 12 + 4 + 5);
  const std::string json = find("gltf/json");
  EXPECT_NE(json.find(R"("input":0,"output":1)"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("inverseBindMatrices":2)"), std::string::npos);
  EXPECT_NE(json.find(R"("TRANSLATION":3)"), std::string::npos);
  EXPECT_NE(json.find(R"("clips":[{"bufferView":3}])"), std::string::npos);
  EXPECT_NE(json.find(R"("bufferView":77)"), std::string::npos);
  EXPECT_NE(json.find(R"("primitives":[{"extras":{"a":1}}])"), std::string::npos);
  EXPECT_EQ(json.find("POSITION"), std::string::npos);
}

TEST(ReadGltf, ReadsCompressedGeometryThroughItsFallback) {
  Asset asset;
  asset.view(test::bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}),
             R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0}})");
  asset.accessor(5126, 3, "VEC3", R"(,"bufferView":0)");
  const Model model = read_good(asset.json(
      R"("extensionsUsed":["KHR_draco_mesh_compression","EXT_meshopt_compression","KHR_materials_unlit"],)" +
      mesh_of(
          R"({"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":{"bufferView":9}}})")));
  EXPECT_EQ(model.meshes[0].face_count(), 1u);
  EXPECT_EQ(as_text(model.scene.foreign[0].data).find("compression"), std::string_view::npos);
}

TEST(ReadGltf, NamesExtensionsItLeavesOut) {
  struct Case {
    const char* extension;
    const char* primitive;  // its object there, null: none
    const char* material;
    const char* said;  // empty: it is kept
  };
  const Case cases[] = {
      {"EXT_mesh_primitive_edge_visibility", R"({"visibility":0})", nullptr,
       "extension EXT_mesh_primitive_edge_visibility, which speaks of the order of vertices"},
      {"CESIUM_primitive_outline", R"({"indices":0})", nullptr,
       "extension CESIUM_primitive_outline, which speaks of the order of vertices"},
      {"VENDOR_lines", R"({"accessor":0})", nullptr,
       "extension VENDOR_lines, which may refer to what is renumbered"},
      {"VENDOR_lines", R"({"count":77})", nullptr,
       "extension VENDOR_lines, which may refer to what is renumbered"},
      {"VENDOR_paint", nullptr, R"({"layers":[{"mask":1}]})",
       "extension VENDOR_paint, which may refer to what is renumbered"},
      {"VENDOR_paint", nullptr, R"({"bufferView":0,"gloss":0.5,"name":"x","steps":9})", ""},
      {"VENDOR_paint", R"({"name":"x"})", R"({"accessor":1})", ""},
      {"KHR_materials_sheen", nullptr, R"({"sheenColorTexture":{"index":0}})", ""},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.extension) + " " + (c.primitive ? c.primitive : c.material));
    Asset asset;
    asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    asset.floats("SCALAR", 1, {1});
    const auto extensions = [&](const char* object) {
      const std::string name = c.extension;
      return object ? R"("extensions":{")" + name + "\":" + object + "}" : R"("extras":1)";
    };
    std::vector<std::string> dropped;
    const auto model = read_text(
        asset.json(R"("extensionsUsed":[")" + std::string(c.extension) + R"("],"materials":[{)" +
                   extensions(c.material) + "}]," +
                   mesh_of(R"({"attributes":{"POSITION":0},)" + extensions(c.primitive) + "}")),
        {}, &dropped);
    ASSERT_TRUE(model) << model.error().message;
    const bool is_kept = *c.said == '\0';
    EXPECT_EQ(dropped, is_kept ? std::vector<std::string>{} : std::vector<std::string>{c.said});
    const std::string rest(as_text(model->scene.foreign[0].data));
    EXPECT_EQ(rest.find(c.extension) != std::string::npos, is_kept) << rest;
  }
}

TEST(ReadGltf, TakesDataUrisOfAnyForm) {
  for (const char* uri :
       {"data:application/octet-stream;base64,AACAPwAAAEAAAEBA", "data:;base64,AACAPwAAAEAAAEBA",
        "DATA:;charset=x;BASE64,AACA PwAA\\nAEAAAEBA", "data:;base64,AACAPwAAAEAAAEB%41",
        "data:,%00%00%80%3f%00%00%00%40%00%00%40%40",
        "data:text/plain,%00%00%80?%00%00%00@%00%00@@"}) {
    SCOPED_TRACE(uri);
    const Model model = read_good(
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":12,"uri":")" + std::string(uri) +
        R"("}],"bufferViews":[{"buffer":0,"byteLength":12}],)"
        R"("accessors":[{"componentType":5126,"count":1,"type":"VEC3","bufferView":0}],)" +
        mesh_of(R"({"attributes":{"POSITION":0},"mode":0})") + "}");
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(test::values_of<float>(model.meshes[0].position.data), (std::vector<float>{1, 2, 3}));
  }
}

TEST(ReadGltf, SaysThatAFileIsOfTheFirstVersion) {
  Bytes binary = test::bytes_of<std::uint32_t>({0x46546c67, 1, 24, 0, 0, 0});
  for (const ByteView file :
       {as_bytes(R"({"asset":{"version":"1.0"}})"), as_bytes(R"({"meshes":{"a":{}}})"),
        as_bytes(R"({"asset":{"version":"1.1"},"accessors":{}})"), ByteView(binary)}) {
    const auto model = read_gltf(file, {});
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::unsupported);
    EXPECT_EQ(model.error().message, "glTF 1.0");
  }
}

TEST(ReadGltf, WarnsOfBytesAfterTheEnd) {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  Bytes file = asset.glb(mesh_of(R"({"attributes":{"POSITION":0}})"));
  const Model model = *read_gltf(file, {});
  file.resize(file.size() + 3);
  std::vector<std::string> dropped;
  const auto again = read_gltf(file, {}, {}, &dropped);
  ASSERT_TRUE(again);
  EXPECT_TRUE(*again == model);
  EXPECT_EQ(dropped, std::vector<std::string>{"3 bytes after the end of the .glb"});
}

TEST(ReadGltf, AsksOnlyForFilesInsideTheFolder) {
  struct Case {
    const char* uri;
    const char* path;  // null: refused
  };
  const Case cases[] = {
      {"a.bin", "a.bin"},
      {"x/../y%20z.bin", "x/../y z.bin"},
      {"x%5Cy.bin", "x/y.bin"},
      {"./a.bin", "./a.bin"},
      {"../a.bin", nullptr},
      {"x/../../a.bin", nullptr},
      {"/a.bin", nullptr},
      {"%2Fa.bin", nullptr},
      {"%2e%2E/a.bin", nullptr},
      {"..%5Ca.bin", nullptr},
      {"http://x/a.bin", nullptr},
      {"file:a.bin", nullptr},
      {"C%3A/a.bin", nullptr},
      {"a%00.bin", nullptr},
      {"a%2", "a%2"},
      {"100%.bin", "100%.bin"},
      {"a%zz%20", "a%zz "},
      {"", nullptr},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.uri);
    const std::string json =
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + std::string(c.uri) +
        R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
        R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3","bufferView":0}],)" +
        mesh_of(R"({"attributes":{"POSITION":0}})") + "}";
    std::string asked = "nothing";
    const auto model = read_gltf(as_bytes(json), [&](const std::string& path) -> Result<Bytes> {
      asked = path;
      return Bytes(36);
    });
    EXPECT_EQ(asked, c.path ? c.path : "nothing");
    EXPECT_EQ(model.has_value(), c.path != nullptr);
    if (!model) {
      EXPECT_EQ(model.error().path, "/buffers/0");
    }
  }
}

}  // namespace
}  // namespace pstrips
