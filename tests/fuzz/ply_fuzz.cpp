// What the PLY reader accepts is a consistent mesh and comes back the same in all three formats.

#include "formats/ply/ply.h"
#include "tests/formats/ply/ply_text.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/meshes.h"

using namespace pstrips;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto model = read_ply(fuzz::as_file(data, size), fuzz::kLimits);
  if (!model) return 0;
  for (const Mesh& mesh : model->meshes) FUZZ_CHECK(find_inconsistency(mesh).empty());
  // Ascii has no place for bytes after the end of a binary body.
  std::erase_if(model->scene.foreign, [](const Foreign& f) { return f.key == "ply/rest"; });
  const std::string failure = test::round_trip_failure(*model);
  if (!failure.empty()) std::fprintf(stderr, "%s\n", failure.c_str());
  FUZZ_CHECK(failure.empty());
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{
      .extensions = {".ply", ".PLY"},
      .words = {"x",
                "y",
                "z",
                "red",
                "s",
                "t",
                "texcoord",
                "float",
                "double",
                "int",
                "list",
                "uchar",
                "property",
                "element",
                "comment ",
                "face",
                "vertex",
                "tristrips",
                "edge",
                "nx",
                "a[0]",
                "texnumber",
                "vertex_indices",
                "wedge_vertex",
                "\n",
                "\r",
                " ",
                "nan(0x1)",
                "comment TextureFile a.png\n",
                "ascii",
                "binary_little_endian",
                "binary_big_endian",
                "obj_info "},
      .seeds = {copy("ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile b.png\n"
                     "element face 2\nproperty list uchar int vertex_indices\n"
                     "property list uchar float texcoord\nproperty int texnumber\n"
                     "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
                     "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
                     "3 0 1 2 6 0 0 1 0 0 1 0\n3 2 1 3 6 0 1 .5 .5 1 1 1\n"
                     "0 0 0 1 2 3\n1 0 0 3 4 5\n0 1 0 5 6 7\n1 1 0 7 8 9\n"),
                copy("ply\nformat ascii 1.0\nobj_info made by hand\nelement vertex 3\n"
                     "property uchar x\nproperty short y\nproperty float z\n"
                     "property list int int n\nelement tristrips 1\n"
                     "property list int int vertex_indices\nelement edge 1\nproperty int vertex1\n"
                     "end_header\n1 1 1 2 7 1\n0 0 0 0\n1 1 1 0\n6 0 1 2 -1 1 1\n1\n"),
                copy("ply\nformat binary_little_endian 1.0\nelement vertex 0\n"
                     "property float x\nproperty float y\nproperty float z\n"
                     "element edge 12\nend_header\n")}};
  Model model;
  for (const Mesh& mesh : {test::cube(true), test::grid(4), test::random_soup(1, 6, 12)}) {
    model.meshes = {mesh};
    for (const auto format : test::kFormats)
      if (auto file = write_ply(model, {format})) out.seeds.push_back(*std::move(file));
  }
  return out;
}
