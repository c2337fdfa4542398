// What is not sound glTF gets an answer with a code and a place, and costs nothing.

#include <gtest/gtest.h>

#include <random>

#include "tests/formats/gltf/files.h"

namespace pstrips {
namespace {

using test::Asset;
using test::read_text;

struct BadJson {
  const char* name;
  const char* members;  ///< beside the asset
  ErrorCode code;
  const char* path;
};

/// A buffer of 36 zero bytes, all of it in view 0.
#define BUFFER \
  R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}],)"
#define VIEW R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
#define POINTS R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":0}]}])"

const BadJson kBadJson[] = {
    {"list_is_object", R"("nodes":{})", ErrorCode::corrupt, "/nodes"},
    {"element_is_number", R"("materials":[1])", ErrorCode::corrupt, "/materials/0"},
    {"negative", R"("buffers":[{"byteLength":-1}])", ErrorCode::corrupt, "/buffers/0/byteLength"},
    {"fraction", R"("buffers":[{"byteLength":1.5}])", ErrorCode::corrupt, "/buffers/0/byteLength"},
    {"no_length", R"("buffers":[{}])", ErrorCode::corrupt, "/buffers/0"},
    {"no_such_buffer", R"("bufferViews":[{"buffer":0,"byteLength":1}])", ErrorCode::corrupt,
     "/bufferViews/0/buffer"},
    {"component_type", R"("accessors":[{"componentType":5124,"count":1,"type":"SCALAR"}])",
     ErrorCode::corrupt, "/accessors/0"},
    {"accessor_type", R"("accessors":[{"componentType":5126,"count":1,"type":"VEC5"}])",
     ErrorCode::corrupt, "/accessors/0"},
    {"mode", R"("meshes":[{"primitives":[{"attributes":{},"mode":7}]}])", ErrorCode::corrupt,
     "/meshes/0/primitives/0"},
    {"no_primitives", R"("meshes":[{}])", ErrorCode::corrupt, "/meshes/0"},
    {"no_such_material", R"("meshes":[{"primitives":[{"attributes":{},"material":0}]}])",
     ErrorCode::corrupt, "/meshes/0/primitives/0/material"},
    {"no_such_accessor", POINTS, ErrorCode::corrupt, "/meshes/0/primitives/0/attributes/POSITION"},
    {"cycle", R"("nodes":[{"children":[1]},{"children":[0]}])", ErrorCode::corrupt, "/nodes"},
    {"cycle_below_root", R"("nodes":[{"children":[1]},{"children":[2]},{"children":[1]}])",
     ErrorCode::corrupt, "/nodes"},
    {"no_such_child", R"("nodes":[{"children":[1]}])", ErrorCode::corrupt, "/nodes/0/children/0"},
    {"short_matrix", R"("nodes":[{"matrix":[1,2]}])", ErrorCode::corrupt, "/nodes/0/matrix"},
    {"animation_input", R"("animations":[{"samplers":[{"input":0}]}])", ErrorCode::corrupt, ""},
    {"required", R"("extensionsRequired":["VENDOR_geometry"])", ErrorCode::unsupported,
     "/extensionsRequired"},
    {"view_past_buffer",
     BUFFER
     R"("bufferViews":[{"buffer":0,"byteOffset":1,"byteLength":36}],)"
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/bufferViews/0"},
    {"offsets_that_wrap",
     BUFFER
     R"("bufferViews":[{"buffer":0,"byteOffset":18446744073709551615,"byteLength":36}],)"
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/bufferViews/0"},
    {"accessor_past_view",
     BUFFER VIEW
     R"("accessors":[{"bufferView":0,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/bufferViews/0"},
    {"count_beyond_bytes",
     BUFFER VIEW
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":4000000000,"type":"VEC3"}],)" POINTS,
     ErrorCode::over_limit, "/meshes"},
    {"many_zeros",
     R"("accessors":[{"componentType":5126,"count":200000000,"type":"VEC3"}],)" POINTS,
     ErrorCode::over_limit, "/accessors/0"},
    {"stride_below_element",
     BUFFER
     R"("bufferViews":[{"buffer":0,"byteLength":36,"byteStride":8}],)"
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/bufferViews/0"},
    {"stride_that_wraps",
     BUFFER
     R"("bufferViews":[{"buffer":0,"byteLength":36,"byteStride":9223372036854775808}],)"
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/bufferViews/0"},
    {"buffer_without_bytes",
     R"("buffers":[{"byteLength":36}],)" VIEW
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/buffers/0"},
    {"buffer_too_short",
     R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAA"}],)" VIEW
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" POINTS,
     ErrorCode::truncated, "/buffers/0"},
    {"no_base64",
     R"("buffers":[{"byteLength":36,"uri":"data:;base64,A-_A"}],)" VIEW
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/buffers/0"},
    {"positions_of_two", R"("accessors":[{"componentType":5126,"count":1,"type":"VEC2"}],)" POINTS,
     ErrorCode::corrupt, "/meshes/0/primitives/0"},
    {"lengths_differ",
     R"("accessors":[{"componentType":5126,"count":1,"type":"VEC3"},{"componentType":5126,"count":2,"type":"VEC3"}],)"
     R"("meshes":[{"primitives":[{"attributes":{"NORMAL":1,"POSITION":0}}]}])",
     ErrorCode::corrupt, "/meshes/0/primitives/0/attributes/NORMAL"},
    {"index_past_vertices",
     R"("accessors":[{"componentType":5126,"count":0,"type":"VEC3"},{"componentType":5123,"count":3,"type":"SCALAR"}],)"
     R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])",
     ErrorCode::corrupt, "/accessors/1"},
    {"float_indices",
     R"("accessors":[{"componentType":5126,"count":1,"type":"VEC3"},{"componentType":5126,"count":3,"type":"SCALAR"}],)"
     R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])",
     ErrorCode::corrupt, "/accessors/1"},
    {"sparse_index_past_elements",
     R"("buffers":[{"byteLength":36,"uri":"data:;base64,/wAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}],)" VIEW
     R"("accessors":[{"componentType":5126,"count":2,"type":"VEC3","sparse":{"count":1,)"
     R"("indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],)" POINTS,
     ErrorCode::corrupt, "/accessors/0"},
    {"sparse_indices_repeat",
     BUFFER VIEW
     R"("accessors":[{"componentType":5126,"count":2,"type":"VEC3","sparse":{"count":2,)"
     R"("indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],)" POINTS,
     ErrorCode::corrupt, "/accessors/0"},
    {"draco_without_indices",
     R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],)"
     R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},)"
     R"("extensions":{"KHR_draco_mesh_compression":{"bufferView":0}}}]}])",
     ErrorCode::corrupt, "/meshes/0/primitives/0"},
    {"draco_that_is_none",
     BUFFER VIEW R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3"},)"
                 R"({"componentType":5123,"count":3,"type":"SCALAR"}],)"
                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,)"
                 R"("extensions":{"KHR_draco_mesh_compression":{"bufferView":0}}}]}])",
     ErrorCode::corrupt, "/meshes/0/primitives/0"},
    {"meshopt_without_numbers",
     R"("buffers":[{"byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36,)"
     R"("extensions":{"EXT_meshopt_compression":{}}}],)"
     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" POINTS,
     ErrorCode::corrupt, "/bufferViews/0"},
    {"image_twice", BUFFER VIEW R"("images":[{"uri":"a.png","bufferView":0}])", ErrorCode::corrupt,
     "/images/0"},
    {"view_of_extension", R"("extensions":{"X":{"bufferView":3}})", ErrorCode::corrupt, ""},
};

