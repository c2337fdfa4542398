#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "formats/ply/ply.h"
#include "tests/formats/ply/ply_text.h"

namespace pstrips {
namespace {

using test::describe;

struct GoodFile {
  const char* name;
  std::string text;     ///< after "ply\nformat ascii 1.0\n"
  std::string meaning;  ///< as describe() says it
};

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFace = "property list uchar int vertex_indices\n";

std::string ascii(const std::string& rest) { return "ply\nformat ascii 1.0\n" + rest; }

std::string vertices(int count, const std::string& more = "") {
  return "element vertex " + std::to_string(count) + "\n" + kXyz + more;
}
std::string faces(int count, const std::string& more = "") {
  return "element face " + std::to_string(count) + "\n" + kFace + more;
}
const std::string kTriangle = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kTriangleMeaning = "POSITION f32x3 0,0,0 1,0,0 0,1,0";

const GoodFile kGoodFiles[] = {
    {"no_vertices", vertices(0) + "end_header\n", "POSITION f32x3"},
    {"faces_without_properties", vertices(1) + "element face 0\nend_header\n1 2 3\n",
     "POSITION f32x3 1,2,3"},
    {"triangle", vertices(3) + faces(1) + "end_header\n" + kTriangle + "3 0 1 2\n",
     kTriangleMeaning + " | F 0,1,2"},
    {"no_final_newline", vertices(1) + "end_header\n1 2 3", "POSITION f32x3 1,2,3"},
    {"blank_lines_and_tabs", vertices(2) + "end_header\n\n 1\t2  3 \n\n4 5 6\n\n",
     "POSITION f32x3 1,2,3 4,5,6"},
    {"crlf_rows", vertices(2) + "end_header\n1 2 3\r\n4 5 6\r\n", "POSITION f32x3 1,2,3 4,5,6"},
    {"faces_before_vertices",
     faces(1) + "property uchar flags\n" + vertices(3) + "end_header\n3 0 1 2 7\n" + kTriangle,
     kTriangleMeaning + " | F 0,1,2 | flags u8x1 7"},
    {"any_order_of_xyz",
     "element vertex 1\nproperty int z\nproperty int a\nproperty int y\nproperty int "
     "x\nend_header\n3 9 2 1\n",
     "POSITION i32x3 1,2,3 | a i32x1 9"},
    {"position_types_differ",
     "element vertex 1\nproperty uchar x\nproperty short y\nproperty float z\nend_header\n255 -3 "
     "0.5\n",
     "POSITION f64x3 255,-3,0.5"},
    {"double_position",
     "element vertex 1\nproperty double x\nproperty double y\nproperty double z\nend_header\n1 2 "
     "1e300\n",
     "POSITION f64x3 1,2,1e+300"},
    {"every_type_by_both_names",
     vertices(
         1,
         "property char a\nproperty uchar b\nproperty short c\nproperty ushort d\nproperty int e\n"
         "property uint f\nproperty float g\nproperty double h\nproperty int8 i\nproperty uint8 j\n"
         "property int16 k\nproperty uint16 l\nproperty int32 m\nproperty uint32 n\nproperty "
         "float32 o\n"
         "property float64 p\n") +
         "end_header\n0 0 0 -128 255 -32768 65535 -2147483648 4294967295 0.25 0.125 127 1 32767 2 "
         "2147483647 3 4 5\n",
     "POSITION f32x3 0,0,0 | a i8x1 -128 | b u8x1 255 | c i16x1 -32768 | d u16x1 65535 | e i32x1 "
     "-2.14748e+09 | "
     "f u32x1 4.29497e+09 | g f32x1 0.25 | h f64x1 0.125 | i i8x1 127 | j u8x1 1 | k i16x1 32767 | "
     "l u16x1 2 | "
     "m i32x1 2.14748e+09 | n u32x1 3 | o f32x1 4 | p f64x1 5"},
    {"integers_written_as_reals",
     vertices(1, "property uchar a\nproperty int b\n") + "end_header\n0 0 0 255.0 1e2\n",
     "POSITION f32x3 0,0,0 | a u8x1 255 | b i32x1 100"},
    {"not_finite", vertices(2) + "end_header\n+inf -Infinity 1.#INF\n-1.#IND nan -nan(0x12)\n",
     "POSITION f32x3 inf,-inf,inf -nan,nan,-nan"},
    {"normals",
     vertices(1, "property float nx\nproperty float ny\nproperty float nz\n") +
         "end_header\n0 0 0 0 0 1\n",
     "POSITION f32x3 0,0,0 | NORMAL f32x3 0,0,1"},
    {"small_normals",
     vertices(1, "property char nx\nproperty char ny\nproperty char nz\n") +
         "end_header\n0 0 0 0 0 127\n",
     "POSITION f32x3 0,0,0 | NORMAL i8x3n 0,0,1"},
    {"normals_incomplete",
     vertices(1, "property float nx\nproperty float nz\n") + "end_header\n0 0 0 1 2\n",
     "POSITION f32x3 0,0,0 | nx f32x1 1 | nz f32x1 2"},
    {"colours",
     vertices(1, "property uchar red\nproperty uchar green\nproperty uchar blue\n") +
         "end_header\n0 0 0 255 0 51\n",
     "POSITION f32x3 0,0,0 | COLOR_0 u8x3n 1,0,0.2"},
    {"colours_alpha_first",
     vertices(
         1,
         "property float alpha\nproperty float blue\nproperty float green\nproperty float red\n") +
         "end_header\n0 0 0 4 3 2 1\n",
     "POSITION f32x3 0,0,0 | COLOR_0 f32x4 1,2,3,4"},
    {"colours_alpha_of_another_type",
     vertices(
         1,
         "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float alpha\n") +
         "end_header\n0 0 0 0 0 0 0.5\n",
     "POSITION f32x3 0,0,0 | COLOR_0 u8x3n 0,0,0 | alpha f32x1 0.5"},
    {"colours_twice",
     vertices(
         1,
         "property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\n"
         "property ushort r\nproperty ushort g\nproperty ushort b\nproperty ushort a\n") +
         "end_header\n0 0 0 0 0 255 0 0 0 65535\n",
     "POSITION f32x3 0,0,0 | COLOR_0 u8x3n 0,0,1 | COLOR_1 u16x4n 0,0,0,1"},
    {"texture_coordinates",
     vertices(1,
              "property float s\nproperty float t\nproperty double texture_u\nproperty double "
              "texture_v\n"
              "property float s1\nproperty float t1\n") +
         "end_header\n0 0 0 1 2 3 4 5 6\n",
     "POSITION f32x3 0,0,0 | TEXCOORD_0 f32x2 1,2 | TEXCOORD_1 f64x2 3,4 | TEXCOORD_2 f32x2 5,6"},
    {"indexed_names",
     vertices(1,
              "property ushort JOINTS_0[0]\nproperty ushort JOINTS_0[1]\nproperty uchar "
              "a%20b[0]n\nproperty int c[1]\n") +
         "end_header\n0 0 0 1 2 255 4\n",
     "POSITION f32x3 0,0,0 | JOINTS_0 u16x2 1,2 | a b u8x1n 1 | c[1] i32x1 4"},
    {"names_twice",
     vertices(1, "property int a\nproperty int a~2\nproperty int a\nproperty int x\n") +
         "end_header\n0 0 0 1 2 3 4\n",
     "POSITION f32x3 0,0,0 | a i32x1 1 | a~2 i32x1 2 | a~3 i32x1 3 | x i32x1 4"},
    {"faces_of_any_size",
     vertices(5) + faces(6) + "end_header\n" + kTriangle +
         "1 1 0\n2 2 0\n3 0 1 2\n0\n1 4\n2 0 1\n4 0 1 3 2\n5 0 1 2 3 4\n",
     "POSITION f32x3 0,0,0 1,0,0 0,1,0 1,1,0 2,2,0 | F 0,1,2 - 4 0,1 0,1,3,2 0,1,2,3,4"},
    {"vertex_index_of_other_types",
     vertices(3) + "element face 1\nproperty list int uchar vertex_index\nend_header\n" +
         kTriangle + "3 2 1 0\n",
     kTriangleMeaning + " | F 2,1,0"},
    {"face_attributes",
     vertices(3) +
         faces(1,
               "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int flags\n"
               "property float quality\nproperty float u\nproperty float v\n") +
         "end_header\n" + kTriangle + "3 0 1 2 255 0 0 -1 0.5 6 7\n",
     kTriangleMeaning + " | F 0,1,2 | COLOR_0 u8x3n 1,0,0 | flags i32x1 -1 | quality f32x1 0.5 | u "
                        "f32x1 6 | v f32x1 7"},
    {"wedges_from_texcoords",
     vertices(5) + faces(2, "property list uchar float texcoord\n") + "end_header\n" + kTriangle +
         "1 1 0\n9 9 9\n3 0 1 2 6 0 0 1 0 0 1\n3 2 1 3 6 0 1 0.5 0.5 1 1\n",
     "POSITION f32x3 0,0,0 1,0,0 0,1,0 1,1,0 9,9,9 | TEXCOORD_0 f32x2 0,0 1,0 0.5,0.5 0,1 1,1 0,0 "
     "| W 0 1 1 2 3 4 | "
     "F 0,1,3 3,2,4"},
    {"texcoords_without_seams",
     vertices(3, "property float s\nproperty float t\n") +
         faces(1, "property list uchar double texcoord\n") +
         "end_header\n0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n3 0 1 2 6 0 0 1 0 0 1\n",
     kTriangleMeaning + " | TEXCOORD_1 f32x2 1,2 3,4 5,6 | TEXCOORD_0 f64x2 0,0 1,0 0,1 | F 0,1,2"},
    {"texcoords_that_are_no_pairs",
     vertices(3) + faces(2, "property list uchar float texcoord\n") + "end_header\n" + kTriangle +
         "3 0 1 2 0\n3 0 1 2 6 0 0 1 0 0 1\n",
     kTriangleMeaning + " | F 0,1,2 0,1,2"},
    {"texnumber",
     "comment TextureFile  a b.png \nobj_info TextureFile c\ncomment TextureFile d.png\n" +
         vertices(3) + faces(3, "property uchar texnumber\n") + "end_header\n" + kTriangle +
         "3 0 1 2 1\n3 0 1 2 0\n3 0 1 2 9\n",
     kTriangleMeaning + " | F 0,1,2 0,1,2 0,1,2 | texnumber u8x1 1 0 9 | G 1 0 2"},
    {"tristrips",
     vertices(5) + "element tristrips 2\nproperty list int int vertex_indices\nend_header\n" +
         kTriangle + "1 1 0\n2 2 0\n9 0 1 2 3 -1 0 1 1 2\n4 4 3 2 1\n",
     "POSITION f32x3 0,0,0 1,0,0 0,1,0 1,1,0 2,2,0 | F 0,1,2 2,1,3 4,3,2 2,3,1"},
    {"tristrips_after_faces",
     vertices(5) + faces(1) +
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + kTriangle +
         "1 1 0\n2 2 0\n4 0 1 3 2\n3 0 1 4\n",
     "POSITION f32x3 0,0,0 1,0,0 0,1,0 1,1,0 2,2,0 | F 0,1,3,2 0,1,4"},
    {"other_elements_and_lists",
     "element camera 1\nproperty float focal\ncomment eye\nproperty list short double k\n" +
         vertices(2, "property list uchar int near\n") +
         "element edge 1\nproperty int vertex1\nproperty int vertex2\n" +
         "element none 3\nend_header\n0.5 2 1e-05 2\n1 2 3 2 7 8\n4 5 6 0\n0 1\n",
     "POSITION f32x3 1,2,3 4,5,6 | F 0,1 | G 1"},
    {"wedge_rows",
     vertices(3,
              "property int a\ncomment each row is a wedge, wedge_vertex is its vertex\nproperty "
              "uint wedge_vertex\n") +
         faces(1) + "end_header\n1 1 1 7 1\n0 0 0 8 0\n1 1 1 9 1\n3 0 1 2\n",
     "POSITION f32x3 0,0,0 1,1,1 | a i32x1 7 8 9 | W 1 0 1 | F 0,1,2"},
    {"wedge_vertex_of_a_stranger",
     vertices(1, "property uint wedge_vertex\n") + "end_header\n1 1 1 7\n",
     "POSITION f32x3 1,1,1 | wedge_vertex u32x1 7"},
    {"header_line_without_keyword", "made by hand\n" + vertices(1) + "end_header\n1 2 3\n",
     "POSITION f32x3 1,2,3"},
    {"blanks_in_header",
     "\n \t comment x \n  element \t vertex   1\t\n property\tfloat x\nproperty  float y "
     "\nproperty float z\n\n end_header \n1 2 3\n",
     "POSITION f32x3 1,2,3"},
};

TEST(ReadPly, GivesTheMeaningAndItComesBackInAllFormats) {
  for (const GoodFile& file : kGoodFiles) {
    SCOPED_TRACE(file.name);
    const auto model = read_ply(as_bytes(ascii(file.text)));
    ASSERT_TRUE(model) << model.error().message << ' ' << model.error().path;
    ASSERT_EQ(model->meshes.size(), 1u);
    EXPECT_EQ(describe(model->meshes[0]), file.meaning);
    EXPECT_EQ(find_inconsistency(model->meshes[0]), "");
    EXPECT_EQ(test::round_trip_failure(*model), "");
  }
}

TEST(ReadPly, WritesTidyFilesBackWordForWord) {
  const char* const names[] = {"triangle",
                               "faces_before_vertices",
                               "position_types_differ",
                               "colours_twice",
                               "wedges_from_texcoords",
                               "texcoords_that_are_no_pairs",
                               "other_elements_and_lists",
                               "texnumber",
                               "names_twice",
                               "wedge_rows",
                               "faces_of_any_size"};
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const auto* file = std::ranges::find(kGoodFiles, std::string_view(name), &GoodFile::name);
    ASSERT_NE(file, std::end(kGoodFiles));
    const std::string text = ascii(file->text);
    const auto again = write_ply(*read_ply(as_bytes(text)), {PlyWriteOptions::Format::ascii});
    ASSERT_TRUE(again);
    EXPECT_EQ(as_text(*again), text);
  }
}

TEST(ReadPly, NamesTexturesAndMaterials) {
  const auto model = read_ply(as_bytes(ascii(
      "comment TextureFile  a b.png \ncomment TextureFile\n" + vertices(0) + "end_header\n")));
  ASSERT_TRUE(model);
  ASSERT_EQ(model->scene.images.size(), 1u);
  EXPECT_EQ(model->scene.images[0].uri, "a b.png");
  EXPECT_EQ(model->scene.materials.at(0).image(MapRole::base_color), 0u);
  EXPECT_EQ(model->meshes[0].groups.at(0).material, 0u);
}

TEST(ReadPly, WithoutVerticesIsAModelWithoutMesh) {
  const auto model =
      read_ply(as_bytes(ascii("obj_info nothing\nelement face 0\nelement tristrips 0\nproperty "
                              "float x\nelement other 1\nproperty int a\nend_header\n5\n")));
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->meshes.empty());
  EXPECT_EQ(test::round_trip_failure(*model), "");
}

