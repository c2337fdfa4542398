#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/formats/obj/models.h"
#include "tests/formats/obj/support.h"
#include "tests/support/paths.h"

namespace pstrips::test {
namespace {

namespace fs = std::filesystem;

ReadFile beside(const fs::path& model) {
  return [dir = model.parent_path()](const std::string& name) -> Result<Bytes> {
    if (!fs::is_regular_file(dir / name)) return fail(ErrorCode::io, "no such file");
    const std::string text = load(dir / name);
    const ByteView bytes = as_bytes(text);
    return Bytes(bytes.begin(), bytes.end());
  };
}

/// Files that break the format: faces name lines that are not there.
struct Broken {
  std::string_view path, line, message;
};
constexpr Broken kBroken[] = {
    {"nasty/broken-misc/assimp/malformed.obj", "line 28", "index 0"},
    {"nasty/broken-obj/tinyobj/invalid-relative-texture-index.obj", "line 2", "index out of range"},
    {"nasty/broken-obj/tinyobj/issue-140-zero-face-idx.obj", "line 16", "index 0"},
    {"shipped/broken/index.obj", "line 7", "index out of range"},
    {"textured/obj2gltf/box-incomplete-attributes/box-incomplete-positions.obj", "line 29",
     "index out of range"},
};

/// What MANIFEST.tsv counted otherwise.
struct Exception {
  std::string_view path;
  std::size_t vertices, triangles;
  std::string_view why;
};
constexpr Exception kExceptions[] = {
    {"nasty/broken-obj/tinyobj/test-nan.obj", 76, 36, "not counted for its 1.#IND"},
};

/// Of real models; shipped ones have no manifest.
std::map<std::string, std::pair<std::string, std::string>> manifest() {
  std::map<std::string, std::pair<std::string, std::string>> out;
  std::ifstream in(models_dir().value_or("") / "MANIFEST.tsv");
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    std::string path, vertices, faces;
    std::getline(row, path, '\t');
    std::getline(row, vertices, '\t');
    std::getline(row, faces, '\t');
    out[path] = {vertices, faces};
  }
  return out;
}

std::size_t triangles_of(const Mesh& mesh) {
  std::size_t count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (mesh.groups[mesh.group_of(f)].kind == FaceKind::polygons && mesh.face(f).size() > 2)
      count += mesh.face(f).size() - 2;
  return count;
}

TEST(ObjModels, ReadAndSurviveTheRoundTripOrSayWhatIsWrong) {
  const auto counts = manifest();
  std::size_t read_count = 0;
  for (const auto& [name, path] : model_files({".obj"})) {
    SCOPED_TRACE(name);
    const std::string text = load(path);
    const auto model = read_obj(as_bytes(text), beside(path));
    const auto* broken = std::ranges::find(kBroken, name, &Broken::path);
    if (broken != std::end(kBroken)) {
      ASSERT_FALSE(model);
      EXPECT_EQ(model.error().path, broken->line);
      EXPECT_EQ(model.error().message, broken->message);
      continue;
    }
    if (!model) {
      ADD_FAILURE() << model.error().message << ", " << model.error().path;
      continue;
    }
    ++read_count;
    EXPECT_EQ(check_round_trip(*model), "");
    const auto row = counts.find(name);
    if (row == counts.end()) continue;
    const Mesh& mesh = model->meshes.at(0);
    const auto* exception = std::ranges::find(kExceptions, name, &Exception::path);
    if (exception != std::end(kExceptions)) {
      EXPECT_EQ(mesh.vertex_count(), exception->vertices) << exception->why;
      EXPECT_EQ(triangles_of(mesh), exception->triangles) << exception->why;
    } else {
      EXPECT_EQ(std::to_string(mesh.vertex_count()), row->second.first);
      EXPECT_EQ(std::to_string(triangles_of(mesh)), row->second.second);
    }
  }
  EXPECT_GT(read_count, 0u);
}

}  // namespace
}  // namespace pstrips::test
