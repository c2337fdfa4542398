// The worked example of spec/example.md: the page, the golden files and the code say the same.

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/digest.h"
#include "formats/pstrip/xml/xml.h"
#include "tests/support/paths.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

/// A square pyramid without its bottom: the apex is collapsed into the first corner of the square.
ProgressiveStrips pyramid() {
  ProgressiveMesh mesh;
  mesh.name = "roof";
  mesh.encoding = MapEncoding::offset;
  mesh.groups.resize(1);
  mesh.position = {"POSITION", ComponentType::f32, 3, false, {}};
  const float corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0.25f}};
  const ByteView bytes = std::as_bytes(std::span(corners));
  mesh.position.data.assign(bytes.begin(), bytes.end());
  mesh.base_vertices = mesh.base_wedges = 4;
  mesh.base_map = {0, 1, kSameAsMinus2, 2, 3, kRestart, 3, 0, kSameAsMinus1};
  mesh.group_entries = {9};
  mesh.vsplits = {{.parent = 0, .wedges = 1, .reassigned = 0, .map_offsets = 2}};
  mesh.wedge_offset_counts = {2};
  mesh.map_offsets = {2, 8};
  mesh.vertices = mesh.wedges = 5;
  mesh.triangles = 4;
  mesh.strips = 2;
  const Digest d = digest(test::decode_slowly(mesh, 1));
  mesh.digest.assign(d.begin(), d.end());

  ProgressiveStrips strips;
  strips.meshes.push_back(std::move(mesh));
  strips.bases = {
      {.vertices = 4, .triangles = 2, .strips = 1, .error = 0.25f, .one_sided_error = 0.25f}};
  strips.packets = {{.vsplits = 1, .vertices = 5, .triangles = 4, .strips = 2}};
  return strips;
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path page() { return test::data_dir() / "../../spec/example.md"; }

TEST(Example, LevelsAreThoseOfThePage) {
  ProgressiveStrips strips = pyramid();
  ASSERT_TRUE(check(strips));
  test::recount_levels(strips);
  EXPECT_EQ(strips, pyramid());
  EXPECT_EQ(test::decode_slowly(strips.meshes[0], 0).corners,
            (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(test::decode_slowly(strips.meshes[0], 1).corners,
            (std::vector<Index>{0, 1, 4, 4, 1, 2, 4, 2, 3, 3, 0, 4}));
}

TEST(Example, FilesAreTheGoldenOnes) {
  EXPECT_EQ(as_text(write_binary(pyramid()).value()),
            read_text(test::data_dir() / "golden/example.pstrip"));
  EXPECT_EQ(as_text(write_xml(pyramid())), read_text(test::data_dir() / "golden/example.pstripx"));
  EXPECT_EQ(read_binary(as_bytes(read_text(test::data_dir() / "golden/example.pstrip"))).value(),
            pyramid());
}

// Rows of the page's tables are "| offset | bytes | meaning |", offset and bytes in hexadecimal.
TEST(Example, PageDecodesEveryByteOfTheFile) {
  const Bytes file = write_binary(pyramid()).value();
  std::istringstream lines(read_text(page()));
  std::size_t at = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string bar, offset, byte;
    cells >> bar >> offset;
    const bool is_row = bar == "|" && offset.size() == 3 &&
                        offset.find_first_not_of("0123456789ABCDEF") == std::string::npos;
    if (!is_row) continue;
    ASSERT_EQ(std::stoul(offset, nullptr, 16), at) << line;
    for (cells >> bar; cells >> byte && byte != "|"; ++at) {
      ASSERT_LT(at, file.size());
      ASSERT_EQ(std::stoul(byte, nullptr, 16), std::to_integer<unsigned long>(file[at])) << line;
    }
  }
  EXPECT_EQ(at, file.size());
}

TEST(Example, PageShowsTheXml) {
  EXPECT_NE(read_text(page()).find("```xml\n" + std::string(as_text(write_xml(pyramid()))) + "```"),
            std::string::npos);
}

}  // namespace
}  // namespace pstrips
