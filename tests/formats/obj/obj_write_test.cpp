#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "tests/formats/obj/support.h"
#include "tests/support/meshes.h"

namespace pstrips::test {
namespace {

template <class T>
Attribute wedge_attribute(std::string semantic, ComponentType type, std::uint8_t count,
                          std::vector<T> data, bool normalized = false) {
  const ByteView bytes = std::as_bytes(std::span(data));
  return {std::move(semantic), type, count, normalized, Bytes(bytes.begin(), bytes.end())};
}

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.meshes = std::move(meshes);
  model.scene.texture_origin = TextureOrigin::lower_left;
  return model;
}

std::string text_of(const Model& model) {
  const auto written = write_obj(model, "m.mtl");
  return written ? std::string(as_text(written->obj)) : "error: " + written.error().message;
}

TEST(WriteObj, MakesTheSameTextWithAnyNumberOfThreads) {
  Model model;
  model.meshes.push_back(polygon_soup(5, 20'000, 30'000));  // several runs of lines, three groups
  model.meshes.push_back(grid(100));
  const Bytes one = write_obj(model, "", 1).value().obj;
  EXPECT_EQ(one, write_obj(model, "", 3).value().obj);
  EXPECT_EQ(read_obj(one, {}).value().meshes.at(0).face_count(), 30'000u + 2 * 99 * 99);
}

TEST(WriteObj, WritesTheShortestText) {
  const auto model = read_text(
      "o Cube\nv 0.10 0 1e3\nv 0.500001234 2 3\nv 1 1 1 .5 .5 .5\nvt 0 0\nvt 0 0\nvn 0 0 1\n"
      "vn 0 1 0\ng a\nusemtl m\ns 1\nf 1/1/1 2/2/2 3\ng b\nl 1 2\np 3 2\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(text_of(*model),
            "o Cube\nv 0.1 0 1000\nv 0.500001234 2 3\nv 1 1 1 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
            "vn 0 1 0\ng a\nusemtl m\ns 1\nf 1/1/1 2/1/2 3\ng b\nl 1 2\np 3\np 2\n");
}

TEST(WriteObj, WritesSeveralMeshesAsObjects) {
  Mesh one = triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}), two = cube(true);
  one.name = "one";
  const auto written = write_obj(model_of({one, two, one}), "");
  ASSERT_TRUE(written);
  EXPECT_TRUE(written->dropped.empty());
  const auto again = read_files(*written);
  ASSERT_TRUE(again);
  const Mesh& mesh = again->meshes.at(0);
  EXPECT_EQ(mesh.vertex_count(), 14u);
  EXPECT_EQ(mesh.face_count(), 14u);
  ASSERT_EQ(mesh.groups.size(), 3u);
  EXPECT_EQ(mesh.groups[0].name, "one/");
  EXPECT_EQ(mesh.groups[1].name, "mesh_2/");
  EXPECT_EQ(mesh.groups[2].name, "one%n2/");
  EXPECT_EQ(mesh.vertex_of(mesh.face(13)[0]), 11u);
}

TEST(WriteObj, SaysWhatItDrops) {
  Mesh mesh = triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  mesh.wedge_vertex = {0, 1, 2, 2};
  const std::vector<float> zeros(16);
  mesh.wedge_attributes = {
      wedge_attribute("TANGENT", ComponentType::f32, 4, zeros),
      wedge_attribute("NORMAL", ComponentType::f32, 3,
                      std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0}),
      wedge_attribute("COLOR_0", ComponentType::u8, 3,
                      std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0}, true)};
  mesh.face_attributes = {wedge_attribute("quality", ComponentType::f32, 1, std::vector<float>{1})};
  Model model = model_of({mesh});
  model.scene.materials.resize(1);
  model.scene.materials[0].double_sided = true;
  model.scene.images.resize(1);
  model.scene.images[0].data = {std::byte{1}};
  model.scene.nodes.resize(2);
  model.scene.nodes[0].matrix[12] = 1;
  model.scene.nodes[0].meshes = model.scene.nodes[1].meshes = {0};
  const auto written = write_obj(model, "m.mtl");
  ASSERT_TRUE(written);
  EXPECT_EQ(written->dropped,
            (std::vector<std::string>{"COLOR_0", "NORMAL of wedges without a face", "TANGENT",
                                      "double_sided", "embedded images", "node instances",
                                      "node transforms", "quality"}));
}