std::string be16(unsigned v) { return {static_cast<char>(v >> 8), static_cast<char>(v)}; }
std::string le16(unsigned v) { return {static_cast<char>(v), static_cast<char>(v >> 8)}; }

/// A binary file with header lines that end as told.
std::string binary(bool big, const std::string& line_end) {
  std::string text;
  for (const char* line :
       {"ply", big ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0",
        "element vertex 3", "property ushort x", "property ushort y", "property ushort z",
        "property uchar a", "element face 2", "property list ushort short vertex_indices",
        "property char f", "end_header"})
    text += line + line_end;
  const auto number = big ? be16 : le16;
  for (unsigned v = 0; v < 3; ++v)
    text += number(258 * v + 10) + number(v) + number(0) + char(65 + v);
  text += number(3) + number(0) + number(1) + number(2) + '\xff';
  return text + number(2) + number(2) + number(0) + '\x01';
}

TEST(ReadPly, ReadsBinaryWithEachLineEnd) {
  for (const bool big : {false, true})
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      // The first byte after a header that ends in CR is LF (10) in the little-endian file.
      const auto model = read_ply(as_bytes(binary(big, line_end)));
      ASSERT_TRUE(model) << model.error().message;
      EXPECT_EQ(
          describe(model->meshes.at(0)),
          "POSITION u16x3 10,0,0 268,1,0 526,2,0 | a u8x1 65 66 67 | F 0,1,2 2,0 | f i8x1 -1 1");
      EXPECT_EQ(test::round_trip_failure(*model), "");
    }
}