TEST(BrokenGltf, IsRefusedWithCodeAndPlace) {
  for (const BadJson& bad : kBadJson) {
    SCOPED_TRACE(bad.name);
    const auto model = read_text(R"({"asset":{"version":"2.0"},)" + std::string(bad.members) + "}");
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, bad.code) << model.error().message;
    EXPECT_EQ(model.error().path, bad.path) << model.error().message;
  }
}

TEST(BrokenGltf, NeedsAnAssetOfVersionTwo) {
  EXPECT_EQ(read_text("{}").error().code, ErrorCode::corrupt);
  EXPECT_EQ(read_text("[]").error().code, ErrorCode::corrupt);
  EXPECT_EQ(read_text(R"({"asset":{"version":"1.0"}})").error().code, ErrorCode::unsupported);
  EXPECT_EQ(read_text(R"({"asset":{"version":"3.0"}})").error().code, ErrorCode::unsupported);
  EXPECT_EQ(read_text(R"({"asset":{"version":"2.1","minVersion":"2.1"}})").error().code,
            ErrorCode::unsupported);
  EXPECT_TRUE(read_text(R"({"asset":{"version":"2.1"}})"));
}

TEST(BrokenGltf, SaysWhereTheJsonBreaks) {
  const auto broken = read_text(R"({"asset":})");
  EXPECT_EQ(broken.error().code, ErrorCode::corrupt);
  EXPECT_EQ(broken.error().offset, 9u);
  EXPECT_EQ(read_text(R"({"asset":{"version":"2.0"},"x":1e999})").error().code, ErrorCode::corrupt);
  EXPECT_EQ(read_text("{\"asset\":{\"version\":\"2.0\"},\"x\":\"\xff\"}").error().code,
            ErrorCode::corrupt);
}

