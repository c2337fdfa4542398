#include "converters/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "converters/encode.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

namespace fs = std::filesystem;

class Save : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "pstrips-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    model_.meshes.push_back(test::cube(false));
    model_.scene.materials.push_back({.name = "red"});
    for (Group& group : model_.meshes[0].groups) group.material = 0;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::string text_of(const char* name) const {
    return std::string(as_text(read_file(path(name))->view()));
  }
  fs::path folder_;
  Model model_;
};

TEST_F(Save, SaysWhichFilesItWroteAndBeforehandWhichItMay) {
  const auto strips = encode(model_, {});
  ASSERT_TRUE(strips);
  std::size_t written = 0;
  for (const FileFormatRow& row : file_formats()) {
    if (!row.is_writable()) continue;
    SCOPED_TRACE(row.name);
    const std::string target = path("a b.") + std::string(row.name);
    const auto saved =
        row.write_model ? save(model_, target, row.format) : save(*strips, target, row.format);
    ASSERT_TRUE(saved) << saved.error().message;
    std::vector<std::string> paths;
    std::uint64_t bytes = 0;
    for (const SavedFile& file : saved->files) {
      paths.push_back(file.path);
      EXPECT_EQ(fs::file_size(file.path), file.bytes);
      bytes += file.bytes;
    }
    EXPECT_EQ(paths, output_paths(target, row.format));
    EXPECT_EQ(saved->bytes(), bytes);
    written += paths.size();
    EXPECT_EQ(output_paths("-", row.format), std::vector<std::string>{"-"});
  }
  EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})), written);
}

TEST_F(Save, KeepsCompanionsOfOthers) {
  for (const auto& [output, companion] : {std::pair{"a.obj", "a.mtl"}, {"a.gltf", "a.bin"}}) {
    SCOPED_TRACE(output);
    const FileFormat format = *format_of_path(output);
    ASSERT_TRUE(write_files({{path(companion), as_bytes("precious")}}));
    const auto refused = save(model_, path(output), format, {.replace_companions = false});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::io);
    EXPECT_EQ(refused.error().path, path(companion));
    EXPECT_EQ(text_of(companion), "precious");
    EXPECT_FALSE(fs::exists(path(output)));
    EXPECT_TRUE(save(model_, path(output), format));
    EXPECT_NE(text_of(companion), "precious");
    // The same bytes again replace nothing.
    EXPECT_TRUE(save(model_, path(output), format, {.replace_companions = false}));
  }
}

// A model that has a feature, and how to see whether a model has it still.
struct Probe {
  Feature feature;
  Model (*make)();
  bool (*is_there)(const Model& model);
};

Model with_kind(FaceKind kind, std::vector<Index> first) {
  Mesh mesh = test::grid(3);
  mesh.corners.resize(first.back());
  mesh.face_first = std::move(first);
  mesh.groups[0].kind = kind;
  return test::model_of(std::move(mesh));
}

bool has_kind(const Model& model, FaceKind kind) {
  return std::ranges::any_of(model.meshes, [&](const Mesh& mesh) {
    return std::ranges::any_of(mesh.groups, [&](const Group& g) { return g.kind == kind; });
  });
}

Model with_attribute(bool on_faces) {
  Mesh mesh = test::cube(false);
  Attribute heat{"_HEAT", ComponentType::f32, 1, false, {}};
  heat.data.resize(heat.element_bytes() * (on_faces ? mesh.face_count() : mesh.wedge_count()),
                   std::byte{0x3f});
  (on_faces ? mesh.face_attributes : mesh.wedge_attributes).push_back(std::move(heat));
  return test::model_of(std::move(mesh));
}

bool has_heat(const std::vector<Attribute>& attributes) {
  return std::ranges::find(attributes, "_HEAT", &Attribute::semantic) != attributes.end();
}

