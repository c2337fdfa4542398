// Payloads that the libraries' own encoders made, and what is left of them when they are spoilt.

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <random>

#include "formats/draco/draco.h"
#include "tests/formats/gltf/files.h"

namespace pstrips {
namespace {

using test::Asset;
using test::read_text;

constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0.5f}};
constexpr int kFaces[2][3] = {{0, 1, 2}, {0, 2, 3}};

struct DracoPayload {
  Bytes bytes;
  std::uint32_t position, feature;  ///< ids of attributes
};

/// Two triangles with a whole number at each corner, position bits kept.
DracoPayload draco_square(int method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int feature = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT16);
  for (int f = 0; f < 2; ++f) {
    const std::uint16_t numbers[3] = {7, 7, static_cast<std::uint16_t>(600 + f)};
    const auto face = draco::FaceIndex(static_cast<std::uint32_t>(f));
    builder.SetAttributeValuesForFace(position, face, kCorners[kFaces[f][0]],
                                      kCorners[kFaces[f][1]], kCorners[kFaces[f][2]]);
    builder.SetAttributeValuesForFace(feature, face, &numbers[0], &numbers[1], &numbers[2]);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  const auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
  return {Bytes(bytes.begin(), bytes.end()), mesh->attribute(position)->unique_id(),
          mesh->attribute(feature)->unique_id()};
}

using Triangle = std::array<std::array<float, 4>, 3>;

/// Position and number of each corner, each triangle from its least corner on, sorted.
std::vector<Triangle> triangles_of(std::span<const Index> corners, const Attribute& position,
                                   const Attribute& number) {
  std::vector<Triangle> out(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      out[i / 3][i % 3][c] = static_cast<float>(component(position, corners[i], c));
    out[i / 3][i % 3][3] = static_cast<float>(component(number, corners[i], 0));
  }
  for (Triangle& t : out) std::ranges::rotate(t, std::ranges::min_element(t));
  std::ranges::sort(out);
  return out;
}

const std::vector<Triangle> kSquare = {
    {{{0, 0, 0, 7}, {1, 0, 0, 7}, {1, 2, 0, 600}}},
    {{{0, 0, 0, 7}, {1, 2, 0, 7}, {0, 2, 0.5f, 601}}},
};

const Attribute& attribute_of(const DracoGeometry& geometry, std::uint32_t id) {
  return std::ranges::find(geometry.attributes, id, &DracoAttribute::id)->values;
}

TEST(Draco, GivesTheTrianglesThatWereEncoded) {
  for (const int method : {0, 1}) {
    const DracoPayload payload = draco_square(method);
    const auto geometry = decode_draco(payload.bytes);
    ASSERT_TRUE(geometry) << geometry.error().message;
    EXPECT_EQ(triangles_of(geometry->triangles, attribute_of(*geometry, payload.position),
                           attribute_of(*geometry, payload.feature)),
              kSquare);
  }
}

TEST(Draco, RefusesWhatIsCutOrSpoilt) {
  const Bytes whole = draco_square(1).bytes;
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(decode_draco(ByteView(whole).first(size))) << size;
  std::mt19937 random(3);
  const Limits limits{.memory_bytes = 1 << 24};
  for (int n = 0; n < 2000; ++n) {
    Bytes bytes = draco_square(n % 2).bytes;
    bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    (void)decode_draco(bytes, limits);
  }
}

TEST(Draco, ComparesCountsWithTheLimitsBeforeItDecodes) {
  const Bytes bytes = draco_square(0).bytes;
  EXPECT_EQ(decode_draco(bytes, {.wedges = 3}).error().code, ErrorCode::over_limit);
  EXPECT_EQ(decode_draco(bytes, {.corners = 5}).error().code, ErrorCode::over_limit);
  EXPECT_EQ(decode_draco(bytes, {.memory_bytes = 100}).error().code, ErrorCode::over_limit);
  // A mesh of 2^28 - 1 faces in eighteen bytes.
  Bytes bomb(bytes.begin(), bytes.begin() + 11);
  for (const int x : {0xff, 0xff, 0xff, 0x7f, 1, 0, 0}) bomb.push_back(static_cast<std::byte>(x));
  EXPECT_EQ(decode_draco(bomb, {.memory_bytes = 1 << 30}).error().code, ErrorCode::over_limit);
}

