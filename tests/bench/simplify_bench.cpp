// Simplification to 5 % of the triangles: ours beside meshopt_simplify and OpenMesh's quadric
// decimater, both half-edge collapses too. Counters: RMS and Hausdorff distance to the original in
// 1e-4 of the bounding box's diagonal, triangles left, and nanoseconds of processor a collapse.

#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "codecs/measure/measure.h"
#include "codecs/simplify/simplify.h"
#include "codecs/triangulate/triangulate.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"

namespace pstrips {
namespace {

struct Task {
  std::vector<double> positions;
  std::vector<float> float_positions;  // for the peers
  std::vector<Index> triangles;        // vertices
  std::uint64_t target = 0;
};

Task task_of(const Mesh& mesh) {
  Task task;
  const std::vector<double> positions = positions_as_double(mesh);
  // Peers do not care for vertices outside all triangles.
  std::vector<Index> renamed(mesh.vertex_count(), kNone);
  for (const Index w : triangulate(mesh).corners) {
    Index& v = renamed[mesh.vertex_of(w)];
    if (v == kNone) {
      v = static_cast<Index>(task.positions.size() / 3);
      const auto* p = &positions[std::size_t{3} * mesh.vertex_of(w)];
      task.positions.insert(task.positions.end(), p, p + 3);
    }
    task.triangles.push_back(v);
  }
  for (const double x : task.positions) task.float_positions.push_back(static_cast<float>(x));
  task.target = task.triangles.size() / 3 / 20;
  return task;
}

// A way to simplify: what runs inside the timed loop, and the vertex triangles that it gives.
struct Contender {
  const char* name;
  std::function<void(const Task&, benchmark::State&, std::vector<Index>& result)> run;
};

void run_ours(const Task& task, benchmark::State& state, std::vector<Index>& result) {
  CollapseSequence sequence;
  for (auto _ : state) {
    const SimplifyInput input{task.positions, {}, task.triangles, {}, {}, 0};
    sequence = simplify(input, {.target_triangles = task.target});
    benchmark::DoNotOptimize(sequence.collapses.data());
  }
  std::vector<Index> stands_for(task.positions.size() / 3);
  std::iota(stands_for.begin(), stands_for.end(), Index{0});
  for (auto c = sequence.collapses.rbegin(); c != sequence.collapses.rend(); ++c)
    stands_for[c->removed] = stands_for[c->kept];
  for (std::size_t t = 0; t < task.triangles.size(); t += 3) {
    const Index a = stands_for[task.triangles[t]], b = stands_for[task.triangles[t + 1]],
                c = stands_for[task.triangles[t + 2]];
    if (a != b && b != c && a != c) result.insert(result.end(), {a, b, c});
  }
}

void run_meshopt(const Task& task, benchmark::State& state, std::vector<Index>& result) {
  std::size_t size = 0;
  for (auto _ : state) {
    result.resize(task.triangles.size());
    size = meshopt_simplify(result.data(), task.triangles.data(), task.triangles.size(),
                            task.float_positions.data(), task.float_positions.size() / 3,
                            3 * sizeof(float), 3 * task.target, std::numeric_limits<float>::max(),
                            0, nullptr);
    benchmark::DoNotOptimize(result.data());
  }
  result.resize(size);
}

void run_openmesh(const Task& task, benchmark::State& state, std::vector<Index>& result) {
  using Peer = OpenMesh::TriMesh_ArrayKernelT<>;
  for (auto _ : state) {
    state.PauseTiming();
    Peer mesh;
    for (std::size_t i = 0; i < task.float_positions.size(); i += 3)
      mesh.add_vertex(
          {task.float_positions[i], task.float_positions[i + 1], task.float_positions[i + 2]});
    const auto vertex = [](Index v) { return Peer::VertexHandle(static_cast<int>(v)); };
    for (std::size_t t = 0; t < task.triangles.size(); t += 3)
      mesh.add_face(vertex(task.triangles[t]), vertex(task.triangles[t + 1]),
                    vertex(task.triangles[t + 2]));
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    state.ResumeTiming();

    OpenMesh::Decimater::DecimaterT<Peer> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<Peer>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, task.target);

    state.PauseTiming();
    result.clear();
    for (const auto face : mesh.faces())  // handles of the source's vertices still
      for (const auto corner : mesh.fv_range(face))
        result.push_back(static_cast<Index>(corner.idx()));
    state.ResumeTiming();
  }
}

void measure(benchmark::State& state, const Task& task, const std::vector<Index>& result) {
  const double diagonal = bounding_box_diagonal(task.positions);
  const Distance d = measure_distance({task.positions, task.triangles}, {task.positions, result});
  state.counters["rms_1e4"] = d.rms / diagonal * 1e4;
  state.counters["hausdorff_1e4"] = d.hausdorff / diagonal * 1e4;
  state.counters["triangles_left"] = static_cast<double>(result.size() / 3);
  // A collapse of a closed mesh removes two triangles.
  const double collapses = static_cast<double>(task.triangles.size() - result.size()) / 6;
  state.counters["collapses"] =
      benchmark::Counter(collapses, benchmark::Counter::kIsIterationInvariantRate);
}

void add_task(const std::string& model, const Mesh& mesh) {
  const auto task = std::make_shared<const Task>(task_of(mesh));
  static const Contender kContenders[] = {
      {"ours", run_ours}, {"meshopt_simplify", run_meshopt}, {"openmesh_decimater", run_openmesh}};
  for (const Contender& contender : kContenders)
    benchmark::RegisterBenchmark((model + "/" + contender.name).c_str(),
                                 [task, &contender](benchmark::State& state) {
                                   std::vector<Index> result;
                                   contender.run(*task, state, result);
                                   measure(state, *task, result);
                                 })
        ->Unit(benchmark::kMillisecond);
}

void add_tasks() {
  const std::pair<const char*, const char*> kModels[] = {{"bunny", "classic/bun_zipper.ply"},
                                                         {"horse", "classic/horse.ply"},
                                                         {"igea", "classic/igea.ply"},
                                                         {"fandisk", "classic/fandisk.obj"}};
  bool any = false;
  for (const auto& [name, path] : kModels) {
    const auto mesh = test::model_mesh(path);
    if (!mesh) continue;
    any = true;
    add_task(name, *mesh);
  }
  if (!any) add_task("torus", test::torus(400, 200));
}

}  // namespace
}  // namespace pstrips

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  pstrips::add_tasks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
