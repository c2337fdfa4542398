#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "formats/obj/line_counts.h"
#include "tests/formats/obj/support.h"

namespace pstrips::test {
namespace {

using Doubles = std::vector<double>;
using Indices = std::vector<Index>;

constexpr std::string_view kThreePoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Model read_good(std::string_view text, const ReadFile& companions = files({})) {
  auto model = read_text(text, companions);
  if (!model) {
    ADD_FAILURE() << model.error().message << ", " << model.error().path;
    Model empty;
    empty.meshes.resize(1);
    return empty;
  }
  EXPECT_EQ(model->meshes.size(), 1u);
  EXPECT_EQ(check_round_trip(*model), "");
  return *model;
}
Mesh read_mesh(std::string_view text) { return read_good(text).meshes[0]; }
Mesh read_mesh_after_points(std::string text) {
  return read_mesh(std::string(kThreePoints) + std::move(text));
}

Doubles values_of(const Mesh& mesh, std::string_view semantic) {
  const Attribute* a = find_attribute(mesh.wedge_attributes, semantic);
  return a ? values(*a) : Doubles{};
}

TEST(ReadObj, ReadsPositionsAndPolygonsOfAnySize) {
  const Mesh mesh =
      read_mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 3 2 1\nf 4 1\nf 2\n");
  EXPECT_EQ(mesh.position.type, ComponentType::f32);
  EXPECT_EQ(values(mesh.position), Doubles({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(mesh.corners, Indices({0, 1, 2, 3, 2, 1, 0, 3, 0, 1}));
  EXPECT_EQ(mesh.face_first, Indices({0, 4, 7, 9, 10}));
  EXPECT_TRUE(mesh.wedge_vertex.empty());
  EXPECT_TRUE(mesh.wedge_attributes.empty());
}

TEST(ReadObj, UnderstandsHowFilesAreLaidOut) {
  const Mesh plain = read_mesh_after_points("f 1 2 3\n");
  const std::string_view kSame[] = {
      "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",  // byte order mark
      "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
      "v\t0\t0 \t0\n\n   \nv   1 0 0  \n  v 0 1 0\nf  1  2  3  \n",
      "v 0 0 0 # a\nv 1 0 0 #b\nv 0 1 0\nf 1 2 3 # c",
      "v 0 0 \\\n0\nv 1 \\\r\n 0 0\nv 0 1 0\nf 1\\\n 2 \\\n3\n",
      "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",  // references ahead
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1// 2/ 3\n",
      "v 0.0 0e0 +0\nv 1 0 0\nv 0 1e0 0\nf 1 2 3",
  };
  for (const std::string_view text : kSame) {
    SCOPED_TRACE(text);
    const auto model = read_text(text);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->meshes[0], plain);
  }
}

TEST(ReadObj, CountsRelativeIndicesFromTheLineTheyStandOn) {
  const Mesh mesh = read_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 9 9 9\nf -4 -3 -1\n");
  EXPECT_EQ(mesh.corners, Indices({0, 1, 2, 0, 1, 3}));
}

TEST(ReadObj, KeepsIsolatedAndCoincidentVerticesApart) {
  const Mesh mesh = read_mesh("v 1 1 1\nv 1 1 1\nv 1 1 1\nv 5 5 5\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_EQ(mesh.wedge_count(), 4u);
}

TEST(ReadObj, MakesAWedgeOfEachVertexWithItsTupleByValue) {
  const Mesh mesh = read_mesh_after_points(
      "vt 0 0\nvt 1 0\nvt 0 0\nvn 0 0 1\nvn 0 0 1\n"
      "f 1/1/1 2/2/1 3/3/1\nf 2/1/2 1/3/2 3/1/2\n");
  EXPECT_EQ(mesh.wedge_vertex, Indices({0, 1, 1, 2}));
  EXPECT_EQ(mesh.corners, Indices({0, 1, 3, 2, 0, 3}));
  EXPECT_EQ(values_of(mesh, "TEXCOORD_0"), Doubles({0, 0, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(values_of(mesh, "NORMAL"), Doubles({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(find_attribute(mesh.wedge_attributes, kObjPresent), nullptr);
}

TEST(ReadObj, TellsMinusZeroFromZero) {
  const Mesh mesh = read_mesh_after_points("vt 0 0\nvt -0 0\nf 1/1 2/1 3/1\nf 1/2 2/1 3/1\n");
  EXPECT_EQ(mesh.wedge_count(), 4u);
}

// Past 32 corners at a vertex wedges are told apart by sorting: the same answer.
TEST(ReadObj, NumbersTheWedgesOfACrowdedVertexByFirstUse) {
  std::string text(kThreePoints), faces;
  for (int i = 0; i < 100; ++i) {
    text += "vt " + std::to_string(99 - i % 50) + " 0\n";
    faces += "f 1/" + std::to_string(i + 1) + " 2/1 3/1\n";
  }
  const Mesh mesh = read_mesh(text + faces);
  ASSERT_EQ(mesh.wedge_count(), 52u);
  const Doubles uv = values_of(mesh, "TEXCOORD_0");
  for (Index i = 0; i < 100; ++i) {
    EXPECT_EQ(mesh.corners[3 * i], i % 50);
    EXPECT_EQ(uv[2 * mesh.corners[3 * i]], 99 - i % 50);
  }
}

TEST(ReadObj, RemembersWhichCornersLackSomething) {
  const Mesh mesh = read_mesh_after_points("vt 5 6\nvn 0 0 1\nf 1/1/1 2/1 3//1\nf 1 2/1/1 3\n");
  EXPECT_EQ(mesh.wedge_vertex, Indices({0, 0, 1, 1, 2, 2}));
  constexpr double kVt = kHasTexcoord | kHasTexV, kVn = kHasNormal;
  EXPECT_EQ(values_of(mesh, kObjPresent), Doubles({kVt + kVn, 0, kVt, kVt + kVn, kVn, 0}));
  EXPECT_EQ(values_of(mesh, "TEXCOORD_0"), Doubles({5, 6, 0, 0, 5, 6, 5, 6, 0, 0, 0, 0}));
}

TEST(ReadObj, DoesNotMissTuplesAtIsolatedVertices) {
  const Mesh mesh = read_mesh("v 0 0 0\nv 7 7 7\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 3//1 4//1\n");
  EXPECT_EQ(find_attribute(mesh.wedge_attributes, kObjPresent), nullptr);
  EXPECT_TRUE(mesh.wedge_vertex.empty());
}

TEST(ReadObj, ReadsTextureCoordinatesOfOneToThreeNumbers) {
  const Mesh mesh = read_mesh_after_points("vt 1\nvt 2 3\nvt 4 5 6\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(values_of(mesh, "TEXCOORD_0"), Doubles({1, 0, 2, 3, 4, 5}));
  EXPECT_EQ(values_of(mesh, kObjTexW), Doubles({0, 0, 6}));
  EXPECT_EQ(values_of(mesh, kObjPresent),
            Doubles({kHasTexcoord, kHasTexcoord | kHasTexV, kHasTexcoord | kHasTexV | kHasTexW}));
  const Mesh all = read_mesh_after_points("vt 1 2 0\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(find_attribute(all.wedge_attributes, kObjPresent), nullptr);
  EXPECT_NE(find_attribute(all.wedge_attributes, kObjTexW), nullptr);
}

TEST(ReadObj, ReadsColorsAndWeightsOfVertices) {
  const Mesh colors = read_mesh("v 0 0 0 1 .5 0\nv 1 0 0 0 1 .25\nv 0 1 0 0 0 1\nf 1 2 3\n");
  EXPECT_EQ(values_of(colors, "COLOR_0"), Doubles({1, .5, 0, 0, 1, .25, 0, 0, 1}));
  EXPECT_EQ(colors.wedge_attributes.size(), 1u);
  const Mesh weights = read_mesh("v 0 0 0 .5\nv 1 0 0 1\nv 0 1 0 2\nf 1 2 3\n");
  EXPECT_EQ(values_of(weights, kObjWeight), Doubles({.5, 1, 2}));
  EXPECT_EQ(weights.wedge_attributes.size(), 1u);
  const Mesh mixed = read_mesh("v 0 0 0\nv 1 0 0 .1 .2 .3 .4\nv 0 1 0 1 2 3\nv 0 0 0 9\nf 1 2 3\n");
  EXPECT_EQ(find_attribute(mixed.wedge_attributes, "COLOR_0")->count, 4);
  EXPECT_EQ(values_of(mixed, kObjPresent),
            Doubles({0, kHasColor | kHasAlpha, kHasColor, kHasWeight}));
}

TEST(ReadObj, KeepsDoublesWhereFloatsWouldLoseDecimals) {
  const Mesh floats = read_mesh("v 0.1 1234.5 1e-3\nv 0.333333 0 0\nv 3.1415927 0 0\nf 1 2 3\n");
  EXPECT_EQ(floats.position.type, ComponentType::f32);
  EXPECT_FLOAT_EQ(static_cast<float>(values(floats.position)[0]), 0.1f);
  const Mesh doubles = read_mesh("v 500123.4567 0 0\nvt .1 .2\nf 1/1\n");
  EXPECT_EQ(doubles.position.type, ComponentType::f64);
  EXPECT_EQ(values(doubles.position)[0], 500123.4567);
  EXPECT_EQ(find_attribute(doubles.wedge_attributes, "TEXCOORD_0")->type, ComponentType::f32);
  // What no corner uses does not count.
  const Mesh unused = read_mesh("v 0 0 0\nvt 0.123456789012 0\nvt .5 .5\nf 1/2\n");
  EXPECT_EQ(find_attribute(unused.wedge_attributes, "TEXCOORD_0")->type, ComponentType::f32);
}

TEST(ReadObj, KeepsInfinityAndNan) {
  const Doubles x = values(read_mesh("v nan -nan 1.#IND\nv inf -inf -1.#INF00\n").position);
  EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[1]) && std::isnan(x[2]));
  EXPECT_FALSE(std::signbit(x[0]));
  EXPECT_TRUE(std::signbit(x[1]));
  EXPECT_TRUE(std::isinf(x[3]) && x[4] < 0 && x[5] == x[4]);
}

TEST(ReadObj, ReadsLinesAndPoints) {
  const Mesh mesh = read_mesh_after_points("l 1 2 3\np 1 3\nf 1 2 3\nl 3 1\n");
  EXPECT_EQ(mesh.corners, Indices({0, 1, 2, 0, 2, 0, 1, 2, 2, 0}));
  EXPECT_EQ(mesh.face_first, Indices({0, 3, 4, 5, 8, 10}));
  EXPECT_EQ(mesh.face_group, Indices({0, 1, 1, 2, 0}));
  EXPECT_EQ(mesh.groups[0].kind, FaceKind::lines);
  EXPECT_EQ(mesh.groups[1].kind, FaceKind::points);
  EXPECT_EQ(mesh.groups[2].kind, FaceKind::polygons);
}

TEST(ReadObj, GivesAPointCloudItsNormals) {
  const Mesh cloud = read_mesh("vn 0 0 1\nv 1 2 3\nvn 0 1 0\nv 4 5 6\n");
  EXPECT_EQ(values_of(cloud, "NORMAL"), Doubles({0, 0, 1, 0, 1, 0}));
  const Model odd = read_good("vn 0 0 1\nv 1 2 3\nv 4 5 6\n");
  EXPECT_TRUE(odd.meshes[0].wedge_attributes.empty());
  EXPECT_EQ(foreign(odd, "obj/notes"), "1 unused vn lines\n");
}

TEST(ReadObj, GroupsByObjectGroupMaterialAndKind) {
  const Mesh mesh = read_mesh_after_points(
      "f 1 2 3\no a/b\ng x  y\nusemtl red\nf 1 2 3\ng z\nf 1 2 3\nusemtl blue paint \nf 1 2 3\n"
      "o c\ng x y\nusemtl red\nf 1 2 3\no a/b\nf 1 2 3\ng\nf 1 2 3\n");
  const std::vector<Group> expected = {
      {"", kNone, FaceKind::polygons},     {"a%2Fb/x y", 0, FaceKind::polygons},
      {"a%2Fb/z", 0, FaceKind::polygons},  {"a%2Fb/z", 1, FaceKind::polygons},
      {"c/x y", 0, FaceKind::polygons},    {"a%2Fb%n2/x y", 0, FaceKind::polygons},
      {"a%2Fb%n2/", 0, FaceKind::polygons}};
  EXPECT_EQ(mesh.groups, expected);
  EXPECT_EQ(mesh.face_group, Indices({0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(mesh.name, "");
}

TEST(ReadObj, NamesTheMeshAfterItsOnlyObject) {
  const Mesh mesh = read_mesh_after_points("o Cube\ng side/a\nf 1 2 3\n");
  EXPECT_EQ(mesh.name, "Cube");
  EXPECT_EQ(mesh.groups[0].name, "/side/a");
  EXPECT_EQ(read_mesh("o Cloud\nv 0 0 0\n").name, "Cloud");
}

TEST(ReadObj, KeepsSmoothingGroups) {
  const Mesh mesh =
      read_mesh_after_points("f 1 2 3\ns 4294967295\nf 1 2 3\ns off\nf 1 2 3\ns 2\nf 1 2 3\n");
  ASSERT_EQ(mesh.face_attributes.size(), 1u);
  EXPECT_EQ(mesh.face_attributes[0].type, ComponentType::u32);
  EXPECT_EQ(values(mesh.face_attributes[0]), Doubles({0, 4294967295.0, 0, 2}));
  EXPECT_EQ(read_mesh_after_points("s off\nf 1 2 3\n").face_attributes.size(), 1u);
  EXPECT_TRUE(read_mesh_after_points("f 1 2 3\n").face_attributes.empty());
}

TEST(ReadObj, KeepsWhatItDoesNotInterpret) {
  const Model model = read_good(
      "# made by hand\n\n#second\nv 0 0 0\n# a comment inside\nbevel on\ncstype bspline\n"
      "curv 0 1 \\\n 1 1\ns many\nvt 0 0\nf 1\n");
  EXPECT_EQ(foreign(model, "obj/header"), "# made by hand\n#second\n");
  EXPECT_EQ(foreign(model, "obj/notes"),
            "bevel on\ncstype bspline\ncurv 0 1    1 1\ns many\n1 unused vt lines\n");
  EXPECT_TRUE(model.meshes[0].wedge_attributes.empty());
}

TEST(ReadObj, ReadsAnEmptyFile) {
  for (const std::string_view text : {"", "\n", "# nothing here", "o\n"}) {
    SCOPED_TRACE(text);
    const Mesh mesh = read_mesh(text);
    EXPECT_EQ(mesh.vertex_count(), 0u);
    EXPECT_EQ(mesh.groups.size(), 1u);
  }
}

// Materials.

constexpr std::string_view kMtl =
    "# two\r\nnewmtl red\r\nKd 1 .5 0\r\nd .25\r\nTr .9\r\nNs 98\r\nmap_Kd -o 1 2 -s 3 -clamp on "
    "-bm 2 tex\\a b.png\r\n  newmtl  glow \n\tKe .5\nPm .75\nPr .125\nNs 5\nKd xyz 1 2 3\n";

TEST(ReadObj, ReadsMaterials) {
  const Model model = read_good(std::string(kThreePoints) +
                                    "usemtl red\nf 1 2 3\nusemtl none such\nf 1 2 3\n"
                                    "usemtl glow\nf 1 2 3\nmtllib sub\\m.mtl\n",
                                files({{"sub/m.mtl", std::string(kMtl)}}));
  ASSERT_EQ(model.scene.materials.size(), 3u);
  const Material& red = model.scene.materials[0];
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.base_color, (std::array<double, 4>{1, .5, 0, .25}));
  EXPECT_DOUBLE_EQ(red.roughness, std::sqrt(2. / 100));
  EXPECT_EQ(red.metallic, 0);
  ASSERT_EQ(model.scene.images.size(), 1u);
  EXPECT_EQ(model.scene.images[red.image(MapRole::base_color)].uri, "tex/a b.png");
  const Material& glow = model.scene.materials[1];
  EXPECT_EQ(glow.name, "glow");
  EXPECT_EQ(glow.emissive, (std::array<double, 3>{.5, .5, .5}));
  EXPECT_EQ(glow.metallic, .75);
  EXPECT_EQ(glow.roughness, .125);
  EXPECT_EQ(glow.base_color, (std::array<double, 4>{1, 1, 1, 1}));
  EXPECT_EQ(model.scene.materials[2].name, "none such");
  EXPECT_EQ(model.meshes[0].groups[0].material, 0u);
  EXPECT_EQ(model.meshes[0].groups[1].material, 2u);
  EXPECT_EQ(model.meshes[0].groups[2].material, 1u);
  EXPECT_EQ(foreign(model, "obj/mtl"), kMtl);
}

TEST(ReadObj, TakesTheFirstMaterialOfAName) {
  const Model model =
      read_good("mtllib a.mtl b.mtl\nmtllib a.mtl\nv 0 0 0\nusemtl x\nf 1\n",
                files({{"a.mtl", "newmtl x\nKd 1 0 0"}, {"b.mtl", "newmtl x\nKd 0 1 0"}}));
  ASSERT_EQ(model.scene.materials.size(), 2u);
  EXPECT_EQ(model.meshes[0].groups[0].material, 0u);
  EXPECT_EQ(model.scene.materials[0].base_color[0], 1);
}

TEST(ReadObj, FindsLibrariesWithSpacesInTheirNames) {
  const auto companions =
      files({{"a b.mtl", "newmtl ab\n"}, {"c.mtl", "newmtl c\n"}, {"d.mat", "newmtl d\n"}});
  const auto materials = [&](std::string_view line) {
    std::string out;
    for (const Material& m : read_good(line, companions).scene.materials) out += m.name + ' ';
    return out;
  };
  EXPECT_EQ(materials("mtllib a b.mtl\n"), "ab ");
  EXPECT_EQ(materials("mtllib a b.mtl c.mtl\n"), "ab c ");
  EXPECT_EQ(materials("mtllib c.mtl a\\ b.mtl\n"), "c ab ");
  EXPECT_EQ(materials("mtllib c.mtl d.mat\n"), "c d ");
  EXPECT_EQ(materials("mtllib x.mat d.mat\n"), "d ");
}

TEST(ReadObj, AsksForNothingOutsideTheFolder) {
  std::vector<std::string> asked;
  const ReadFile spy = [&](const std::string& name) -> Result<Bytes> {
    asked.push_back(name);
    return fail(ErrorCode::io, "no such file");
  };
  const auto model = read_text(
      "mtllib ../up.mtl\nmtllib /etc/root.mtl C:\\win.mtl\nmtllib ok.mtl\nmtllib ok.mtl\nmtllib "
      "a\\..\\..\\b.mtl\n",
      spy);
  ASSERT_TRUE(model);
  EXPECT_EQ(asked, std::vector<std::string>{"ok.mtl"});
  EXPECT_EQ(foreign(*model, "obj/mtllib"),
            "../up.mtl\n/etc/root.mtl\nC:\\win.mtl\nok.mtl\na\\..\\..\\b.mtl\n");
}

TEST(ReadObj, PassesOnWhatIsWrongWithACompanion) {
  const ReadFile refuses = [](const std::string&) -> Result<Bytes> {
    return fail(ErrorCode::over_limit, "too large", 7, "m.mtl");
  };
  const auto model = read_text("mtllib m.mtl\n", refuses);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error(), (Error{ErrorCode::over_limit, "too large", 7, "m.mtl"}));
}

TEST(ReadObj, TakesTuplesThatAreNotThereForNone) {
  std::vector<std::string> notes;
  const auto model = read_obj(as_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .5 .5\nvn 0 0 1\n"
                                       "f 1/1/0 2/2/1 3/-2/1\nf 1/0 2/1/9 3//1\n"),
                              files({}), {}, {.notes = &notes});
  ASSERT_TRUE(model);
  EXPECT_EQ(notes, (std::vector<std::string>{"the vt of 3 corners, which is 0 or names no line",
                                             "the vn of 2 corners, which is 0 or names no line"}));
  const Mesh& mesh = model->meshes[0];
  const Attribute* present = find_attribute(mesh.wedge_attributes, kObjPresent);
  ASSERT_NE(present, nullptr);
  const auto has = [&](std::size_t corner) { return values(*present)[mesh.corners[corner]]; };
  EXPECT_EQ(has(0), kHasTexcoord | kHasTexV);
  EXPECT_EQ(has(1), kHasNormal);
  EXPECT_EQ(has(2), kHasNormal);
  EXPECT_EQ(has(3), 0);
}

// Bad files.

struct BadFile {
  const char* name;
  std::string_view text;
  ErrorCode code;
  std::string_view line;
  std::uint64_t offset;
};
constexpr BadFile kBadFiles[] = {
    {"index_zero", "v 0 0 0\nf 1 0 1\n", ErrorCode::corrupt, "line 2", 12},
    {"vertex_past_the_end", "v 0 0 0\nf 1 2\n\n", ErrorCode::corrupt, "line 2", 12},
    {"first_of_many_past_the_end", "v 0 0 0\nf 3\nf 9\nf 4\n", ErrorCode::corrupt, "line 2", 10},
    {"relative_before_the_start", "v 0 0 0\nf -2\n", ErrorCode::corrupt, "line 2", 10},
    {"huge_index", "v 0 0 0\nf 18446744073709551617\n", ErrorCode::corrupt, "line 2", 10},
    {"index_is_a_fraction", "v 0 0 0\nf 1.5\n", ErrorCode::corrupt, "line 2", 11},
    {"index_is_a_word", "v 0 0 0\nf one\n", ErrorCode::corrupt, "line 2", 10},
    {"four_parts", "v 0 0 0\nf 1///1\n", ErrorCode::corrupt, "line 2", 13},
    {"no_vertex_in_a_corner", "v 0 0 0\nf /1\n", ErrorCode::corrupt, "line 2", 10},
    {"face_without_corners", "f\nv 0 0 0\n", ErrorCode::corrupt, "line 1", 1},
    {"line_without_corners", "l # none\n", ErrorCode::corrupt, "line 1", 2},
    {"two_numbers_in_v", "v 0 0\nv 0 0 0\n", ErrorCode::corrupt, "line 1", 5},
    {"five_numbers_in_v", "v 0 0 0 1 1\n", ErrorCode::corrupt, "line 1", 11},
    {"eight_numbers_in_v", "v 1 2 3 4 5 6 7 8\n", ErrorCode::corrupt, "line 1", 16},
    {"word_in_v", "v 0 zero 0\n", ErrorCode::corrupt, "line 1", 4},
    {"comma_in_v", "v 0,5 0 0\n", ErrorCode::corrupt, "line 1", 2},
    {"number_out_of_range", "v 1e999 0 0\n", ErrorCode::corrupt, "line 1", 2},
    {"two_numbers_in_vn", "vn 0 1\n", ErrorCode::corrupt, "line 1", 6},
    {"empty_vt", "vt\n", ErrorCode::corrupt, "line 1", 2},
    {"four_numbers_in_vt", "vt 0 0 0 0\n", ErrorCode::corrupt, "line 1", 9},
    {"continued_line", "v 0 0 0\nf 1 \\\r\n 2 \\\n x\n", ErrorCode::corrupt, "line 4", 21},
    {"carriage_returns", "v 0 0 0\rv 1\rf 1\r", ErrorCode::corrupt, "line 2", 11},
    {"nul_byte", std::string_view("v 0 0 0\0\n", 9), ErrorCode::corrupt, "line 1", 6},
    {"another_format", "\n# x\nply\nformat ascii 1.0\n", ErrorCode::corrupt, "line 3", 5},
    {"cut_in_v", "v 0 0 0\nv 1 2", ErrorCode::truncated, "line 2", 13},
    {"cut_in_vn", "vn 1", ErrorCode::truncated, "line 1", 4},
    {"cut_after_f", "v 0 0 0\nf ", ErrorCode::truncated, "line 2", 10},
    {"cut_in_an_index", "v 0 0 0\nf -", ErrorCode::truncated, "line 2", 11},
    {"cut_in_a_continued_line", "v 0 0 0\nv 1 \\", ErrorCode::truncated, "line 2", 13},
};

TEST(ReadObj, RefusesBadFilesWithCodeLineAndOffset) {
  for (const BadFile& file : kBadFiles) {
    SCOPED_TRACE(file.name);
    // A copy of exactly this size, so that a sanitizer sees a read past the end.
    const Bytes bytes(as_bytes(file.text).begin(), as_bytes(file.text).end());
    const auto model = read_obj(bytes, {});
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, file.code) << model.error().message;
    EXPECT_EQ(model.error().path, file.line);
    EXPECT_EQ(model.error().offset, file.offset);
  }
}

TEST(ReadObj, KeepsWithinItsLimits) {
  const struct {
    const char* name;
    std::string_view text;
    Limits limits;
  } kRows[] = {
      {"vertices", "v 0 0 0\nv 0 0 0\nv 0 0 0\n", {.vertices = 2}},
      {"wedges", "v 0 0 0\nvt 1\nvt 2\nvt 3\nf 1/1 1/2 1/3\n", {.wedges = 2}},
      {"texture coordinates", "vt 0\nvt 0\nvt 0\n", {.wedges = 2}},
      {"corners", "v 0 0 0\nf 1 1 1\n", {.corners = 2}},
      {"groups", "v 0 0 0\nf 1\ng a\nf 1\ng b\nf 1\n", {.meshes = 2}},
      {"materials", "mtllib m.mtl\n", {.meshes = 2}},
      {"materials by name", "mtllib n.mtl\nv 0 0 0\nusemtl q\nf 1\nl 1\n", {.meshes = 2}},
      {"material text", "mtllib m.mtl\n", {.string_bytes = 20}},
      {"comments", "# 0123456789\n# 0123456789\n", {.string_bytes = 20}},
      {"unknown statements", "v 0 0 0\nx 0123456789\nx 0123456789\n", {.string_bytes = 20}},
      {"memory", "v 0 0 0\nv 0 0 0\nv 0 0 0\n", {.memory_bytes = 200}},
  };
  const auto companions =
      files({{"m.mtl", "newmtl a\nnewmtl b\nnewmtl c\n"}, {"n.mtl", "newmtl a\nnewmtl b\n"}});
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(read_obj(as_bytes(row.text), companions));
    const auto model = read_obj(as_bytes(row.text), companions, row.limits);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::over_limit) << model.error().message;
  }
}

// The beginnings of lines tell before a number is read: the one that is none stays unseen.
TEST(ReadObj, RefusesWhatDoesNotFitBeforeWorkStarts) {
  std::string text = "v wrong\n";
  for (int i = 0; i < 999; ++i) text += "v 0 0 0\nvt 0\nvn 0 0 1\nf 1/1/1 1/1/1 1/1/1\n";
  const auto message = [&](const Limits& limits) {
    const auto model = read_obj(as_bytes(text), {}, limits);
    return model ? "" : model.error().message;
  };
  EXPECT_EQ(message({.vertices = 900}), "1000 vertices, more than the limit of 900");
  EXPECT_EQ(message({.wedges = 900}), "1998 vt and vn lines, more than the limit of 1800");
  EXPECT_EQ(message({.corners = 900}), "999 face corners, more than the limit of 900");
  EXPECT_EQ(message({.memory_bytes = 150'000}),
            "195900 bytes of memory, more than the limit of 150000");
  EXPECT_EQ(message({.vertices = 1000}), "not a number, or not in the range of a double");
}

TEST(ReadObj, CountsNoStatementsInContinuedLines) {
  std::string text;
  for (int i = 0; i < 5; ++i) text += "v 0 0 0\nl \\\nf 1 \\\r\nv 0 0 0\n#\\\nv 1 1 1\n";
  const obj::LineCounts counts = obj::count_lines(text);
  EXPECT_EQ(counts.vertices, 5u);
  EXPECT_EQ(counts.faces, 0u);
}

TEST(ReadObj, DoesNotMultiplyALongObjectName) {
  std::string text = "v 0 0 0\nf 1\no " + std::string(100'000, 'a') + '\n';
  for (int i = 0; i < 1000; ++i) text += "g " + std::to_string(i) + "\nf 1\n";
  const auto model = read_text(text);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::over_limit);
}

}  // namespace
}  // namespace pstrips::test
