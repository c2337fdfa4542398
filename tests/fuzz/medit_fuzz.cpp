// What the reader of tetrahedra accepts names only vertices that are there, and its strips show
// each tetrahedron once.

#include <algorithm>

#include "codecs/stripify/tetra_multi_path.h"
#include "formats/medit/medit.h"
#include "tests/fuzz/fuzz.h"

using namespace pstrips;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto mesh = read_medit(fuzz::as_file(data, size), fuzz::kLimits);
  if (!mesh) return 0;
  FUZZ_CHECK(mesh->positions.size() % 3 == 0 && mesh->tetrahedra.size() % 4 == 0);
  FUZZ_CHECK(
      std::ranges::all_of(mesh->tetrahedra, [&](Index v) { return v < mesh->vertex_count(); }));
  const TetraStrips strips = tetra_multi_path(mesh->tetrahedra, mesh->vertex_count(), {});
  FUZZ_CHECK(find_tetra_strip_fault(mesh->tetrahedra, strips).empty());
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  return {
      .extensions = {".mesh"},
      .words = {"MeshVersionFormatted ", "Dimension 3\n", "Vertices\n", "Tetrahedra\n", "End\n",
                "Triangles 1\n", "Ridges\n", "#", "\n", "0 ", "1 2 3 4 0\n", "4294967295 ", "nan ",
                "-1 ", "2 3 4 1 1\n"},
      .seeds = {copy("MeshVersionFormatted 1\nDimension\n3\n# c\nVertices\n5\n0 0 0 1\n1 0 0 1\n"
                     "0 1 0 1\n0 0 1 1\n1 1 1 2\nTriangles\n1\n1 2 3 0\nTetrahedra\n3\n1 2 3 4 7\n"
                     "5 4 3 2 7\n1 1 2 3 7\nEdges 0\nEnd\n")}};
}
