#include "converters/file_formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "converters/files.h"

namespace pstrips {
namespace {

using namespace std::string_literals;

TEST(FileFormats, AreFoundByNameAndExtension) {
  for (const FileFormatRow& row : file_formats()) {
    SCOPED_TRACE(row.name);
    EXPECT_EQ(&row_of(row.format), &row);
    EXPECT_EQ(format_named(row.name), row.format);
    EXPECT_EQ(name_of(row.format), row.name);
    EXPECT_EQ(format_of_path("a.b/c." + std::string(row.name)), row.format);
    EXPECT_EQ(holds(row.format, Feature::levels), row.write_strips != nullptr);
    EXPECT_EQ(row.is_validated, row.name.starts_with("pstrip"));
  }
  EXPECT_EQ(format_of_path("A.PLY"), FileFormat::ply);
  for (const char* path : {"", "ply", ".ply", "a.xyzfoo", "a.stl", "a.ply/b", "a."})
    EXPECT_EQ(format_of_path(path), std::nullopt) << path;
}

struct Detection {
  std::string bytes, path;
  std::optional<FileFormat> format;
};

const Detection kDetections[] = {
    // A signature counts more than the name …
    {"ply\nformat", "a.obj", FileFormat::ply},
    {"ply\rformat", "-", FileFormat::ply},
    {"glTF\2", "a.gltf", FileFormat::glb},
    {"\x8aPST", "a.ply", FileFormat::pstrip},
    {"MeshVersionFormatted 1", "-", FileFormat::medit},
    {"# made\n MeshVersionFormatted 1", "a.obj", FileFormat::medit},
    // … the name more than a likeness …
    {"{}", "a.obj", FileFormat::obj},
    {"<a/>", "a.pm", FileFormat::pm},
    {"v 0 0 0", "a.xyz", FileFormat::xyz},
    {"", "a.ply", FileFormat::ply},
    {"solid", "a.mesh", FileFormat::medit},
    // … and a likeness is all there is without either.
    {" \n{}", "-", FileFormat::gltf},
    {"\xef\xbb\xbf <a/>", "-", FileFormat::pstripx},
    {"# pstrips", "a.pm", FileFormat::pm},
    {"# a comment\r\n\r\n  v 0 0 0\r\n", "model", FileFormat::obj},
    {"\xef\xbb\xbfmtllib a.mtl\n", "-", FileFormat::obj},
    {"#\r#\rvn 0 0 1\r", "-", FileFormat::obj},
    {"usemtl a", "a.txt", FileFormat::obj},
    // Formats of others.
    {"solid cube\nfacet normal 0 0 1", "a.stl", std::nullopt},
    {"# vtk DataFile Version 3.0\nvtk output\nASCII", "a.vtk", std::nullopt},
    {"OFF\n3 1 0", "a.off", std::nullopt},
    {"v 0\0 0"s, "-", std::nullopt},
    {"# nothing else\n", "-", std::nullopt},
    {"1 2 3\n", "a.xyzfoo", std::nullopt},
    {"", "-", std::nullopt},
};

TEST(FileFormats, AreDetected) {
  for (const Detection& row : kDetections) {
    SCOPED_TRACE(row.path + ": " + row.bytes);
    EXPECT_EQ(detect_format(as_bytes(row.bytes), row.path), row.format);
  }
}

TEST(FileFormats, ThatAreUnknownAreAnsweredWithThoseThatAreKnown) {
  const Bytes bytes(100, std::byte{'?'});
  const auto file = load(FileBytes(bytes), "a.stl");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::unsupported);
  EXPECT_EQ(file.error().message,
            "is of no known format; known are ply, obj, gltf, glb, xyz, pstrip, pstripx and pm");
  EXPECT_EQ(writable_formats(), "ply, obj, gltf, glb, pstrip, pstripx and pm");
  const auto tetrahedra = load(FileBytes(bytes), "a.mesh");
  ASSERT_FALSE(tetrahedra);
  EXPECT_EQ(tetrahedra.error().message, "holds MEDIT tetrahedra, not a model");
}

TEST(FileFormats, ThatAreNotWrittenAreRefused) {
  for (const FileFormatRow& row : file_formats()) {
    SCOPED_TRACE(row.name);
    if (!row.write_model) {
      EXPECT_EQ(save(Model{}, "/none/a", row.format).error().code, ErrorCode::bad_argument);
    }
    if (!row.write_strips) {
      EXPECT_EQ(save(ProgressiveStrips{}, "/none/a", row.format).error().code,
                ErrorCode::bad_argument);
    }
  }
}

}  // namespace
}  // namespace pstrips