Asset triangle() {
  Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.floats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  asset.shorts({0, 1, 2});
  asset.floats("SCALAR", 2, {0, 1});
  return asset;
}
const char* const kTriangle =
    R"("nodes":[{"mesh":0}],"images":[{"uri":"data:image/png;base64,AAEC"}],)"
    R"("animations":[{"samplers":[{"input":3,"output":3}],"channels":[]}],)"
    R"("meshes":[{"primitives":[{"attributes":{"NORMAL":1,"POSITION":0},"indices":2}]}])";

TEST(BrokenGltf, EveryPrefixIsTruncated) {
  const std::string text = triangle().json(kTriangle);
  for (const Bytes& file :
       {triangle().glb(kTriangle), Bytes(as_bytes(text).begin(), as_bytes(text).end())}) {
    ASSERT_TRUE(read_gltf(file, {}));
    for (std::size_t size = 0; size < file.size(); ++size) {
      const auto model = read_gltf(Bytes(file.begin(), file.begin() + std::ptrdiff_t(size)), {});
      ASSERT_FALSE(model) << size;
      EXPECT_EQ(model.error().code, ErrorCode::truncated) << size << ' ' << model.error().message;
    }
  }
}

TEST(BrokenGltf, ChunksThatLieAreRefused) {
  const Bytes good = triangle().glb(kTriangle);
  const auto with = [&](std::size_t at, std::uint32_t value) {
    Bytes file = good;
    std::memcpy(file.data() + at, &value, sizeof value);
    return read_gltf(file, {});
  };
  EXPECT_EQ(with(4, 1).error().code, ErrorCode::unsupported);
  EXPECT_EQ(with(8, 11).error().code, ErrorCode::corrupt);
  EXPECT_EQ(with(8, static_cast<std::uint32_t>(good.size() - 4)).error().code, ErrorCode::corrupt);
  EXPECT_EQ(with(8, static_cast<std::uint32_t>(good.size() + 4)).error().code,
            ErrorCode::truncated);
  EXPECT_EQ(with(12, 0xffffffff).error().code, ErrorCode::corrupt);
  EXPECT_EQ(with(12, 0xffffffff).error().offset, 12u);
  EXPECT_EQ(with(16, 0).error().code, ErrorCode::corrupt);
}