TEST(ReadPly, KeepsBytesAfterABinaryBody) {
  const std::string file = binary(false, "\n") + "more";
  const auto model = read_ply(as_bytes(file));
  ASSERT_TRUE(model);
  const auto again = write_ply(*model);
  ASSERT_TRUE(again);
  EXPECT_EQ(as_text(*again), file);
}

TEST(ReadPly, KeepsNanPayloadsInAllFormats) {
  const std::uint32_t bits[] = {0x7fc00000, 0xffc00000, 0x7f800001,
                                0xffffffff, 0x80000000, 0x00000001};
  std::string file = "ply\nformat binary_little_endian 1.0\n" + vertices(2) + "end_header\n";
  file.append(reinterpret_cast<const char*>(bits), sizeof bits);
  const auto model = read_ply(as_bytes(file));
  ASSERT_TRUE(model);
  ASSERT_EQ(std::memcmp(model->meshes.at(0).position.data.data(), bits, sizeof bits), 0);
  EXPECT_EQ(test::round_trip_failure(*model), "");
}

struct BadFile {
  const char* name;
  std::string bytes;
  ErrorCode code;
  std::uint64_t offset;
  const char* path;
};

std::string little(const std::string& header, const std::string& body) {
  return "ply\nformat binary_little_endian 1.0\n" + header + "end_header\n" + body;
}
std::uint64_t size_of_header(const std::string& file) { return file.find("end_header\n") + 11; }

