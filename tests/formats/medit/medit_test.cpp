#include "formats/medit/medit.h"

#include <gtest/gtest.h>

namespace pstrips {
namespace {

constexpr std::string_view kHead = "MeshVersionFormatted 1\nDimension 3\n";
constexpr std::string_view kVertices = "Vertices 5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n1 1 1 2\n";
constexpr std::string_view kTetrahedra = "Tetrahedra 2\n1 2 3 4 7\n5 4 3 2 -7\n";

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string out;
  for (const std::string_view part : parts) out += part;
  return out;
}

const TetraMesh kMesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, {0, 1, 2, 3, 4, 3, 2, 1}};

TEST(ReadMedit, TakesSectionsInAnyOrderAndPassesOverOthers) {
  constexpr std::string_view kTriangles = "Triangles\n1\n1 2 3 0\n", kOdd = "Nonesuch 1 nan 2 3\n";
  const std::string files[] = {
      joined({kHead, kVertices, kTetrahedra, "End\n"}),
      joined({kHead, kVertices, kTetrahedra}),
      joined({kHead, kTetrahedra, kVertices, "End"}),
      joined({kHead, kTriangles, kVertices, kOdd, kTetrahedra, "Edges 0\n End\nwhatever\n"}),
      joined({"# c\n", kHead, "# 1 2 3\n", kVertices, kTriangles, kTetrahedra, "Ridges\n0\nEnd"}),
      joined({"MeshVersionFormatted\n2\nDimension\n3\n", kVertices, kTetrahedra, "End"}),
  };
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    EXPECT_TRUE(looks_like_medit(as_bytes(file)));
    const auto mesh = read_medit(as_bytes(file));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(*mesh, kMesh);
  }
}

TEST(ReadMedit, TakesAMeshWithoutTetrahedra) {
  const auto mesh = read_medit(as_bytes(joined({kHead, kVertices, "Triangles 1 1 2 3 0 End"})));
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertex_count(), 5u);
  EXPECT_EQ(mesh->tetra_count(), 0u);
}

struct Bad {
  const char* name;
  std::string text;
  ErrorCode code;
  const char* line;
};

TEST(ReadMedit, SaysWhereItStops) {
  const Bad files[] = {
      {"nothing", "", ErrorCode::truncated, "line 1"},
      {"something else", "ply\nformat", ErrorCode::corrupt, "line 1"},
      {"a first word cut short", "MeshVers", ErrorCode::truncated, "line 1"},
      {"plane", "MeshVersionFormatted 1 Dimension 2", ErrorCode::unsupported, "line 1"},
      {"four dimensions", "MeshVersionFormatted 1\nDimension 4", ErrorCode::corrupt, "line 2"},
      {"dimension twice", joined({kHead, "Dimension 3"}), ErrorCode::corrupt, "line 3"},
      {"no dimension", joined({"MeshVersionFormatted 1\n", kVertices}), ErrorCode::corrupt,
       "line 2"},
      {"vertices twice", joined({kHead, kVertices, kVertices}), ErrorCode::corrupt, "line 9"},
      {"tetrahedra twice", joined({kHead, kTetrahedra, kTetrahedra}), ErrorCode::corrupt, "line 6"},
      {"a number too many", joined({kHead, "1"}), ErrorCode::corrupt, "line 3"},
      {"no number", joined({kHead, "Vertices 1\n0 0 o 1\n"}), ErrorCode::corrupt, "line 4"},
      {"vertex 0", joined({kHead, kVertices, "Tetrahedra 1\n0 1 2 3 0\n"}), ErrorCode::corrupt,
       "line 10"},
      {"vertex 6 of 5", joined({kHead, kVertices, "Tetrahedra 1\n1 2 3 6 0\nEnd"}),
       ErrorCode::corrupt, "line 10"},
      {"no vertices", joined({kHead, kTetrahedra}), ErrorCode::corrupt, "line 5"},
      {"a negative index", joined({kHead, kVertices, "Tetrahedra 1\n1 2 3 -4 0\n"}),
       ErrorCode::corrupt, "line 10"},
      {"more than the file holds", joined({kHead, "Vertices 4000000\n0 0 0 1\n"}),
       ErrorCode::truncated, "line 3"},
      {"more than the limit", joined({kHead, "Vertices 4000000000\n0 0 0 1\n"}),
       ErrorCode::over_limit, "line 3"},
  };
  for (const Bad& file : files) {
    SCOPED_TRACE(file.name);
    const auto mesh = read_medit(as_bytes(file.text));
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, file.code) << mesh.error().message;
    EXPECT_EQ(mesh.error().path, file.line) << mesh.error().message;
  }
  const auto binary = read_medit(as_bytes(std::string_view("\1\0\0\0\2\0\0\0", 8)));
  ASSERT_FALSE(binary);
  EXPECT_EQ(binary.error().code, ErrorCode::unsupported);
}

// Exact copies, so that a reader past the end is noticed.
TEST(ReadMedit, RejectsEveryPrefixThatLacksTetrahedra) {
  const std::string file = joined({kHead, kVertices, kTetrahedra, "End\n"});
  const std::size_t whole = file.find(" -7") + 3;
  for (std::size_t size = 0; size <= file.size(); ++size) {
    const std::vector<char> prefix(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    const auto mesh = read_medit(as_bytes(std::string_view(prefix.data(), size)));
    if (size >= whole) {
      EXPECT_TRUE(mesh && *mesh == kMesh) << size;
    } else if (mesh) {  // between two sections, or within the last, meaningless number
      EXPECT_TRUE(mesh->tetra_count() == 0 || size + 1 == whole) << size;
    }
  }
}

TEST(WriteTetraStrips, IsAStripALine) {
  const TetraStrips strips{{0, 1, 2, 3, 4, 5, 8, 7, 6, 9}, {0, 0, 0, 0, 1, 3, 0, 0, 0, 0}};
  EXPECT_EQ(as_text(write_tetra_strips(strips)), "TetraStrips 1\n1 2 3 4 1:5 3:6\n9 8 7 10\n");
  EXPECT_EQ(as_text(write_tetra_strips({})), "TetraStrips 1\n");
}

}  // namespace
}  // namespace pstrips
