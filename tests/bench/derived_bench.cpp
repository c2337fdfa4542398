// What the derived strips of levels cost, as CSV: derived_bench [MODEL …], paths in the folder of
// models. The map grows in the order of the collapses; the best of five times.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "codecs/filter/derived_strips.h"
#include "codecs/filter/restrip.h"
#include "codecs/simplify/simplify.h"
#include "codecs/vsplit/record.h"
#include "tests/support/growing.h"
#include "tests/support/models.h"
#include "tests/support/strip_check.h"

namespace pstrips::bench {
namespace {

constexpr int kPercents[] = {5, 20, 50, 100};  // of the triangles

using Clock = std::chrono::steady_clock;

ProgressiveMesh progressive(const Mesh& mesh) {
  const test::StripMesh triangles = test::strip_mesh(mesh);
  StripMap strips;
  for (std::size_t i = 0; i < triangles.triangles.size(); ++i) {
    if (i > 0 && i % 3 == 0) strips.entries.push_back(kRestart);
    strips.entries.push_back(triangles.triangles[i]);
  }
  strips.group_entries = {static_cast<Index>(strips.entries.size())};
  const std::vector<double> positions = positions_as_double(mesh);
  SimplifyInput input;
  input.positions = positions;
  input.wedge_vertex = mesh.wedge_vertex;
  input.triangles = triangles.triangles;
  const auto sequence = simplify(input, {.target_triangles = triangles.triangles.size() / 300});
  return test::growing(record(mesh, strips, sequence, MapEncoding::naive).mesh);
}

double indices_a_triangle(const DisplayStrips& strips, Index triangles) {
  return static_cast<double>(strips.size()) / triangles;
}

void measure(const std::string& model, const Level& level, int percent) {
  const auto triangles = static_cast<Index>(level.resolved().size() / 3);
  double best = std::numeric_limits<double>::max();
  DisplayStrips strips;
  for (int run = 0; run < 5; ++run) {
    const Clock::time_point start = Clock::now();
    strips = derive_strips(level.view());
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  std::vector<Index> single;
  for_each_triangle(level.view(), [&](Index a, Index b, Index c, Index) {
    single.insert(single.end(), {a, b, c, kRestart});
  });
  const DisplayStrips slow = restrip(single, level.wedge_vertices());
  fmt::print("{},{},{},{},{:.4f},{:.1f},{:.4f}\n", model, percent, triangles,
             display_cost(strips).restarts + 1, indices_a_triangle(strips, triangles),
             best / triangles, indices_a_triangle(slow, triangles));
}

void run(const std::string& model, const Mesh& mesh) {
  const ProgressiveMesh growing = progressive(mesh);
  Level level(growing);
  for (const int percent : kPercents) {
    while (level.resolved().size() < std::size_t{3} * growing.triangles * percent / 100)
      level.refine(1);
    measure(model, level, percent);
  }
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) {
  std::vector<std::string> models(argv + 1, argv + argc);
  if (models.empty()) models = {"classic/bun_zipper.ply", "classic/horse.ply", "classic/igea.ply"};
  fmt::print(
      "model,percent,triangles,strips,indices_a_triangle,ns_a_triangle,restrip_indices_a_"
      "triangle\n");
  for (const std::string& model : models)
    if (const auto mesh = pstrips::test::model_mesh(model)) pstrips::bench::run(model, *mesh);
}