/// A bad value `from_body` bytes after the header.
BadFile bad_body(const char* name, const std::string& file, ErrorCode code, std::uint64_t from_body,
                 const char* path) {
  return {name, file, code, size_of_header(file) + from_body, path};
}

const std::string kZeros(12, '\0');

const BadFile kBadFiles[] = {
    {"empty", "", ErrorCode::truncated, 0, "line 1"},
    {"another_format", "solid x\n", ErrorCode::corrupt, 0, "line 1"},
    {"signature_with_more", "plyx\n", ErrorCode::corrupt, 0, "line 1"},
    {"no_format", "ply\nend_header\n", ErrorCode::corrupt, 4, "line 2"},
    {"format_twice", ascii("format ascii 1.0\n"), ErrorCode::corrupt, 21, "line 3"},
    {"unknown_format", "ply\nformat text 1.0\n", ErrorCode::corrupt, 4, "line 2"},
    {"unknown_version", "ply\nformat ascii 2.0\n", ErrorCode::unsupported, 4, "line 2"},
    {"format_after_element", "ply\nelement vertex 0\n", ErrorCode::corrupt, 4, "line 2"},
    {"property_first", ascii("property float x\n"), ErrorCode::corrupt, 21, "line 3"},
    {"unknown_keyword", ascii("element vertex 0\r\npropperty float x\n"), ErrorCode::corrupt, 39,
     "line 4"},
    {"unknown_type", ascii("element vertex 0\nproperty half x\n"), ErrorCode::corrupt, 38,
     "line 4"},
    {"count_type_real", ascii("element face 0\nproperty list float int vertex_indices\n"),
     ErrorCode::corrupt, 36, "line 4"},
    {"too_few_words", ascii("element vertex\n"), ErrorCode::corrupt, 21, "line 3"},
    {"too_many_words", ascii("element vertex 1 2\n"), ErrorCode::corrupt, 21, "line 3"},
    {"negative_rows", ascii("element vertex -1\n"), ErrorCode::corrupt, 21, "line 3"},
    {"rows_past_64_bits", ascii("element vertex 18446744073709551616\n"), ErrorCode::corrupt, 21,
     "line 3"},
    {"vertex_twice", ascii("element vertex 0\nelement vertex 0\n"), ErrorCode::corrupt, 38,
     "line 4"},
    {"end_not_alone", ascii("end_header now\n"), ErrorCode::corrupt, 21, "line 3"},
    bad_body("faces_alone", ascii(faces(1) + "end_header\n3 0 1 2\n"), ErrorCode::corrupt, 0,
             "element face"),
    bad_body("no_z",
             ascii("element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n"),
             ErrorCode::unsupported, 0, "element vertex"),
    bad_body("faces_without_list", ascii(vertices(0) + "element face 30\nend_header\n"),
             ErrorCode::unsupported, 0, "element face"),
    bad_body("real_indices",
             ascii(vertices(0) +
                   "element face 0\nproperty list uchar float vertex_indices\nend_header\n"),
             ErrorCode::unsupported, 0, "element face"),
    bad_body("short_line", ascii(vertices(2) + "end_header\n1 2\n3 4 5.000\n"), ErrorCode::corrupt,
             3, "line 8"),
    bad_body("long_line", ascii(vertices(2) + "end_header\n1 2 3 4\n5 6 7\n"), ErrorCode::corrupt,
             6, "line 8"),
    bad_body("extra_line", ascii(vertices(1) + "end_header\n1 2 3\n\n4 5 6\n"), ErrorCode::corrupt,
             7, "line 10"),
    bad_body("not_a_number", ascii(vertices(1) + "end_header\n1 2,5 3\n"), ErrorCode::corrupt, 2,
             "line 8"),
    bad_body("two_signs", ascii(vertices(1) + "end_header\n1 --2 3\n"), ErrorCode::corrupt, 2,
             "line 8"),
    bad_body("float_overflow", ascii(vertices(1) + "end_header\n1e39 2 3\n"), ErrorCode::corrupt, 0,
             "line 8"),
    bad_body("nan_payload_too_large", ascii(vertices(1) + "end_header\nnan(0x800000) 2 3\n"),
             ErrorCode::corrupt, 0, "line 8"),
    bad_body("uchar_overflow", ascii(vertices(1, "property uchar a\n") + "end_header\n0 0 0 256\n"),
             ErrorCode::corrupt, 6, "line 9"),
    bad_body("uchar_negative", ascii(vertices(1, "property uchar a\n") + "end_header\n0 0 0 -1\n"),
             ErrorCode::corrupt, 6, "line 9"),
    bad_body("int_overflow",
             ascii(vertices(1, "property int a\n") + "end_header\n0 0 0 2147483648\n"),
             ErrorCode::corrupt, 6, "line 9"),
    bad_body("int_of_many_digits",
             ascii(vertices(1, "property int a\n") + "end_header\n0 0 0 18446744073709551617\n"),
             ErrorCode::corrupt, 6, "line 9"),
    bad_body("int_with_fraction",
             ascii(vertices(1, "property int a\n") + "end_header\n0 0 0 1.5\n"), ErrorCode::corrupt,
             6, "line 9"),
    bad_body("index_past_end", ascii(vertices(1) + faces(1) + "end_header\n0 0 0\n3 0 0 1\n"),
             ErrorCode::corrupt, 12, "line 11"),
    bad_body("index_negative", ascii(vertices(1) + faces(1) + "end_header\n0 0 0\n3 0 -1 0\n"),
             ErrorCode::corrupt, 10, "line 11"),
    bad_body(
        "count_negative",
        ascii(
            vertices(1) +
            "element face 1\nproperty list char int vertex_indices\nend_header\n0 0 0\n-3 0 0 0\n"),
        ErrorCode::corrupt, 6, "line 11"),
    bad_body("count_past_end",
             ascii(vertices(1) + "element face 1\nproperty list int int "
                                 "vertex_indices\nend_header\n0 0 0\n2000000000 0\n"),
             ErrorCode::truncated, 16, "line 11"),
    bad_body("list_past_end",
             ascii(vertices(1, "property list int int a\n") + "end_header\n0 0 0 2000000000 0\n"),
             ErrorCode::truncated, 16, "line 9"),
    bad_body("strip_index",
             ascii(vertices(1) + "element tristrips 1\nproperty list int int "
                                 "vertex_indices\nend_header\n0 0 0\n2 0 -2\n"),
             ErrorCode::corrupt, 5, "element tristrips"),
    bad_body(
        "strips_beside_labelled_faces",
        ascii(vertices(1) + faces(0, "property int a\n") +
              "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n0\n"),
        ErrorCode::unsupported, 0, "element tristrips"),
    bad_body("wedges_apart",
             ascii(vertices(2,
                            "comment each row is a wedge, wedge_vertex is its vertex\nproperty "
                            "uint wedge_vertex\n") +
                   "end_header\n0 0 0 0\n1 0 0 0\n"),
             ErrorCode::corrupt, 0, "element vertex"),
    bad_body("wedge_without_vertex",
             ascii(vertices(2,
                            "comment each row is a wedge, wedge_vertex is its vertex\nproperty "
                            "uint wedge_vertex\n") +
                   "end_header\n0 0 0 1\n0 0 0 1\n"),
             ErrorCode::corrupt, 0, "element vertex"),
    bad_body("wedge_past_rows",
             ascii(vertices(1,
                            "comment each row is a wedge, wedge_vertex is its vertex\nproperty "
                            "uint wedge_vertex\n") +
                   "end_header\n0 0 0 1\n"),
             ErrorCode::corrupt, 0, "element vertex"),
    bad_body("binary_index_past_end",
             little(vertices(1) + faces(2),
                    kZeros + std::string(1, '\0') + std::string("\3\0\0\0\0\1\0\0\0\0\0\0\0", 13)),
             ErrorCode::corrupt, 18, "face 1"),
    bad_body("binary_index_negative", little(vertices(1) + faces(1), kZeros + "\1\xff\xff\xff\xff"),
             ErrorCode::corrupt, 13, "face 0"),
    bad_body("binary_count_negative",
             little(vertices(1) + "element face 1\nproperty list char int vertex_indices\n",
                    kZeros + "\xff"),
             ErrorCode::corrupt, 12, "face 0"),
    bad_body("binary_mixed_index_negative",
             little(vertices(1) +
                        "element face 1\nproperty list int short vertex_indices\nproperty char a\n",
                    kZeros + std::string("\1\0\0\0\xfe\xff\0", 7)),
             ErrorCode::corrupt, 16, "face 0"),
    bad_body("binary_count_past_end",
             little(vertices(1) + "element face 1\nproperty list uint int vertex_indices\n",
                    kZeros + "\xff\xff\xff\xff"),
             ErrorCode::truncated, 16, "face 0"),
};

