#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <set>

#include "formats/ply/ply.h"
#include "tests/formats/ply/ply_text.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

using Format = PlyWriteOptions::Format;

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  const auto view = std::as_bytes(std::span(values));
  return Bytes(view.begin(), view.end());
}

Model model_of(Mesh mesh) {
  Model model;
  canonicalize(mesh);
  model.meshes.push_back(std::move(mesh));
  return model;
}

Model read_text(const std::string& text) {
  auto model = read_ply(as_bytes(text));
  EXPECT_TRUE(model) << model.error().message;
  return model ? *std::move(model) : Model{};
}

std::string text_of(const Model& model, Format format = Format::ascii) {
  const auto file = write_ply(model, {format});
  return file ? std::string(as_text(*file)) : file.error().message;
}

/// Vertex and attribute values of a wedge, by semantic so that the attributes' order is free.
std::string content(const Mesh& mesh, Index wedge) {
  std::set<std::string> parts;
  for (const Attribute& a : mesh.wedge_attributes)
    parts.insert(a.semantic + ' ' + std::string(name_of(a.type)) + (a.normalized ? "n " : " ") +
                 std::string(as_text(a.element(wedge))));
  std::string out = std::to_string(mesh.vertex_of(wedge));
  for (const std::string& part : parts) out += '|' + part;
  return out;
}

/// Everything of a mesh but the numbers of its wedges and the order of its attributes.
struct Content {
  Attribute position;
  std::set<std::string> wedges;
  std::vector<std::vector<std::string>> faces;
  std::vector<Attribute> face_attributes;
  friend bool operator==(const Content&, const Content&) = default;
};

Content content(const Mesh& mesh) {
  Content out{mesh.position, {}, {}, mesh.face_attributes};
  for (Index w = 0; w < mesh.wedge_count(); ++w) out.wedges.insert(content(mesh, w));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    auto& face = out.faces.emplace_back();
    for (const Index w : mesh.face(f)) face.push_back(content(mesh, w));
  }
  std::ranges::sort(out.face_attributes, {}, &Attribute::semantic);
  return out;
}

void expect_recovered(const Model& model) {
  for (const Format format : test::kFormats) {
    const auto file = write_ply(model, {format});
    ASSERT_TRUE(file) << file.error().message;
    const auto again = read_ply(*file);
    ASSERT_TRUE(again) << again.error().message << ' ' << again.error().path;
    EXPECT_TRUE(content(again->meshes.at(0)) == content(model.meshes.at(0)));
    EXPECT_EQ(test::round_trip_failure(*again), "");
  }
}

TEST(WritePly, RecoversGeneratedMeshes) {
  expect_recovered(model_of(test::grid(20)));
  expect_recovered(model_of(test::torus(7, 9)));
  expect_recovered(model_of(test::cube(false)));
  expect_recovered(model_of(test::cube(true)));
  expect_recovered(model_of(Mesh{}));
}

TEST(WritePly, MakesTheSameTextWithAnyNumberOfThreads) {
  Model model;
  model.meshes.push_back(test::polygon_soup(3, 20'000, 30'000));  // several runs of rows
  const auto text = [&](unsigned threads) {
    return write_ply(model, {.format = PlyWriteOptions::Format::ascii, .threads = threads}).value();
  };
  const Bytes one = text(1);
  EXPECT_EQ(one, text(3));
  EXPECT_EQ(read_ply(one).value().meshes.at(0).face_count(), 30'000u);
}

// A triangle, a line of three corners and a point, as an OBJ file may have them.
Mesh mixed() {
  Mesh mesh = test::triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 2}, {0, 1, 2, 3, 1, 0, 2});
  mesh.groups = {
      {"", kNone, FaceKind::polygons}, {"", kNone, FaceKind::lines}, {"", kNone, FaceKind::points}};
  mesh.face_first = {0, 3, 6, 7};
  mesh.face_group = {0, 1, 2};
  return mesh;
}

TEST(WritePly, LinesBecomeEdges) {
  const std::string text = text_of(model_of(mixed()));
  EXPECT_NE(text.find("element face 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"),
            std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("3 0 1 2\n3 1\n1 0\n")) << text;
}

