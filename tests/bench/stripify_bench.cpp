// Strips of real models: every algorithm and two peers, quality beside speed. Without the folder
// of models a torus takes their place.

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>

#include "codecs/stripify/stats.h"
#include "codecs/stripify/stripify.h"
#include "tests/bench/peers/peers.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/strip_check.h"

namespace pstrips::bench {
namespace {

using test::StripMesh;

void run(benchmark::State& state, const StripMesh& mesh, const std::function<Strips()>& stripify,
         bool covers_once) {
  Strips strips = stripify();
  if (covers_once && !test::find_strip_fault(mesh.input(), strips).empty())
    return state.SkipWithError("the strips do not cover the mesh");
  for (auto _ : state) {
    strips = stripify();
    benchmark::DoNotOptimize(strips.data());
  }
  const StripStats stats = strip_stats(strips);
  const auto triangles = static_cast<double>(stats.triangles);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stats.triangles));
  state.counters["triangles"] = triangles;
  state.counters["strips"] = static_cast<double>(stats.strips);
  state.counters["singletons"] = static_cast<double>(stats.singletons);
  state.counters["swaps"] = static_cast<double>(stats.swaps);
  state.counters["indices_per_triangle"] = static_cast<double>(stats.indices_sent) / triangles;
  state.counters["acmr16"] = stats.acmr16;
}

void add(const std::string& name, const std::shared_ptr<StripMesh>& mesh,
         std::function<Strips()> stripify, bool covers_once) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    run(state, *mesh, stripify, covers_once);
  })->Unit(benchmark::kMillisecond);
}

void add_model(const std::string& model, const Mesh& source) {
  const auto mesh = std::make_shared<StripMesh>(test::strip_mesh(source));
  for (const NamedStripifier& peer : peer_stripifiers())
    add(
        model + "/" + std::string(peer.name), mesh, [=] { return peer.run(mesh->input(), {}); },
        false);
  for (const NamedStripifier& stripifier : stripifiers())
    add(
        model + "/" + std::string(stripifier.name), mesh,
        [=] { return stripifier.run(mesh->input(), {}); }, true);
  for (const std::uint32_t effort : {20u, kEffortHigh, kEffortMax})
    add(
        model + "/best/effort:" + std::to_string(effort), mesh,
        [=] { return find_stripifier("best")->run(mesh->input(), {.effort = effort}); }, true);
  for (const std::uint32_t effort : {20u, kEffortHigh, kEffortMax}) {
    const StripOptions options{.goal = StripGoal::strips, .effort = effort};
    add(
        model + "/best-few-strips/effort:" + std::to_string(effort), mesh,
        [=] { return find_stripifier("best")->run(mesh->input(), options); }, true);
  }
}

void add_models() {
  constexpr std::pair<const char*, const char*> kModels[] = {
      {"cow", "classic/cow.obj"},
      {"bunny", "classic/bun_zipper.ply"},
      {"horse", "classic/horse.ply"},
      {"igea", "classic/igea.ply"},
      {"rocker-arm", "classic/rocker-arm.obj"},
      {"nefertiti", "classic/nefertiti.obj"}};
  bool found = false;
  for (const auto& [name, path] : kModels)
    if (const auto mesh = test::model_mesh(path)) {
      add_model(name, *mesh);
      found = true;
    }
  if (!found) add_model("torus", test::torus(200, 170));
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  pstrips::bench::add_models();
  benchmark::RunSpecifiedBenchmarks();
}