TEST(ReadPly, RejectsBadFilesWithCodeAndPlace) {
  for (const BadFile& file : kBadFiles) {
    SCOPED_TRACE(file.name);
    const auto model = read_ply(as_bytes(file.bytes));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, file.code) << model.error().message;
    EXPECT_EQ(model.error().offset, file.offset) << model.error().message;
    EXPECT_EQ(model.error().path, file.path);
  }
}

TEST(ReadPly, RejectsHugePromisesAtOnce) {
  const std::string rows = "1000000000000";
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const std::string& element :
         {"element vertex " + rows + "\n" + kXyz,
          vertices(0) + "element face " + rows + "\n" + kFace,
          vertices(0) + "element other " + rows + "\nproperty list uchar int a\n",
          "element vertex 4000000000\n" + kXyz, "element vertex 200000000\n" + kXyz,
          vertices(0) +
              "element other 18446744073709551615\nproperty double a\nproperty double b\n"}) {
      const auto model = read_ply(as_bytes("ply\nformat " + std::string(format) + " 1.0\n" +
                                           element + "end_header\n1 2 3\n"));
      ASSERT_FALSE(model) << element;
      EXPECT_TRUE(model.error().code == ErrorCode::truncated ||
                  model.error().code == ErrorCode::over_limit);
    }
}