TEST(WritePly, EdgesComeBackAsLines) {
  for (const Format format : {Format::ascii, Format::little_endian, Format::big_endian}) {
    const Model model = read_text(text_of(model_of(mixed()), format));
    ASSERT_EQ(model.meshes.size(), 1u);
    const Mesh& mesh = model.meshes[0];
    EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 2, 3, 1, 1, 0}));
    EXPECT_EQ(mesh.face_first, (std::vector<Index>{0, 3, 5, 7}));
    EXPECT_EQ(mesh.groups.at(mesh.group_of(2)).kind, FaceKind::lines);
    const auto again = write_ply(model, {format});
    ASSERT_TRUE(again);
    EXPECT_EQ(as_text(*again), text_of(model_of(mixed()), format));
  }
}

TEST(WritePly, PointsAreVertices) {
  Mesh mesh = test::triangle_mesh({0, 0, 0, 1, 0, 0}, {0, 1});
  mesh.groups[0].kind = FaceKind::points;
  mesh.face_first = {0, 1, 2};
  EXPECT_EQ(text_of(model_of(mesh)),
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0 0 0\n1 0 0\n");
}

TEST(WritePly, SaysWhatVerticesNoLongerGoWith) {
  Model model = read_text(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty list uchar int near\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 1 1\n1 0 0 0\n0 1 0 0\n3 0 1 2\n");
  EXPECT_TRUE(has_rows_bound_to_order(model.scene));
  std::vector<std::string> dropped;
  ASSERT_TRUE(write_ply(model, {}, &dropped));
  EXPECT_TRUE(dropped.empty());
  model.meshes[0].corners = {1, 2, 0};
  ASSERT_TRUE(write_ply(model, {}, &dropped));
  EXPECT_EQ(dropped, std::vector<std::string>{"list near of vertex"});
}

TEST(WritePly, RowsAreVerticesWhereWedgesAgree) {
  Mesh mesh = test::cube(true);
  mesh.wedge_attributes.clear();
  EXPECT_EQ(text_of(model_of(mesh)).substr(0, 46),
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty");
}

TEST(WritePly, WedgesThatDifferInTexcoordsAloneBecomeFaceLists) {
  Mesh mesh = test::cube(true);
  std::erase_if(mesh.wedge_attributes, [](const Attribute& a) { return a.semantic == "NORMAL"; });
  const std::string text = text_of(model_of(mesh));
  EXPECT_NE(text.find("element vertex 8\n"), std::string::npos);
  EXPECT_NE(text.find("property list uchar int vertex_indices\nproperty list uchar float "
                      "texcoord\nend_header\n"),
            std::string::npos);
  expect_recovered(model_of(mesh));
}

TEST(WritePly, AnUnusedWedgeIsNotLost) {
  Mesh mesh = test::cube(true);
  std::erase_if(mesh.wedge_attributes, [](const Attribute& a) { return a.semantic == "NORMAL"; });
  mesh.wedge_vertex.push_back(0);
  const float unused[] = {7, 8};
  const auto view = std::as_bytes(std::span(unused));
  mesh.wedge_attributes[0].data.insert(mesh.wedge_attributes[0].data.end(), view.begin(),
                                       view.end());
  expect_recovered(model_of(mesh));
}

TEST(WritePly, WedgesOfOtherKindsAreRowsAndComeBackInOrder) {
  const Model model = model_of(test::cube(true));
  const std::string text = text_of(model);
  EXPECT_NE(text.find("element vertex 24\n"), std::string::npos);
  EXPECT_EQ(read_text(text).meshes, model.meshes);
}

TEST(WritePly, NamesWhatItKnowsByTheUsualWords) {
  Mesh mesh = test::triangle_mesh({0, 0, 0}, {});
  mesh.wedge_attributes = {
      {"COLOR_0", ComponentType::u8, 4, true, bytes_of<std::uint8_t>({1, 2, 3, 4})},
      {"COLOR_1", ComponentType::u8, 3, true, bytes_of<std::uint8_t>({5, 6, 7})},
      {"NORMAL", ComponentType::f32, 3, false, bytes_of<float>({0, 0, 1})},
      {"TEXCOORD_0", ComponentType::f32, 2, false, bytes_of<float>({8, 9})},
      {"_VALUE", ComponentType::i32, 1, false, bytes_of<std::int32_t>({-1})},
      {"x", ComponentType::i8, 1, false, bytes_of<std::int8_t>({-2})},
      {"two words", ComponentType::u16, 2, true, bytes_of<std::uint16_t>({3, 4})}};
  EXPECT_EQ(
      text_of(model_of(mesh)),
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
      "property uchar COLOR_1[0]n\nproperty uchar COLOR_1[1]n\nproperty uchar COLOR_1[2]n\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float "
      "t\n"
      "property int _VALUE\nproperty char x[0]\nproperty ushort two%20words[0]n\n"
      "property ushort two%20words[1]n\nend_header\n0 0 0 1 2 3 4 5 6 7 0 0 1 8 9 -1 -2 3 4\n");
  expect_recovered(model_of(mesh));
}

const std::string kLabelled =
    "ply\nformat ascii 1.0\ncomment before\nelement vertex 3\nproperty float32 x\nproperty float32 "
    "y\nproperty float32 z\n"
    "comment colours\nproperty uint8 red\nproperty uint8 green\nproperty uint8 blue\nproperty int "
    "label\n"
    "property list uchar int near\nelement face 1\nproperty list uint8 uint8 vertex_index\nelement "
    "camera 1\nproperty float focal\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\ncomment last\nend_header\n"
    "0 0 0 1 2 3 4 1 1\n1 0 0 1 2 3 5 0\n0 1 0 1 2 3 6 0\n3 0 1 2\n0.5\n0 1\n";

TEST(WritePly, DropsTheWordsOfAttributesThatAreGone) {
  Model model = read_text(kLabelled);
  std::erase_if(model.meshes.at(0).wedge_attributes,
                [](const Attribute& a) { return a.semantic == "COLOR_0"; });
  EXPECT_EQ(text_of(model),
            "ply\nformat ascii 1.0\ncomment before\nelement vertex 3\nproperty float32 x\nproperty "
            "float32 y\nproperty float32 z\n"
            "comment colours\nproperty int label\nproperty list uchar int near\nelement face 1\n"
            "property list uint8 uint8 vertex_index\nelement camera 1\nproperty float focal\n"
            "element edge 1\nproperty int vertex1\nproperty int vertex2\ncomment last\nend_header\n"
            "0 0 0 4 1 1\n1 0 0 5 0\n0 1 0 6 0\n3 0 1 2\n0.5\n0 1\n");
}

TEST(WritePly, DropsRowsBoundToVerticesThatChanged) {
  Model model = read_text(kLabelled);
  Mesh& mesh = model.meshes.at(0);
  std::swap(mesh.corners[0], mesh.corners[1]);
  EXPECT_EQ(text_of(model),
            "ply\nformat ascii 1.0\ncomment before\nelement vertex 3\nproperty float32 x\nproperty "
            "float32 y\nproperty float32 z\n"
            "comment colours\nproperty uint8 red\nproperty uint8 green\nproperty uint8 "
            "blue\nproperty int label\n"
            "element face 1\nproperty list uint8 uint8 vertex_index\nelement camera 1\nproperty "
            "float focal\n"
            "element edge 1\nproperty int vertex1\nproperty int vertex2\ncomment last\nend_header\n"
            "0 0 0 1 2 3 4\n1 0 0 1 2 3 5\n0 1 0 1 2 3 6\n3 1 0 2\n0.5\n0 1\n");
}

TEST(WritePly, AddsAttributesBesideKeptWords) {
  Model model = read_text(kLabelled);
  auto& attributes = model.meshes.at(0).wedge_attributes;
  attributes.push_back(
      {"NORMAL", ComponentType::f32, 3, false, bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1})});
  attributes.push_back({"red", ComponentType::f32, 1, false, bytes_of<float>({7, 8, 9})});
  EXPECT_NE(text_of(model).find("property float32 z\ncomment colours\nproperty uint8 red\n"),
            std::string::npos);
  expect_recovered(model);
}

TEST(WritePly, ATakenNameEndsAKeptList) {
  Model model = read_text(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 5\n");
  Attribute texcoord{"TEXCOORD_0", ComponentType::u8, 2, true, Bytes(6)};
  model.meshes.at(0).wedge_attributes.push_back(texcoord);
  EXPECT_EQ(text_of(model).find("texcoord"), std::string::npos);
  expect_recovered(model);
}

TEST(WritePly, ManyPropertiesTakeNoLonger) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
      "z\n";
  for (int i = 0; i < 10000; ++i)
    text += "comment " + std::to_string(i) + "\nproperty int p" + std::to_string(i % 5000) + '\n';
  Model model = read_text(text + "end_header\n");
  ASSERT_EQ(model.meshes.at(0).wedge_attributes.size(), 10000u);
  EXPECT_EQ(test::round_trip_failure(model), "");
  auto& attributes = model.meshes[0].wedge_attributes;
  attributes.erase(attributes.begin(), attributes.begin() + 8000);
  EXPECT_EQ(test::round_trip_failure(read_text(text_of(model))), "");
}

TEST(WritePly, WidensIndicesAndCountsThatNoLongerFit) {
  Model model = read_text(kLabelled);
  Mesh mesh = test::triangle_mesh(std::vector<float>(3 * 400), {});
  for (Index i = 0; i < 300; ++i) mesh.corners.push_back(399 - i);
  mesh.face_first = {0, 300};
  model.meshes.at(0) = mesh;
  EXPECT_NE(text_of(model).find("property list uint int vertex_index\n"), std::string::npos);
  expect_recovered(model);
}

TEST(WritePly, WidensPositionsThatNoLongerFit) {
  Model model = read_text(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar x\nproperty short y\nproperty float "
      "z\nend_header\n1 2 3\n");
  const std::vector<double> moved{1.5, 2, 0.1};
  model.meshes.at(0).position.data = bytes_of(moved);
  EXPECT_EQ(text_of(model),
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty short "
            "y\nproperty double z\nend_header\n1.5 2 0.1\n");
}

TEST(WritePly, NamesTexturesAndTheirFaces) {
  Model model = model_of(test::grid(2));
  Mesh& mesh = model.meshes[0];
  model.scene.images = {
      {"", "a.png", "", {}}, {"", "", "image/png", Bytes(3)}, {"", "b.png", "", {}}};
  model.scene.materials.resize(3);
  model.scene.materials[0].set_map({.image = 2});
  model.scene.materials[2].set_map({.image = 1});
  mesh.groups = {{"first", 0, FaceKind::polygons}, {"second", 2, FaceKind::polygons}};
  mesh.face_group = {0, 1};
  const Model again = read_text(text_of(model));
  ASSERT_EQ(again.scene.images.size(), 2u);
  EXPECT_EQ(again.scene.images[1].uri, "b.png");
  EXPECT_EQ(test::describe(again.meshes[0].face_attributes.at(0)), "texnumber i32x1 1 -1");
  EXPECT_EQ(again.meshes[0].groups[again.meshes[0].group_of(0)].material, 1u);
  EXPECT_EQ(again.meshes[0].groups[again.meshes[0].group_of(1)].material, kNone);
  EXPECT_EQ(test::round_trip_failure(again), "");
}

TEST(WritePly, ScalesNormalizedPositions) {
  Mesh mesh = test::triangle_mesh({}, {});
  mesh.position = {"POSITION", ComponentType::i16, 3, true,
                   bytes_of<std::int16_t>({32767, 0, -32767})};
  EXPECT_EQ(text_of(model_of(mesh)),
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double "
            "y\nproperty double z\nend_header\n1 0 -1\n");
}

TEST(WritePly, NoModelMakesNoElements) {
  EXPECT_EQ(text_of({}), "ply\nformat ascii 1.0\nend_header\n");
}

TEST(WritePly, RefusesWhatPlyCannotSay) {
  const Model good = model_of(test::grid(2));
  struct Refusal {
    const char* name;
    void (*spoil)(Model&);
    ErrorCode code;
  };
  const Refusal kRefusals[] = {
      {"two_meshes", [](Model& m) { m.meshes.push_back(m.meshes[0]); }, ErrorCode::bad_argument},
      {"corner_past_end", [](Model& m) { m.meshes[0].corners[0] = 99; }, ErrorCode::bad_argument},
      {"plane_positions",
       [](Model& m) {
         m.meshes[0].position = {"POSITION", ComponentType::f32, 2, false, Bytes(32)};
       },
       ErrorCode::unsupported},
      {"position_twice", [](Model& m) { m.meshes[0].wedge_attributes = {m.meshes[0].position}; },
       ErrorCode::bad_argument},
      {"attribute_twice",
       [](Model& m) {
         m.meshes[0].face_attributes = {2, {"a", ComponentType::u8, 1, false, Bytes(2)}};
       },
       ErrorCode::bad_argument},
      {"header_cut",
       [](Model& m) {
         m.scene.foreign = {{"ply/header", Bytes(3)}};
       },
       ErrorCode::corrupt},
      {"columns_cut",
       [](Model& m) {
         m.scene.foreign = read_text(kLabelled).scene.foreign;
         m.scene.foreign.at(1).data.pop_back();
       },
       ErrorCode::corrupt},
      {"column_of_no_property",
       [](Model& m) {
         m.scene.foreign = read_text(kLabelled).scene.foreign;
         m.scene.foreign.at(1).data[8] = std::byte{200};
       },
       ErrorCode::corrupt},
  };
  for (const Refusal& refusal : kRefusals) {
    SCOPED_TRACE(refusal.name);
    Model model = good;
    refusal.spoil(model);
    const auto file = write_ply(model);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, refusal.code) << file.error().message;
  }
}

