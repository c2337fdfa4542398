#include "core/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace pstrips {
namespace {

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "pstrips-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    dir_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(dir_); }
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(dir_), {}));
  }
  std::filesystem::path dir_;
};

TEST_F(Files, ComeBackAsWritten) {
  using namespace std::string_literals;
  std::string every_byte;
  for (int b = 0; b < 256; ++b) every_byte += static_cast<char>(b);
  // What text modes change or stop at: line ends, NUL, ^Z; several pages of it, too.
  std::string pages;
  while (pages.size() < 20'000) pages += every_byte + "\r\n\n\r";
  for (const std::string& text : {""s, "abc"s, "\0"s, "\0\n\r\r\n\x1a\0"s, every_byte, pages}) {
    ASSERT_TRUE(write_files({{dir_ / "a", as_bytes(text)}}));
    EXPECT_EQ(std::filesystem::file_size(dir_ / "a"), text.size());
    EXPECT_EQ(as_text(read_file(dir_ / "a")->view()), text);
  }
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, ThatCannotAllBeWrittenAreNotWrittenAtAll) {
  const auto done = write_files({{dir_ / "a", as_bytes("1")}, {dir_ / "no" / "b", as_bytes("2")}});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::io);
  EXPECT_EQ(done.error().path, (dir_ / "no" / "b").string());
  EXPECT_EQ(count(), 0u);
}

TEST_F(Files, AFailedWriteKeepsWhatWasThere) {
  ASSERT_TRUE(write_files({{dir_ / "a", as_bytes("old")}}));
  ASSERT_FALSE(write_files({{dir_ / "a", as_bytes("new")}, {dir_, as_bytes("a folder")}}));
  EXPECT_EQ(as_text(read_file(dir_ / "a")->view()), "old");
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, AreWrittenPieceByPiece) {
  const auto pieces = [](ByteSink& out) -> Result<void> {
    if (auto done = out.write(as_bytes("ab")); !done) return done;
    return out.write(as_bytes("c"));
  };
  ASSERT_TRUE(write_files({{dir_ / "a", {}, pieces}}));
  EXPECT_EQ(as_text(read_file(dir_ / "a")->view()), "abc");

  const auto stops = [](ByteSink& out) -> Result<void> {
    if (auto done = out.write(as_bytes("x")); !done) return done;
    return fail(ErrorCode::over_limit, "too much");
  };
  const auto done = write_files({{dir_ / "a", {}, stops}});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::over_limit);
  EXPECT_EQ(as_text(read_file(dir_ / "a")->view()), "abc") << "what was there stays";
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, KeepTheirPermissions) {
  ASSERT_TRUE(write_files({{dir_ / "a", as_bytes("old")}}));
  std::filesystem::permissions(dir_ / "a", std::filesystem::perms(0640));
  ASSERT_TRUE(write_files({{dir_ / "a", as_bytes("new")}}));
  EXPECT_EQ(std::filesystem::status(dir_ / "a").permissions(), std::filesystem::perms(0640));
}

TEST_F(Files, CanBeReleasedAndReadAgain) {
  const std::string text(100'000, 'x');
  ASSERT_TRUE(write_files({{dir_ / "a", as_bytes(text)}}));
  const auto file = read_file(dir_ / "a");
  ASSERT_TRUE(file);
  for (const std::size_t size : {std::size_t{0}, std::size_t{5000}, text.size(), text.size() * 100})
    file->release(size);
  EXPECT_EQ(as_text(file->view()), text);
}

TEST_F(Files, AreKnownToBeWritableBeforehand) {
  ASSERT_TRUE(write_files({{dir_ / "a", as_bytes("old")}}));
  for (const std::filesystem::path& path :
       {dir_ / "a", dir_ / "new", std::filesystem::path("-"), std::filesystem::path("/dev/null")})
    EXPECT_TRUE(check_writable(path)) << path;
  for (const auto& path : {dir_, dir_ / "no" / "b", dir_ / "a" / "b"}) {
    const auto answer = check_writable(path);
    ASSERT_FALSE(answer) << path;
    EXPECT_EQ(answer.error().code, ErrorCode::io);
    EXPECT_EQ(answer.error().path, path.string());
  }
  EXPECT_EQ(as_text(read_file(dir_ / "a")->view()), "old");
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, SayWhyTheyCannotBeRead) {
  EXPECT_EQ(read_file(dir_ / "none").error().code, ErrorCode::io);
  EXPECT_EQ(read_file(dir_).error().message, "is a folder");
  ASSERT_TRUE(write_files({{dir_ / "a", as_bytes("12345")}}));
  EXPECT_EQ(read_file(dir_ / "a", 4).error().code, ErrorCode::over_limit);
}

}  // namespace
}  // namespace pstrips
