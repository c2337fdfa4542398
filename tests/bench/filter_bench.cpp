// What a renderer is sent while a mesh is refined from 5 % of its triangles: vertices of individual
// triangles (progressive mesh), of unfiltered strips, and of the display filters, and their time.
// [Kim04 §5, table 2 and figure 9]

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "codecs/filter/display_strips.h"
#include "codecs/filter/restrip.h"
#include "codecs/simplify/simplify.h"
#include "codecs/stripify/stripify.h"
#include "codecs/vsplit/level.h"
#include "codecs/vsplit/record.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

constexpr Index kLevels = 20;

ProgressiveMesh progressive(const Mesh& mesh, const NamedStripifier& stripifier) {
  const test::StripMesh triangles = test::strip_mesh(mesh);
  StripMap strips{stripifier.run(triangles.input(), {}), {}};
  strips.group_entries = {static_cast<Index>(strips.entries.size())};
  const std::vector<double> positions = positions_as_double(mesh);
  const SimplifyInput input{positions, mesh.wedge_vertex, triangles.triangles, triangles.group, {},
                            0};
  const auto sequence = simplify(input, {.target_triangles = triangles.triangles.size() / 60});
  return record(mesh, strips, sequence, MapEncoding::naive).mesh;
}

struct Snapshot {
  std::vector<Index> map;  // resolved
  Index triangles = 0;
};

// Levels at equal steps of vsplits, from the base to full resolution.
std::vector<Snapshot> snapshots(const ProgressiveMesh& mesh) {
  std::vector<Snapshot> out;
  Level level(mesh);
  for (Index i = 0;; ++i) {
    Snapshot snapshot{{level.resolved().begin(), level.resolved().end()}, 0};
    for_each_triangle(
        level.resolved(), [](Index w) { return w; },
        [&](Index, Index, Index) { ++snapshot.triangles; });
    out.push_back(std::move(snapshot));
    if (i == kLevels) return out;
    level.refine(static_cast<Index>(mesh.vsplits.size() * (i + 1) / kLevels) -
                 level.vsplits_done());
  }
}

using MakeDisplay = std::function<DisplayStrips(const Snapshot&)>;

void run(benchmark::State& state, const std::vector<Snapshot>& levels, const MakeDisplay& filter) {
  double vertices = 0, indices = 0, triangles = 0, base_vertices = 0;
  for (const Snapshot& level : levels) {
    const DisplayCost cost = display_cost(filter(level));
    const auto sent = static_cast<double>(cost.vertices_sent);
    if (triangles == 0) base_vertices = sent;
    vertices += sent;
    indices += sent + static_cast<double>(cost.restarts);
    triangles += level.triangles;
  }
  for (auto _ : state)
    for (const Snapshot& level : levels) benchmark::DoNotOptimize(filter(level));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles));
  state.counters["vertices_per_triangle"] = vertices / triangles;
  state.counters["indices_per_triangle"] = indices / triangles;
  state.counters["saved_percent"] = 100 - 100 * vertices / (3 * triangles);
  state.counters["base_saved_percent"] = 100 - 100 * base_vertices / (3.0 * levels[0].triangles);
}

void add_model(const std::string& model, const Mesh& mesh) {
  for (const NamedStripifier& stripifier : stripifiers()) {
    const auto levels =
        std::make_shared<std::vector<Snapshot>>(snapshots(progressive(mesh, stripifier)));
    const auto add = [&](std::string_view filter_name, const MakeDisplay& filter) {
      const std::string name =
          model + "/" + std::string(stripifier.name) + "/" + std::string(filter_name);
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        run(state, *levels, filter);
      })->Unit(benchmark::kMillisecond);
    };
    for (const NamedFilter& filter : display_filters())
      add(filter.name,
          [=](const Snapshot& level) { return filter_strips(level.map, {}, filter.filter); });
    add("restrip", [](const Snapshot& level) { return restrip(level.map, {}); });
  }
}

// Only meshes of one wedge a vertex and one group.
void add_models() {
  const auto cow = test::model_mesh("classic/cow.obj"),
             bunny = test::model_mesh("classic/bun_zipper.ply");
  if (cow) add_model("cow", *cow);
  if (bunny) add_model("bunny", *bunny);
  if (!cow && !bunny) add_model("grid", test::grid(100));
}

}  // namespace
}  // namespace pstrips

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  pstrips::add_models();
  benchmark::RunSpecifiedBenchmarks();
}
