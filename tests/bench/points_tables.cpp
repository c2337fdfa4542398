// The tables of Vanecek's chapters 3 and 6: strips over points beside the plain triangulation, and
// strips of tetrahedra, those of Delaunay meshes of random points where CGAL is installed.
//
// [Vanecek05 table 3.3] DTS takes 1.02-1.05 of DT's time; strips come at a fifth of SGI's time.
// [Vanecek05 tables 3.2, 3.4] 0.12-0.13 strips a point.
// [Vanecek05 tables 6.1, 6.2] 68-186 tetrahedra a strip; others' methods 5-49.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "codecs/stripify/delaunay.h"
#include "codecs/stripify/random.h"
#include "codecs/stripify/stats.h"
#include "codecs/stripify/tetra_multi_path.h"
#include "converters/files.h"

#ifdef PSTRIPS_CGAL
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#endif

namespace pstrips {
namespace {

// Processor time of this program, so that others on the machine count less.
template <class Work>
double milliseconds(Work&& work) {
  const std::clock_t start = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::vector<double> random_points(Index count) {
  Random random(1);
  std::vector<double> out(std::size_t{3} * count);
  for (double& value : out) value = random.bits() * 0x1p-32 + random.bits() * 0x1p-64;
  return out;
}

std::vector<double> grid_points(Index side) {
  std::vector<double> out;
  for (Index i = 0; i < side * side; ++i)
    out.insert(out.end(), {560'000.0 + 30 * (i % side), 5'110'000.0 + 30 * (i / side), 0});
  return out;
}

// The least times of runs that take turns.
void print_points(const std::string& name, const std::vector<double>& positions) {
  double plain = HUGE_VAL, with_strips = HUGE_VAL, sgi = HUGE_VAL;
  const auto points = static_cast<Index>(positions.size() / 3);
  const int runs = points > 500'000 ? 5 : 15;
  StripStats stats, sgi_stats;
  for (int i = 0; i < runs; ++i) {
    std::vector<Index> triangles;
    Strips strips, sgi_strips;
    plain = std::min(plain, milliseconds([&] { triangles = delaunay_triangles(positions, {}); }));
    with_strips =
        std::min(with_strips, milliseconds([&] { strips = delaunay_strips(positions, {}); }));
    const StripInput input{.triangles = triangles, .group = {}, .wedge_count = points};
    sgi = std::min(
        sgi, milliseconds([&] { sgi_strips = find_stripifier("sgi-strips")->run(input, {}); }));
    stats = strip_stats(strips);
    sgi_stats = strip_stats(sgi_strips);
  }
  const auto triangles = static_cast<double>(stats.triangles);
  fmt::print(
      "| {} | {} | {} | {:.1f} | {:.1f} | {:.3f} | {:.1f} | {} | {:.3f} | {} | {:.3f} | {:.3f} |\n",
      name, points, stats.triangles, plain, with_strips, with_strips / plain, sgi, stats.strips,
      static_cast<double>(stats.strips) / points, sgi_stats.strips,
      static_cast<double>(stats.entries) / triangles,
      static_cast<double>(sgi_stats.entries) / triangles);
}

void print_point_tables(const std::vector<std::string>& files) {
  fmt::print(
      "| points | number | triangles | DT ms | DTS ms | DTS / DT | SGI ms | strips | a point | SGI "
      "strips | vertices a triangle | SGI |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Index count : {4'897u, 20'014u, 100'000u, 1'000'000u})
    print_points("random", random_points(count));
  print_points("grid", grid_points(316));
  for (const std::string& file : files) {
    auto loaded = load(file);
    if (!loaded || loaded->is_progressive()) continue;
    const auto model = std::move(*loaded).model();
    if (model && !model->meshes.empty())
      print_points(file.substr(file.rfind('/') + 1), positions_as_double(model->meshes[0]));
  }
}

void print_tetrahedra(const std::string& name, const TetraMesh& mesh) {
  for (const std::uint32_t effort : {0u, 1u, 10u}) {
    TetraStrips strips;
    const double time = milliseconds([&] {
      strips = tetra_multi_path(mesh.tetrahedra, mesh.vertex_count(), {.effort = effort});
    });
    const TetraStripStats stats = tetra_strip_stats(strips);
    const std::string fault = find_tetra_strip_fault(mesh.tetrahedra, strips);
    fmt::print("| {} | {} | {} | {} | {:.1f} | {} | {} | {:.1f} |{}\n", name, stats.tetrahedra,
               effort, stats.strips,
               static_cast<double>(stats.tetrahedra) / static_cast<double>(stats.strips),
               stats.longest, stats.singletons, time, fault);
  }
}

#ifdef PSTRIPS_CGAL
TetraMesh random_delaunay(Index count) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertices = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
  using Delaunay =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertices>>;
  TetraMesh mesh;
  mesh.positions = random_points(count);
  std::vector<std::pair<Kernel::Point_3, Index>> points;
  for (Index i = 0; i < count; ++i) {
    const double* p = mesh.positions.data() + std::size_t{3} * i;
    points.push_back({{p[0], p[1], p[2]}, i});
  }
  const Delaunay delaunay(points.begin(), points.end());
  for (const auto& cell : delaunay.finite_cell_handles())
    for (int i = 0; i < 4; ++i) mesh.tetrahedra.push_back(cell->vertex(i)->info());
  return mesh;
}
#endif

void print_tetra_tables(const std::vector<std::string>& files) {
  fmt::print(
      "\n| tetrahedra | number | effort | strips | a strip | longest | alone | ms |\n"
      "|---|---|---|---|---|---|---|---|\n");
#ifdef PSTRIPS_CGAL
  for (const Index count : {550u, 2'000u, 10'600u, 35'000u})
    print_tetrahedra(fmt::format("{} random points", count), random_delaunay(count));
#endif
  for (const std::string& file : files) {
    const auto bytes = read_file(file);
    if (!bytes || !holds_tetra_mesh(*bytes, file)) continue;
    if (const auto mesh = load_tetra_mesh(*bytes))
      print_tetrahedra(file.substr(file.rfind('/') + 1), *mesh);
  }
}

}  // namespace
}  // namespace pstrips

int main(int argc, char** argv) {
  const std::vector<std::string> files(argv + 1, argv + argc);
  pstrips::print_point_tables(files);
  pstrips::print_tetra_tables(files);
}