Model with_double_positions() {
  Mesh mesh = test::cube(false);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < 3 * std::size_t{mesh.vertex_count()}; ++i)
    numbers.push_back(component(mesh.position, i / 3, i % 3) + 1.0 / 3);
  const auto bytes = std::as_bytes(std::span(numbers));
  mesh.position.type = ComponentType::f64;
  mesh.position.data.assign(bytes.begin(), bytes.end());
  return test::model_of(std::move(mesh));
}

Model with_material(Material material) {
  Model model = test::model_of(test::cube(true));
  for (Group& group : model.meshes[0].groups) group.material = 0;
  model.scene.materials.push_back(std::move(material));
  return model;
}

const Probe kProbes[] = {
    {Feature::faces, [] { return test::model_of(test::cube(false)); },
     [](const Model& m) { return m.meshes[0].face_count() == 12; }},
    {Feature::polygons, [] { return test::model_of(test::joined_to_quads(test::cube(false))); },
     [](const Model& m) { return m.meshes[0].face(0).size() == 4; }},
    {Feature::lines,
     [] {
       return with_kind(FaceKind::lines, {0, 2, 4});
     },
     [](const Model& m) { return has_kind(m, FaceKind::lines); }},
    {Feature::points,
     [] {
       return with_kind(FaceKind::points, {0, 1, 2});
     },
     [](const Model& m) { return has_kind(m, FaceKind::points); }},
    {Feature::double_positions, with_double_positions,
     [](const Model& m) { return m.meshes[0].position.type == ComponentType::f64; }},
    {Feature::wedges, [] { return test::model_of(test::cube(true)); },
     [](const Model& m) { return m.meshes[0].wedge_count() > m.meshes[0].vertex_count(); }},
    {Feature::attributes, [] { return with_attribute(false); },
     [](const Model& m) { return has_heat(m.meshes[0].wedge_attributes); }},
    {Feature::face_attributes, [] { return with_attribute(true); },
     [](const Model& m) { return has_heat(m.meshes[0].face_attributes); }},
    {Feature::nodes,
     [] {
       Model model = test::model_of(test::cube(false));
       model.scene.nodes.push_back({.name = "moved", .meshes = {0}});
       model.scene.nodes[0].matrix[12] = 5;
       return model;
     },
     [](const Model& m) { return !m.scene.nodes.empty() && m.scene.nodes[0].matrix[12] == 5; }},
    {Feature::materials,
     [] {
       return with_material({.name = "red", .base_color = {1, 0, 0, 1}});
     },
     [](const Model& m) {
       return !m.scene.materials.empty() && m.scene.materials[0].base_color[1] == 0;
     }},
    {Feature::embedded_images,
     [] {
       Model model = with_material({.name = "textured", .maps = {{.image = 0}}});
       model.scene.images.push_back(
           {.name = "", .uri = "", .mime_type = "image/png", .data = Bytes(3)});
       return model;
     },
     [](const Model& m) { return !m.scene.images.empty() && m.scene.images[0].data.size() == 3; }},
};

TEST_F(Save, KeepsWhatItsFormatHolds) {
  for (const FileFormatRow& row : file_formats()) {
    if (!row.is_writable()) continue;
    for (const Probe& probe : kProbes) {
      SCOPED_TRACE(std::string(row.name) + ", feature " +
                   std::to_string(static_cast<int>(probe.feature)));
      const Model model = probe.make();
      ASSERT_TRUE(probe.is_there(model));
      const std::string target = path("a.") + std::string(row.name);
      Result<SavedFiles> saved;
      if (row.write_model) {
        saved = save(model, target, row.format);
      } else {
        const auto strips = encode(model, {.keep_order = true});
        ASSERT_TRUE(strips) << strips.error().message;
        saved = save(*strips, target, row.format);
      }
      auto back = saved ? load(target) : Result<LoadedFile>(tl::unexpected(saved.error()));
      const Result<Model> again =
          back ? std::move(*back).model() : Result<Model>(tl::unexpected(back.error()));
      EXPECT_EQ(again && !again->meshes.empty() && probe.is_there(*again),
                row.holds.has(probe.feature));
    }
  }
}

}  // namespace
}  // namespace pstrips
