// What the reader of points accepts is a consistent mesh of as many points as it has coordinates
// for, and its strips show the triangles of its triangulation, each once.

#include "codecs/stripify/check.h"
#include "codecs/stripify/delaunay.h"
#include "formats/xyz/xyz.h"
#include "tests/fuzz/fuzz.h"

using namespace pstrips;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto model = read_xyz(fuzz::as_file(data, size), fuzz::kLimits);
  if (!model) return 0;
  FUZZ_CHECK(model->meshes.size() == 1 && find_inconsistency(model->meshes[0]).empty());
  const std::vector<double> positions = positions_as_double(model->meshes[0]);
  const std::vector<Index> triangles = delaunay_triangles(positions, {});
  const StripInput input{
      .triangles = triangles, .group = {}, .wedge_count = model->meshes[0].wedge_count()};
  FUZZ_CHECK(find_strip_fault(input, delaunay_strips(positions, {})).empty());
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{.extensions = {".xyz", ".pts"},
             .words = {"1 2 3\n", "0 0 0\n", "nan ", "inf ", "-1e308 ", "5e-324 ", "#", ",", ";",
                       "\r\n", "\n", "1e400 ", "0x1p3 ", "1.#INF "},
             .seeds = {copy("4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"),
                       copy("x,y,z\n1,2,3,4\n3;2;1\n1 1 1 # c\n2e10 -1e-300 0\n")}};
  std::string grid;
  for (int i = 0; i < 36; ++i)
    grid += std::to_string(i % 6) + " " + std::to_string(i / 6) + " 0.5\n";
  out.seeds.push_back(copy(grid));
  return out;
}