TEST(ReadPly, NamesTheFigureThatDoesNotFit) {
  const auto message = [](const std::string& elements, const Limits& limits = {}) {
    const auto model = read_ply(as_bytes(little(elements, kZeros)), limits);
    return model ? "" : model.error().message;
  };
  EXPECT_EQ(message(vertices(300'000'000)), "300000000 vertices, more than the limit of 268435456");
  const std::string faces = "element face 5000000000\n" + kFace;
  EXPECT_EQ(message(vertices(1) + faces), "5000000000 faces, more than the limit of 1073741824");
  EXPECT_EQ(message(vertices(1) + faces, {.corners = 1ull << 40}),
            "5000000000 faces, more than the limit of 4294967040");
  EXPECT_EQ(
      message(vertices(200'000'000) + "element face 900000000\n" + kFace + "property double a\n"),
      "9600000000 bytes of memory, more than the limit of 8589934592");
}

TEST(ReadPly, KeepsToItsLimits) {
  const std::string file = ascii(vertices(3, "property list uchar int near\n") + faces(1) +
                                 "end_header\n0 0 0 2 1 2\n1 0 0 0\n0 1 0 0\n3 0 1 2\n");
  ASSERT_TRUE(read_ply(as_bytes(file)));
  const auto code = [&](const Limits& limits) {
    const auto model = read_ply(as_bytes(file), limits);
    return model ? std::optional<ErrorCode>{} : model.error().code;
  };
  EXPECT_EQ(code({.vertices = 2}), ErrorCode::over_limit);
  EXPECT_EQ(code({.wedges = 2}), ErrorCode::over_limit);
  EXPECT_EQ(code({.corners = 2}), ErrorCode::over_limit);
  EXPECT_EQ(code({.string_bytes = 10}), ErrorCode::over_limit);
  EXPECT_EQ(code({.memory_bytes = 35}), ErrorCode::over_limit);
  EXPECT_EQ(code({.memory_bytes = 7}), ErrorCode::over_limit);
}

