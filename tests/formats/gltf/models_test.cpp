// Every glTF file among the models reads and comes back the same, or says clearly why not.

#include "tests/support/models.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "formats/gltf/gltf.h"
#include "tests/formats/gltf/files.h"
#include "tests/support/paths.h"

namespace pstrips {
namespace {

/// Vertices and faces by path, of the rows that have them. Shipped models have no manifest.
std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> read_manifest() {
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> out;
  std::ifstream file(test::models_dir().value_or("") / "MANIFEST.tsv");
  for (std::string line; std::getline(file, line);) {
    std::istringstream row(line);
    std::string path, vertices, faces;
    std::getline(row, path, '\t');
    std::getline(row, vertices, '\t');
    std::getline(row, faces, '\t');
    if (vertices.find_first_not_of("0123456789") == std::string::npos && !vertices.empty())
      out[path] = {std::stoull(vertices), std::stoull(faces)};
  }
  return out;
}

std::uint64_t count_polygons(const Model& model) {
  std::uint64_t out = 0;
  for (const Mesh& mesh : model.meshes)
    for (Index f = 0; f < mesh.face_count(); ++f)
      out += mesh.groups[mesh.group_of(f)].kind == FaceKind::polygons;
  return out;
}

std::uint64_t count_wedges(const Model& model) {
  std::uint64_t out = 0;
  for (const Mesh& mesh : model.meshes) out += mesh.wedge_count();
  return out;
}

/// What a broken file has that glTF forbids is mended or left out, and said.
void expect_round_trip(const Model& model, const GltfWriteOptions& options, bool is_broken) {
  const auto written = write_gltf(model, options);
  ASSERT_TRUE(written) << written.error().message;
  if (is_broken && !(written->dropped.empty() && written->converted.empty())) return;
  if (!written->dropped.empty()) {  // a text file has no chunks
    ASSERT_FALSE(options.binary);
    ASSERT_EQ(written->dropped, std::vector<std::string>{"unknown chunks of the .glb file"});
    return;
  }
  const auto again = read_gltf(written->main, test::among(written->others));
  ASSERT_TRUE(again) << again.error().message << ' ' << again.error().path;
  ASSERT_EQ(again->meshes.size(), model.meshes.size());
  for (std::size_t m = 0; m < model.meshes.size(); ++m)
    EXPECT_TRUE(again->meshes[m] == model.meshes[m]) << "mesh " << m;
  EXPECT_TRUE(again->scene == model.scene);
}

bool skip_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                int, void*) {
  return true;
}

/// Another reader finds as many polygons and vertices in what we wrote.
void expect_same_by_tinygltf(const Model& model) {
  const auto written = write_gltf(model);
  ASSERT_TRUE(written);
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(skip_image, nullptr);
  tinygltf::Model found;
  std::string error, warning;
  ASSERT_TRUE(reader.LoadBinaryFromMemory(
      &found, &error, &warning, reinterpret_cast<const unsigned char*>(written->main.data()),
      static_cast<unsigned>(written->main.size())))
      << error;
  std::uint64_t polygons = 0;
  std::map<int, std::uint64_t> vertices;  // by accessor: groups of one mesh share theirs
  for (const auto& mesh : found.meshes)
    for (const auto& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end()) continue;
      vertices[position->second] = found.accessors[std::size_t(position->second)].count;
      if (primitive.mode == TINYGLTF_MODE_TRIANGLES)
        polygons += found.accessors[std::size_t(primitive.indices)].count / 3;
    }
  std::uint64_t sum = 0;
  for (const auto& [accessor, count] : vertices) sum += count;
  EXPECT_EQ(polygons, count_polygons(model));
  EXPECT_EQ(sum, count_wedges(model));
}

TEST(GltfModels, ReadAndComeBackOrSayWhyNot) {
  const auto manifest = read_manifest();
  for (const auto& [name, path] : test::model_files({".gltf", ".glb"})) {
    SCOPED_TRACE(name);
    const auto model = read_gltf(test::load(path), test::beside(path));
    EXPECT_EQ(test::outcome_of(model), test::expected_outcome(name));
    if (!model) {
      EXPECT_FALSE(model.error().message.empty());
      continue;
    }
    for (const Mesh& mesh : model->meshes) ASSERT_EQ(find_inconsistency(mesh), "");
    const bool is_broken = name.starts_with("nasty/broken-gltf");
    expect_round_trip(*model, {.binary = true}, is_broken);
    expect_round_trip(*model, {.binary = false}, is_broken);
    if (!name.starts_with("nasty/")) expect_same_by_tinygltf(*model);
    if (const auto row = manifest.find(name);
        row != manifest.end() && !name.starts_with("nasty/")) {
      // The manifest counts an accessor once that several meshes share.
      EXPECT_EQ(count_polygons(*model), row->second.second);
      EXPECT_GE(count_wedges(*model), row->second.first);
    }
  }
}

}  // namespace
}  // namespace pstrips