TEST(WriteObj, MakesMaterialsThatReadBackTheSame) {
  Model model = model_of({triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 1})});
  Scene& scene = model.scene;
  scene.images.push_back({.name = {}, .uri = "tex/wood grain.png", .mime_type = {}, .data = {}});
  Material a{.name = "a\n b",
             .base_color = {.1, .2, .3, .4},
             .emissive = {1, 2, 3},
             .metallic = .7,
             .roughness = .2,
             .alpha_mode = AlphaMode::blend,
             .maps = {{.image = 0}}};
  scene.materials = {a, Material{}, Material{}};
  scene.materials[2].name = "material";
  model.meshes[0].groups = {{"", 0, FaceKind::polygons}, {"", 2, FaceKind::polygons}};
  model.meshes[0].face_group = {0, 1};
  const auto written = write_obj(model, "the materials.mtl");
  ASSERT_TRUE(written);
  EXPECT_EQ(written->mtl_name, "the materials.mtl");
  const auto again = read_files(*written);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->scene.materials.size(), 3u);
  a.name = "a  b";
  EXPECT_EQ(again->scene.materials[0], a);
  EXPECT_EQ(again->scene.materials[1].name, "material");
  EXPECT_EQ(again->scene.materials[2].name, "material_2");
  EXPECT_EQ(again->scene.images, scene.images);
  EXPECT_EQ(again->meshes[0].groups, model.meshes[0].groups);
}

TEST(WriteObj, KeepsTheOriginalMaterialTextOnlyWhileItHolds) {
  const auto companions = files({{"m.mtl", "# by hand\nnewmtl a\nKd 1 0 0\nillum 2\n"}});
  auto model = read_text("mtllib m.mtl\nv 0 0 0\nusemtl a\nf 1\n", companions);
  ASSERT_TRUE(model);
  EXPECT_EQ(as_text(write_obj(*model, "n.mtl")->mtl), "# by hand\nnewmtl a\nKd 1 0 0\nillum 2\n");
  model->scene.materials[0].base_color[1] = 1;
  EXPECT_EQ(as_text(write_obj(*model, "n.mtl")->mtl),
            "newmtl a\nKd 1 1 0\nKs 0.04 0.04 0.04\nNs 0\nillum 2\nPm 0\nPr 1\n");
}

TEST(WriteObj, RefusesNamesThatAReaderWould) {
  for (const std::string name : {"../a.mtl", "/a.mtl", "a\nb.mtl", " a.mtl", "C:a.mtl"}) {
    SCOPED_TRACE(name);
    const auto written = write_obj(model_of({cube(false)}), name);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::bad_argument);
  }
}

TEST(WriteObj, NamesThatEndInABackslashDoNotSwallowTheNextLine) {
  Mesh mesh = cube(false);
  mesh.name = "a\\";
  mesh.groups[0].name = "b\\";
  EXPECT_EQ(check_round_trip(model_of({mesh})), "");
}

// Whatever the mesh, what is written reads back with its vertices, faces and tuples.
RC_GTEST_PROP(WriteObj, KeepsEveryFaceOfAnyMesh, ()) {
  const auto vertices = *rc::gen::inRange<Index>(0, 12);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  Mesh mesh = random_soup(seed, vertices, *rc::gen::inRange<Index>(0, 30));
  std::mt19937 random(seed);
  std::vector<float> uv(std::size_t{2} * mesh.wedge_count());
  for (float& x : uv) x = static_cast<float>(random() % 3) / 7;
  mesh.wedge_attributes = {wedge_attribute("TEXCOORD_0", ComponentType::f32, 2, uv)};
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    mesh.groups[g].name = "g" + std::to_string(g);
  const auto written = write_obj(model_of({mesh}), "");
  RC_ASSERT(written.has_value());
  const auto again = read_files(*written);
  RC_ASSERT(again.has_value());
  RC_ASSERT(check_round_trip(*again).empty());
  const Mesh& read = again->meshes[0];
  RC_ASSERT(read.position == mesh.position);
  RC_ASSERT(read.face_count() == mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    RC_ASSERT(read.groups[read.group_of(f)] == mesh.groups[mesh.group_of(f)]);
    RC_ASSERT(read.face(f).size() == mesh.face(f).size());
    for (std::size_t k = 0; k < mesh.face(f).size(); ++k) {
      const Index w = mesh.face(f)[k], r = read.face(f)[k];
      RC_ASSERT(read.vertex_of(r) == mesh.vertex_of(w));
      RC_ASSERT(std::ranges::equal(read.wedge_attributes[0].element(r),
                                   mesh.wedge_attributes[0].element(w)));
    }
  }
}