/// Copies of exact size, so that a sanitizer sees a read past the end.
void expect_truncated_prefixes(std::string_view file, std::size_t sure) {
  for (std::size_t size = 0; size < sure; ++size) {
    const std::vector<char> prefix(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    const auto model = read_ply(std::as_bytes(std::span(prefix)));
    ASSERT_FALSE(model) << size;
    ASSERT_EQ(model.error().code, ErrorCode::truncated) << size << ' ' << model.error().message;
  }
}

TEST(ReadPly, CallsEveryPrefixOfABinaryFileTruncated) {
  for (const bool big : {false, true})
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      const std::string file = binary(big, line_end);
      expect_truncated_prefixes(file, file.size());
    }
  const std::string plain =
      little(vertices(1) + faces(1), kZeros + std::string("\2\0\0\0\0\0\0\0\0", 9));
  expect_truncated_prefixes(plain, plain.size());
}

TEST(ReadPly, CallsEveryPrefixOfAnAsciiFileTruncated) {
  const std::string file = ascii(
      "comment x\n" + vertices(3, "property list uchar double a\n") + faces(1, "property int f\n") +
      "end_header\n-1.5e-3 +inf -nan(0x12) 2 -infinity 1.#QNAN\n1 0 .5 0\n0 1 0 0\n3 0 1 2 -77");
  expect_truncated_prefixes(file, file.size() - 1);  // before "7", which "77" may have been
}

}  // namespace
}  // namespace pstrips
