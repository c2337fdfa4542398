// Walks the models: each is read and comes back exactly in all formats, or is refused for a
// reason that the table below knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "formats/ply/ply.h"
#include "tests/formats/ply/ply_text.h"
#include "tests/support/paths.h"

namespace pstrips {
namespace {

struct Refused {
  const char* path;
  ErrorCode code;
};

// What the collection's counting script reads and we do not, and what neither reads.
const Refused kRefused[] = {
    {"nasty/broken-misc/assimp/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply",
     ErrorCode::truncated},
    {"nasty/broken-misc/assimp/empty.ply", ErrorCode::truncated},
    {"nasty/broken-ply/magnum/extra-token-face-element.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/extra-token-face-property-list.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/extra-token-format.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/extra-token-vertex-element.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/format-missing.ply", ErrorCode::truncated},
    {"nasty/broken-ply/magnum/format-too-late.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/incomplete-face-specification.ply", ErrorCode::unsupported},
    {"nasty/broken-ply/magnum/integer-literal-at-file-end.ply", ErrorCode::truncated},
    {"nasty/broken-ply/magnum/integer-literal-too-large.ply", ErrorCode::truncated},
    {"nasty/broken-ply/magnum/invalid-face-property.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/invalid-face-size-type.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/invalid-signature.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/invalid-vertex-property.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/positions-not-all.ply", ErrorCode::unsupported},
    {"nasty/broken-ply/magnum/unexpected-property.ply", ErrorCode::corrupt},
    {"nasty/broken-ply/magnum/unknown-element.ply", ErrorCode::truncated},
    {"nasty/broken-ply/magnum/unsupported-face-size.ply", ErrorCode::truncated},
    {"nasty/fuze_ascii/fuze_ascii.ply", ErrorCode::corrupt},  // face rows have undeclared values
    {"nasty/issue623.ply", ErrorCode::corrupt},               // vertex rows lack a declared list
    {"shipped/broken/cut.ply", ErrorCode::truncated},
    {"ply-variety/pdal/sized_dims.ply", ErrorCode::unsupported},  // no z
    {"ply-variety/points_emptyascii.ply", ErrorCode::corrupt},    // more rows than declared
};

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Counts {
  std::string vertices, triangles;
};

// Of real models; shipped ones have no manifest.
std::map<std::string, Counts> manifest() {
  std::map<std::string, Counts> out;
  std::ifstream in(test::models_dir().value_or("") / "MANIFEST.tsv");
  for (std::string line; std::getline(in, line);) {
    std::istringstream columns(line);
    std::string path;
    Counts counts;
    std::getline(columns, path, '\t');
    std::getline(columns, counts.vertices, '\t');
    std::getline(columns, counts.triangles, '\t');
    out[path] = counts;
  }
  return out;
}

std::size_t triangles_of(const Model& model) {
  std::size_t count = 0;
  for (const Mesh& mesh : model.meshes)
    for (Index f = 0; f < mesh.face_count(); ++f)
      count += std::max<std::size_t>(mesh.face(f).size(), 2) - 2;
  return count;
}

TEST(PlyModels, ComeBackExactlyOrAreRefusedForAKnownReason) {
  const auto counts = manifest();
  std::size_t read = 0, refused = 0;
  for (const auto& [name, path] : test::model_files({".ply"})) {
    SCOPED_TRACE(name);
    const std::string file = read_file(path);
    const auto model = read_ply(as_bytes(file));
    const auto* const known = std::ranges::find(kRefused, name, &Refused::path);
    if (known != std::end(kRefused)) {
      ASSERT_FALSE(model);
      EXPECT_EQ(model.error().code, known->code) << model.error().message;
      EXPECT_LE(model.error().offset, file.size());
      ++refused;
      continue;
    }
    ASSERT_TRUE(model) << model.error().message << ' ' << model.error().path;
    ++read;
    const auto expected = counts.find(name);
    if (expected != counts.end() && expected->second.vertices != "-") {
      const std::size_t vertices = model->meshes.empty() ? 0 : model->meshes[0].vertex_count();
      EXPECT_EQ(std::to_string(vertices), expected->second.vertices);
      EXPECT_EQ(std::to_string(triangles_of(*model)), expected->second.triangles);
    }
    if (!model->meshes.empty()) {
      EXPECT_EQ(find_inconsistency(model->meshes[0]), "");
    }
    EXPECT_EQ(test::round_trip_failure(*model), "");
  }
  RecordProperty("read", static_cast<int>(read));
  RecordProperty("refused", static_cast<int>(refused));
  EXPECT_GT(read, 0u);
}

}  // namespace
}  // namespace pstrips
