// What the derived strips of levels cost, as CSV: derived_bench [MODEL …], paths in the folder of
// models. A row a batch from 1 % of the triangles on; the best of five times.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "codecs/compact/record_batches.h"
#include "codecs/filter/derived_strips.h"
#include "codecs/filter/restrip.h"
#include "codecs/simplify/simplify.h"
#include "tests/support/models.h"

namespace pstrips::bench {
namespace {

using Clock = std::chrono::steady_clock;

BatchRecording batches_of(const Mesh& mesh) {
  const Triangulation triangles = triangulate(mesh);
  std::vector<Index> group;
  for (const Index face : triangles.face) group.push_back(mesh.group_of(face));
  const std::vector<double> positions = positions_as_double(mesh);
  SimplifyInput input;
  input.positions = positions;
  input.wedge_vertex = mesh.wedge_vertex;
  input.triangles = triangles.corners;
  input.group = group;
  return record_batches(mesh, triangles, simplify(input, {.target_triangles = 200}));
}

void measure(const std::string& model, const Level& level) {
  const auto triangles = static_cast<double>(level.resolved().size()) / 3;
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
  fmt::print("{},{:.1f},{},{},{:.4f},{:.1f},{:.4f}\n", model,
             100 * triangles / level.mesh().triangles, triangles, display_cost(strips).restarts + 1,
             static_cast<double>(strips.size()) / triangles, best / triangles,
             static_cast<double>(slow.size()) / triangles);
}

void run(const std::string& model, const Mesh& mesh) {
  const BatchRecording batches = batches_of(mesh);
  Level level(batches.recording.mesh);
  for (const Index vsplits : batches.batches) {
    level.refine(vsplits);
    if (level.resolved().size() > 3 * std::size_t{level.mesh().triangles} / 100)
      measure(model, level);
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
