#include "converters/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

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

}  // namespace
}  // namespace pstrips