TEST(BrokenGltf, DamagedBytesAreRefusedOrComeBack) {
  const Bytes good = triangle().glb(kTriangle);
  std::mt19937 random(7);
  int read = 0;
  for (int round = 0; round < 4000; ++round) {
    Bytes file = good;
    for (auto n = 1 + random() % 3; n > 0; --n)
      file[20 + random() % (file.size() - 20)] = static_cast<std::byte>(random());
    const auto model = read_gltf(file, {});
    if (!model) continue;
    ++read;
    const auto files = write_gltf(*model);
    ASSERT_TRUE(files) << "round " << round;
    if (!files->dropped.empty()) continue;
    const auto again = read_gltf(files->main, {});
    ASSERT_TRUE(again) << "round " << round << ' ' << again.error().message;
    ASSERT_TRUE(*again == *model) << "round " << round;
  }
  EXPECT_GT(read, 100);  // most damage to coordinates cannot be seen
}

TEST(BrokenGltf, LimitsAreKept) {
  const std::string text = triangle().json(kTriangle);
  const auto refuses = [&](auto set) {
    Limits limits;
    set(limits);
    const auto model = read_text(text, limits);
    return !model && model.error().code == ErrorCode::over_limit;
  };
  EXPECT_TRUE(read_text(text));
  EXPECT_TRUE(refuses([](Limits& l) { l.vertices = 2; }));
  EXPECT_TRUE(refuses([](Limits& l) { l.wedges = 2; }));
  EXPECT_TRUE(refuses([](Limits& l) { l.corners = 2; }));
  EXPECT_TRUE(refuses([](Limits& l) { l.meshes = 0; }));
  EXPECT_TRUE(refuses([](Limits& l) { l.string_bytes = 2; }));
  EXPECT_TRUE(refuses([](Limits& l) { l.memory_bytes = 100; }));
  EXPECT_TRUE(refuses([](Limits& l) { l.xml_depth = 4; }));
}

/// The JSON alone tells; the buffer is not asked for.
TEST(BrokenGltf, CountsThatDoNotFitAreRefusedBeforeWorkStarts) {
  const auto refusal = [](const std::string& positions, const std::string& indices) {
    bool asked = false;
    const ReadFile never = [&](const std::string&) -> Result<Bytes> {
      asked = true;
      return fail(ErrorCode::io, "not there");
    };
    const std::string text =
        R"({"asset":{"version":"2.0"},"buffers":[{"uri":"b.bin","byteLength":40000000000}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":40000000000}],"accessors":[)"
        R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
        positions + R"(},{"bufferView":0,"componentType":5125,"type":"SCALAR","count":)" + indices +
        R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})";
    const auto model = read_gltf(as_bytes(text), never);
    EXPECT_FALSE(asked);
    return model ? "" : model.error().message;
  };
  EXPECT_EQ(refusal("3", "3000000000"),
            "3000000000 face corners, more than the limit of 1073741824");
  EXPECT_EQ(refusal("300000000", "3"), "300000000 wedges, more than the limit of 268435456");
  EXPECT_EQ(refusal("100000000", "1000000000"),
            "9200000000 bytes of memory, more than the limit of 8589934592");
}

/// Each node has the next one as its child twice: 2^40 places in the scene.
TEST(BrokenGltf, NodesThatMultiplyAreRefused) {
  std::string nodes;
  for (int i = 1; i <= 40; ++i)
    nodes += R"({"children":[)" + std::to_string(i) + ',' + std::to_string(i) + "]},";
  Limits limits;
  limits.meshes = 1000;
  EXPECT_EQ(read_text(Asset().json(R"("nodes":[)" + nodes + "{}]"), limits).error().code,
            ErrorCode::over_limit);
}

TEST(BrokenGltf, NestingIsNotFollowedForEver) {
  const std::string deep(1000000, '[');
  EXPECT_EQ(read_text(R"({"asset":{"version":"2.0"},"extras":)" + deep).error().code,
            ErrorCode::over_limit);
}

}  // namespace
}  // namespace pstrips