/// A mesh of everything: faces of any size, wedges used or not, attributes of any type and name.
Mesh random_mesh(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<Index>(random() % n); };
  const auto fill = [&](Attribute& a, std::size_t elements, bool few_values) {
    a.data.resize(elements * a.element_bytes());
    for (std::byte& b : a.data) b = static_cast<std::byte>(few_values ? below(2) : below(256));
  };
  const auto type = [&] { return static_cast<ComponentType>(below(8)); };
  const auto attributes = [&](std::size_t elements) {
    const char* const names[] = {"NORMAL",  "COLOR_0", "COLOR_1",     "TEXCOORD_0", "TEXCOORD_1",
                                 "TANGENT", "quality", "red",         "x",          "a b",
                                 "n[0]",    "%",       "wedge_vertex"};
    std::vector<Attribute> out;
    for (const char* name : names) {
      if (below(4) != 0) continue;
      Attribute& a = out.emplace_back();
      a = {name, type(), static_cast<std::uint8_t>(1 + below(4)), false, {}};
      a.normalized = a.type < ComponentType::f32 && below(2) != 0;
      if (std::string_view(name) == "TEXCOORD_0" && below(2) != 0)
        a = {name, ComponentType::f32, 2, false, {}};
      fill(a, elements, below(2) != 0);
    }
    return out;
  };
  Mesh mesh;
  mesh.position.type = type();
  const Index vertices = below(8);
  fill(mesh.position, vertices, false);
  const bool many_wedges = below(3) != 0;
  for (Index v = 0; v < vertices; ++v)
    for (Index n = many_wedges ? 1 + below(3) : 1; n > 0; --n) mesh.wedge_vertex.push_back(v);
  std::ranges::shuffle(mesh.wedge_vertex, random);
  mesh.wedge_attributes = attributes(mesh.wedge_vertex.size());
  mesh.face_first = {0};
  for (Index f = vertices == 0 ? 0 : below(12); f > 0; --f) {
    for (Index k = below(3) != 0 ? 3 : below(6); k > 0; --k)
      mesh.corners.push_back(below(mesh.wedge_count()));
    mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
  }
  mesh.face_attributes = attributes(mesh.face_first.size() - 1);
  canonicalize(mesh);
  return mesh;
}