TEST(WriteObj, TurnsTextureCoordinatesFromTheUpperLeft) {
  Mesh mesh = triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  mesh.wedge_attributes = {wedge_attribute(
      "TEXCOORD_0", ComponentType::u8, 2, std::vector<std::uint8_t>{0, 0, 255, 255, 51, 51}, true)};
  Model model = model_of({mesh});
  model.scene.texture_origin = TextureOrigin::upper_left;
  EXPECT_NE(text_of(model).find("vt 0 1\nvt 1 0\nvt 0.2 0.8\n"), std::string::npos);
  // The float nearest to 0.3 is not 1 minus the one nearest to 0.7: a decimal in between is both.
  model.meshes[0].wedge_attributes = {wedge_attribute(
      "TEXCOORD_0", ComponentType::f32, 2, std::vector<float>{0, 0.1f, 0, 0.3f, 0, 0.7f})};
  const std::string text = text_of(model);
  for (const float v : {0.1f, 0.3f, 0.7f}) {
    bool found = false;
    for (std::size_t at = text.find("vt "); at != text.npos; at = text.find("vt ", at + 1))
      found |= static_cast<float>(1 - std::stod(text.substr(at + 5))) == v;
    EXPECT_TRUE(found) << v << '\n' << text;
  }
}

TEST(WriteObj, KeepsTheGeneratedMeshes) {
  for (const Mesh& mesh : {grid(20), torus(9, 7), cube(false)})
    EXPECT_EQ(check_round_trip(model_of({mesh})), "");
  const auto again = read_files(*write_obj(model_of({cube(true)}), ""));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->meshes[0].wedge_count(), 24u);
}

// Damaged files are refused with a position, or they are files like any other.
TEST(ReadObj, TakesAnyDamage) {
  constexpr std::string_view kSeed =
      "# head\nmtllib m.mtl\no a/b\nv 0 0 0\nv 1 0 0 .5\nv 0 1 0 1 0 .25\nv 1 1 0.12345678901 1 0 "
      "1 "
      ".5\nvt 0\nvt 1 0\nvt 0 1 2\nvn 0 0 1\ng x y\nusemtl m\ns 1\nf 1/1/1 2/2/1 3/3\nf -1 -2//1 "
      "\\\n "
      "-3/2\ns off\ng\nl 1 2 3\np 4 1\nusemtl q\\\nf 2/1 3 4\nbevel on\nv nan -inf 1e-7\n";
  const auto companions = files({{"m.mtl", "newmtl m\nKd 1 0 0\nmap_Kd -o 1 a.png\n"}});
  constexpr std::string_view kPieces[] = {"\n", "\\\n",       "/",   " ",       "-",    "0",
                                          "1",  "9999999999", "v ",  "f ",      "#",    "s ",
                                          "o ", "g ",         "\r",  "usemtl ", "p ",   "e5",
                                          ".",  "nan",        "vt ", "\xff",    "vn 0", "# note: "};
  std::mt19937 random(7);
  int accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text(kSeed);
    for (unsigned edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text.erase(at, 1 + random() % 8);
          break;
        case 1:
          text.insert(at, kPieces[random() % std::size(kPieces)]);
          break;
        case 2:
          text[at] = static_cast<char>(random());
          break;
        default:
          text.resize(at + 1);
      }
    }
    const auto model = read_text(text, companions);
    if (!model) {
      ASSERT_LE(model.error().offset, text.size()) << text;
      ASSERT_TRUE(model.error().path.starts_with("line ")) << text;
      continue;
    }
    ++accepted;
    ASSERT_EQ(check_round_trip(*model), "") << text;
  }
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace pstrips::test
