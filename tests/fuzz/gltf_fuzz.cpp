// What the glTF reader accepts is consistent and comes back the same unless the writer says what it
// changed; every topology of triangles can be written and read. The buffer file of a .gltf is what
// follows the first zero byte.

#include "formats/gltf/gltf.h"
#include "tests/formats/gltf/files.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/meshes.h"

using namespace pstrips;

namespace {

void check_round_trip(const Model& model, const GltfWriteOptions& options) {
  const auto written = write_gltf(model, options);
  FUZZ_CHECK(written);
  const auto again = read_gltf(written->main, test::among(written->others));
  if (!again)
    std::fprintf(stderr, "%s %s\n", again.error().message.c_str(), again.error().path.c_str());
  FUZZ_CHECK(again);
  if (!written->dropped.empty() || !written->converted.empty()) return;
  FUZZ_CHECK(again->meshes == model.meshes);
  FUZZ_CHECK(again->scene == model.scene);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteView input = fuzz::as_file(data, size);
  const bool is_json = size != 0 && input[0] == std::byte{'{'};
  const auto [file, buffer] = is_json ? fuzz::split_companion(input) : std::pair(input, ByteView());
  const auto companion = [bytes = buffer](const std::string& name) -> Result<Bytes> {
    if (bytes.empty()) return fail(ErrorCode::io, "no such file", kNoOffset, name);
    return fuzz::copy(bytes);
  };
  const auto model = read_gltf(file, companion, fuzz::kLimits);
  if (!model) return 0;
  for (const Mesh& mesh : model->meshes) FUZZ_CHECK(find_inconsistency(mesh).empty());
  check_round_trip(*model, {.binary = true});
  check_round_trip(*model, {.binary = false, .embed = true});
  for (const GltfTopology topology : {GltfTopology::strips, GltfTopology::joined_strips}) {
    const auto written = write_gltf(*model, {.topology = topology});
    FUZZ_CHECK(written);
    FUZZ_CHECK(read_gltf(written->main, {}));
  }
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{.extensions = {".gltf", ".glb"},
             .words = {"{}",
                       "[]",
                       "null",
                       "true",
                       "-1",
                       "1.5",
                       "5126",
                       "5123",
                       "5121",
                       "5125",
                       "\"SCALAR\"",
                       "\"VEC3\"",
                       "\"MAT4\"",
                       "\"mode\":5,",
                       "\"mode\":6,",
                       "\"bufferView\":0,",
                       "\"byteStride\":4,",
                       "\"sparse\":{},",
                       "\"extras\":1,",
                       "\"children\":[0],",
                       "\"normalized\":true,",
                       "\"\\u0000\"",
                       "\"a\":",
                       "\"extensions\":{\"X\":{}},",
                       "\"byteOffset\":1,",
                       "}",
                       "]",
                       "{",
                       "[",
                       ","},
             .seeds = {}};
  Model model;
  for (const Mesh& mesh : {test::cube(true), test::grid(4), test::random_soup(2, 6, 12)}) {
    model.meshes.push_back(mesh);
    for (const auto topology :
         {GltfTopology::triangles, GltfTopology::strips, GltfTopology::joined_strips}) {
      if (const auto files = write_gltf(model, {.topology = topology}))
        out.seeds.push_back(files->main);
      if (const auto files = write_gltf(model, {.binary = false, .topology = topology}))
        out.seeds.push_back(join_companion(
            files->main, files->others.empty() ? ByteView() : ByteView(files->others[0].second)));
    }
  }
  test::Asset asset;
  asset.floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int texcoords = asset.view(test::bytes_of<float>({0, 0, 1, 0, 0, 1}));
  asset.accessor(5126, 3, "VEC2",
                 R"(,"normalized":true,"bufferView":)" + std::to_string(texcoords));
  asset.shorts({0, 1, 2});
  out.seeds.push_back(copy(asset.json(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0,)"
      R"("targets":[{"POSITION":0}]},{"attributes":{"POSITION":0},"mode":2}],"weights":[0.5]}],)"
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"doubleSided":true}],)"
      R"("textures":[{"source":0}],"images":[{"uri":"a.png"}],"cameras":[{"type":"perspective"}],)"
      R"("nodes":[{"mesh":0,"children":[1]},{"translation":[1,2,3],"camera":0}],"scenes":[{"nodes":[0]}])")));
  return out;
}
