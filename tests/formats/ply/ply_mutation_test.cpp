// Damages files at random. What is refused is refused quietly; what is accepted is a consistent
// mesh and comes back the same in all formats.
#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "formats/ply/ply.h"
#include "formats/ply/ply_runs.h"
#include "tests/formats/ply/ply_text.h"

namespace pstrips {
namespace {

const std::string kSeeds[] = {
    "ply\nformat ascii 1.0\ncomment TextureFile a.png\nstray\nelement vertex 3\nproperty uchar "
    "x\nproperty short y\n"
    "property float z\nproperty list int int n\nproperty uchar red\nproperty uchar green\nproperty "
    "uchar blue\n"
    "property float s[0]\nproperty float s[1]\nelement tristrips 1\nproperty list int int "
    "vertex_indices\n"
    "element edge 1\nproperty int vertex1\nend_header\n1 1 1 2 7 1 0 0 0 1 1\n0 0 0 0 1 2 3 1 1\n1 "
    "1 1 0 9 1 1 1 1\n"
    "6 0 1 2 -1 1 1\n1\n",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nproperty int a\n"
    "comment each row is a wedge, wedge_vertex is its vertex\nproperty uint wedge_vertex\nelement "
    "face 1\n"
    "property list uchar int vertex_indices\nend_header\n1 1 1 7 1\n0 0 0 8 0\n1 1 1 9 1\n3 0 1 "
    "2\n",
    "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile b.png\nelement face 2\n"
    "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int "
    "texnumber\n"
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty float "
    "s\nproperty float t\n"
    "end_header\n3 0 1 2 6 0 0 1 0 0 1 0\n3 2 1 3 6 0 1 .5 .5 1 1 1\n0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 "
    "6\n1 1 0 7 8\n",
};

const char* const kWords[] = {"x",          "y",
                              "z",          "red",
                              "s",          "t",
                              "texcoord",   "vertex_indices",
                              "float",      "int",
                              "list",       "uchar",
                              "property",   "element",
                              "comment",    "face",
                              "vertex",     "tristrips",
                              "edge",       "texnumber",
                              "a[0]",       "wedge_vertex",
                              "-1",         "0",
                              "1",          "2",
                              "3",          "nan",
                              "1e5",        "NORMAL",
                              "TEXCOORD_0", "\n",
                              "\r",         " "};

std::string damaged(std::string file, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  for (std::size_t k = 1 + below(4); k > 0 && !file.empty(); --k) {
    const std::size_t at = below(file.size());
    const std::size_t word = file.find_first_of(" \n", at);
    switch (below(5)) {
      case 0:
        file[at] = static_cast<char>(below(256));
        break;
      case 1:
        file.erase(at, 1 + below(4));
        break;
      case 2:
        file.insert(at, kWords[below(std::size(kWords))]);
        break;
      case 3:
        file.insert(below(file.size()), file.substr(at, 1 + below(40)));
        break;
      case 4:
        if (word == std::string::npos) break;
        file.replace(word + 1, file.find_first_of(" \n", word + 1) - word - 1,
                     kWords[below(std::size(kWords))]);
        break;
    }
  }
  return file;
}

// However text is cut and however many read it: the same model, or the same fault at the same
// place.
TEST(PlyMutation, RunsReadWhatOneReaderReads) {
  std::mt19937 random(2);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string file = damaged(kSeeds[random() % std::size(kSeeds)], random);
    if (i % 3 == 0) file = std::regex_replace(file, std::regex("\n"), i % 2 == 0 ? "\r\n" : "\r");
    Limits limits{.threads = 1};
    if (i % 5 == 0) limits.corners = random() % 10;
    if (i % 7 == 0) limits.memory_bytes = random() % 3000;
    const auto whole = read_ply(as_bytes(file), limits);
    limits.threads = 3;
    for (const std::size_t run_bytes : {1, 5, 40}) {
      const auto runs = ply::read_ply_in_runs(as_bytes(file), limits, run_bytes);
      ASSERT_EQ(whole.has_value(), runs.has_value()) << file;
      if (whole)
        ASSERT_EQ(*whole, *runs) << file;
      else
        ASSERT_EQ(whole.error(), runs.error()) << whole.error().message << '\n' << file;
    }
    ++(whole ? accepted : refused);
  }
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused, 500);
}

TEST(PlyMutation, WhatIsAcceptedComesBack) {
  std::mt19937 random(1);
  std::vector<std::string> files(std::begin(kSeeds), std::end(kSeeds));
  for (const std::string& seed : kSeeds)
    for (const auto format :
         {PlyWriteOptions::Format::little_endian, PlyWriteOptions::Format::big_endian}) {
      const auto model = read_ply(as_bytes(seed));
      ASSERT_TRUE(model) << model.error().message;
      files.emplace_back(as_text(*write_ply(*model, {format})));
    }
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string file = damaged(files[random() % files.size()], random);
    Model model;
    if (auto read = read_ply(as_bytes(file)))
      model = *std::move(read);
    else
      continue;
    ++accepted;
    // Ascii has no place for bytes after the end of a binary body.
    std::erase_if(model.scene.foreign, [](const Foreign& f) { return f.key == "ply/rest"; });
    for (const Mesh& mesh : model.meshes) ASSERT_EQ(find_inconsistency(mesh), "") << file;
    ASSERT_EQ(test::round_trip_failure(model), "") << file;
  }
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace pstrips