TEST(ReadGltf, DecodesDracoPrimitives) {
  const DracoPayload payload = draco_square(1);
  const auto points = std::to_string(decode_draco(payload.bytes)->points);
  Asset asset;
  asset.view(payload.bytes);
  asset.accessor(5126, std::stoull(points), "VEC3");
  asset.accessor(5123, std::stoull(points), "SCALAR");
  asset.accessor(5121, 6, "SCALAR");
  asset.accessor(5121, 5, "SCALAR");
  const auto json = [&](int corners_accessor) {
    return asset.json(
        R"("extensionsUsed":["KHR_draco_mesh_compression"],)"
        R"("extensionsRequired":["KHR_draco_mesh_compression"],"meshes":[{"primitives":[{)"
        R"("attributes":{"POSITION":0,"_FEATURE":1},"indices":)" +
        std::to_string(corners_accessor) +
        R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":)" +
        std::to_string(payload.position) + R"(,"_FEATURE":)" + std::to_string(payload.feature) +
        "}}}}]}]");
  };
  const auto model = read_text(json(2));
  ASSERT_TRUE(model) << model.error().message << model.error().path;
  const Mesh& mesh = model->meshes[0];
  Attribute position = mesh.position;
  if (!mesh.wedge_vertex.empty()) {
    position.data.clear();
    for (const Index v : mesh.wedge_vertex) {
      const ByteView at = mesh.position.element(v);
      position.data.insert(position.data.end(), at.begin(), at.end());
    }
  }
  EXPECT_EQ(triangles_of(mesh.corners, position, mesh.wedge_attributes[0]), kSquare);
  EXPECT_EQ(as_text(model->scene.foreign[0].data).find("draco"), std::string_view::npos);
  EXPECT_EQ(read_text(json(3)).error().code, ErrorCode::corrupt);
}

/// A .gltf whose second buffer holds nothing but in compressed form.
std::string meshopt_asset(const Bytes& positions, const Bytes& corners, const char* extension,
                          std::size_t count = 4) {
  const auto view = [&](std::size_t at, std::size_t bytes, std::size_t from, std::size_t size,
                        const std::string& more) {
    return R"({"buffer":1,"byteOffset":)" + std::to_string(at) + R"(,"byteLength":)" +
           std::to_string(bytes) + R"(,"extensions":{")" + extension +
           R"(":{"buffer":0,"byteOffset":)" + std::to_string(from) + R"(,"byteLength":)" +
           std::to_string(size) + more + "}}}";
  };
  Bytes all = positions;
  all.insert(all.end(), corners.begin(), corners.end());
  return R"({"asset":{"version":"2.0"},"extensionsRequired":[")" + std::string(extension) +
         R"("],"buffers":[{"byteLength":)" + std::to_string(all.size()) +
         R"(,"uri":"data:;base64,)" + base64(all) + R"("},{"byteLength":60}],"bufferViews":[)" +
         view(0, 48, 0, positions.size(),
              R"(,"byteStride":12,"mode":"ATTRIBUTES","count":)" + std::to_string(count)) +
         "," +
         view(48, 12, positions.size(), corners.size(),
              R"(,"byteStride":2,"mode":"TRIANGLES","count":6)") +
         R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})";
}

Bytes meshopt_positions() {
  Bytes out(meshopt_encodeVertexBufferBound(4, 12));
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        kCorners, 4, 12));
  return out;
}

Bytes meshopt_corners() {
  const unsigned corners[6] = {0, 1, 2, 0, 2, 3};
  Bytes out(meshopt_encodeIndexBufferBound(6, 4));
  out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                       corners, 6));
  return out;
}

TEST(ReadGltf, DecodesMeshoptViews) {
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const auto model = read_text(meshopt_asset(meshopt_positions(), meshopt_corners(), extension));
    ASSERT_TRUE(model) << model.error().message << model.error().path;
    const std::vector<float> positions = test::values_of<float>(model->meshes[0].position.data);
    EXPECT_EQ(positions, std::vector<float>(&kCorners[0][0], &kCorners[0][0] + 12));
    EXPECT_EQ(model->meshes[0].face_count(), 2u);
  }
}

TEST(ReadGltf, RefusesMeshoptViewsThatDoNotFit) {
  const auto refused = [](const Bytes& positions, std::size_t count) {
    const auto model =
        read_text(meshopt_asset(positions, meshopt_corners(), "EXT_meshopt_compression", count));
    return model ? "read" : model.error().path;
  };
  EXPECT_EQ(refused(meshopt_positions(), 3), "/bufferViews/0");
  EXPECT_EQ(refused(meshopt_positions(), 4'000'000'000), "/bufferViews/0");
  Bytes cut = meshopt_positions();
  cut.pop_back();
  EXPECT_EQ(refused(cut, 4), "/bufferViews/0");
  Bytes later = meshopt_positions();
  later[0] = std::byte{0xa1};
  EXPECT_EQ(refused(later, 4), "/bufferViews/0");
}

}  // namespace
}  // namespace pstrips
