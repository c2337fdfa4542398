// What the OBJ reader accepts is a consistent mesh and comes back the same, text included. The
// material library is what follows the first zero byte.

#include "formats/obj/obj.h"
#include "tests/formats/obj/support.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/meshes.h"

using namespace pstrips;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto [file, library] = fuzz::split_companion(fuzz::as_file(data, size));
  const auto companion = [mtl = library](const std::string& name) -> Result<Bytes> {
    if (mtl.empty()) return fail(ErrorCode::io, "no such file", kNoOffset, name);
    return fuzz::copy(mtl);
  };
  const auto model = read_obj(file, companion, fuzz::kLimits);
  if (!model) return 0;
  const std::string failure = test::check_round_trip(*model);
  if (!failure.empty()) std::fprintf(stderr, "%s\n", failure.c_str());
  FUZZ_CHECK(failure.empty());
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{
      .extensions = {".obj", ".OBJ"},
      .words = {"v ",      "vt ",     "vn ",
                "f ",      "l ",      "p ",
                "o ",      "g ",      "s ",
                "usemtl ", "mtllib ", "newmtl ",
                "Kd ",     "map_Kd ", "//",
                "/",       "\n",      "\\\n",
                "\r\n",    "#",       "off",
                "-1",      "1/1/1",   "1//1",
                "Pm ",     "d 0.5\n", "curv ",
                "end\n",   "a b.mtl", "\xc3\xa9",
                "\xe9",    "xyz ",    "map_Kd -s 1 1 1 a.png\n"},
      .seeds = {
          join_companion(
              as_bytes("# a comment\nmtllib m.mtl\no thing\nv 0 0 0\nv 1 0 0 1\nv 0 1 0 .5 .5 .5\n"
                       "v 1 1 0\nvt 0 0\nvt 1 0 0\nvt .5\nvn 0 0 1\ng a b\nusemtl red\ns 1\n"
                       "f 1/1/1 2/2/1 3/3/1\nf 2//1 4//1 3//1\nusemtl blue\ns off\nl 1 2 3\n"
                       "p 1 2\nf -4 -3 -2 -1\n"),
              as_bytes("newmtl red\nKd 1 0 0\nmap_Kd a.png\nNs 10\nd .5\nnewmtl blue\nPm .1\n"
                       "Pr .2\nKe 0 0 1\nillum 2\nnewmtl odd\nPm nan\nKd 1 inf 0\n")),
          copy(
              "v 0.1 0.2 0.30000000000000004\nv 1e-3 1E5 -0\nvt 0 0\nvn 1 0 0\nvt 1 1\nvn 0 1 0\n"),
      }};
  Model model;
  for (const Mesh& mesh : {test::cube(true), test::grid(4)}) {
    model.meshes = {mesh};
    if (const auto files = write_obj(model, "m.mtl")) out.seeds.push_back(files->obj);
  }
  return out;
}