RC_GTEST_PROP(WritePlyProperty, RecoversAnyMesh, (std::uint32_t seed)) {
  const Mesh mesh = random_mesh(seed);
  RC_ASSERT(find_inconsistency(mesh).empty());
  Model model;
  model.meshes.push_back(mesh);
  for (const Format format : test::kFormats) {
    const auto file = write_ply(model, {format});
    RC_ASSERT(file.has_value());
    const auto again = read_ply(*file);
    RC_ASSERT(again.has_value());
    Content wanted = content(mesh);
    // Without faces nothing says what their attributes were.
    if (mesh.face_count() == 0) wanted.face_attributes.clear();
    RC_ASSERT(content(again->meshes.at(0)) == wanted);
    RC_ASSERT(test::round_trip_failure(*again).empty());
  }
}

RC_GTEST_PROP(WritePlyProperty, RecoversSoups, (std::uint32_t seed)) {
  const Mesh mesh = test::random_soup(seed, 1 + seed % 30, seed % 50);
  Model model;
  model.meshes.push_back(mesh);
  const auto file = write_ply(model);
  RC_ASSERT(file.has_value());
  const auto again = read_ply(*file);
  RC_ASSERT(again.has_value());
  RC_ASSERT(content(again->meshes.at(0)) == content(mesh));
}

}  // namespace
}  // namespace pstrips
