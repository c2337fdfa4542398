// Where the time of `pstrips convert` goes, stage by stage, beside meshopt_simplify to the same 5 %
// of the triangles. Markdown on standard output.
//
//   convert_bench [--rounds N] [FILE …]     files with one mesh; without: three models and a grid

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "codecs/measure/mesh_statistics.h"
#include "codecs/simplify/simplify.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/faces.h"
#include "codecs/vsplit/record.h"
#include "converters/encode.h"
#include "converters/files.h"
#include "converters/level_bounds.h"
#include "converters/level_cost.h"
#include "converters/strip_mesh.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/payload/digest.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"

namespace pstrips {
namespace {

struct Time {
  double cpu = std::numeric_limits<double>::max();  // milliseconds, of all threads
  double wall = cpu;
};

template <class Work>
Time timed(Work&& work) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  work();
  return {
      1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall).count()};
}

// Stages in the order in which they ended first, each with the best of its rounds.
class Stages {
 public:
  template <class Work>
  void run(std::string_view name, Work&& work) {
    const Time time = timed(work);
    auto at = std::ranges::find(rows_, name, &Row::name);
    if (at == rows_.end()) at = rows_.insert(at, {std::string(name), {}});
    at->best.cpu = std::min(at->best.cpu, time.cpu);
    at->best.wall = std::min(at->best.wall, time.wall);
  }

  Time operator[](std::string_view name) const {
    return std::ranges::find(rows_, name, &Row::name)->best;
  }

  void print(double triangles, std::string_view yardstick) const {
    const double unit = (*this)[yardstick].cpu;
    fmt::print("| | cpu, ms | wall, ms | cpu, ns a triangle | cpu / {} |\n", yardstick);
    fmt::print("|---|---:|---:|---:|---:|\n");
    for (const Row& row : rows_)
      fmt::print("| {} | {:.1f} | {:.1f} | {:.0f} | {:.2f} |\n", row.name, row.best.cpu,
                 row.best.wall, 1e6 * row.best.cpu / triangles, row.best.cpu / unit);
  }

 private:
  struct Row {
    std::string name;
    Time best;
  };
  std::vector<Row> rows_;
};

constexpr std::string_view kPeer = "meshopt_simplify";

void run_peer(const std::vector<float>& positions, const std::vector<Index>& triangles) {
  std::vector<Index> result(triangles.size());
  const std::size_t target = triangles.size() / 3 / 20 * 3;
  meshopt_simplify(result.data(), triangles.data(), triangles.size(), positions.data(),
                   positions.size() / 3, 3 * sizeof(float), target,
                   std::numeric_limits<float>::max(), 0, nullptr);
}

// One after the other, in one thread, as encode() does with the default options.
void run_stages(const std::string& input, Stages& stages) {
  Result<LoadedFile> file;
  stages.run("read", [&] { file = load(input); });
  const Model& model = std::get<Model>(file->content);
  const Mesh& mesh = model.meshes.front();
  stages.run("statistics", [&] { mesh_statistics(mesh); });
  Triangulation triangles;
  std::vector<double> positions;
  stages.run("triangulate", [&] {
    triangles = triangulate(mesh);
    positions = positions_as_double(mesh);
  });
  const std::vector<float> float_positions(positions.begin(), positions.end());
  std::vector<Index> vertices;
  for (const Index w : triangles.corners) vertices.push_back(mesh.vertex_of(w));
  stages.run(kPeer, [&] { run_peer(float_positions, vertices); });
  CollapseSequence sequence;
  stages.run("simplify", [&] {
    sequence = simplify({.positions = positions,
                         .wedge_vertex = mesh.wedge_vertex,
                         .triangles = triangles.corners,
                         .group = {},
                         .attributes = {},
                         .attribute_count = 0},
                        {.target_triangles = triangles.face.size() / 20});
  });
  stages.run("bounds", [&] { level_bounds(mesh, triangles, sequence); });
  std::vector<std::uint8_t> cost;
  stages.run("level cost",
             [&] { cost = level_step_cost(vertices, mesh.vertex_count(), sequence.collapses, 1); });
  StripMap strips;
  stages.run("strips",
             [&] { strips = strip_mesh(mesh, triangles, *find_stripifier("best"), {}, cost); });
  Recording recording;
  stages.run("record", [&] { recording = record(mesh, strips, sequence, MapEncoding::offset); });
  stages.run("faces", [&] {
    recording.mesh.faces = record_faces(mesh, triangles, strips, recording, false).faces;
  });
  stages.run("digest", [&] { digest(mesh_to_decode(mesh, strips, recording)); });
}

void run_convert(const std::string& input, const std::string& output, unsigned threads,
                 Stages& stages) {
  const Result<LoadedFile> file = load(input);
  const auto strips = encode(std::get<Model>(file->content), {.threads = threads});
  stages.run("write", [&] { (void)save(*strips, output, FileFormat::pstrip); });
}

void measure(const std::string& name, const Mesh& source, int rounds) {
  const auto folder = std::filesystem::temp_directory_path() / "pstrips_convert_bench";
  std::filesystem::create_directories(folder);
  const std::string input = (folder / "plain.ply").string(),
                    output = (folder / "out.pstrip").string();
  Model model;
  model.meshes.push_back(source);
  keep_attributes(model, {});
  if (const auto saved = save(model, input, FileFormat::ply); !saved) {
    fmt::print(stderr, "{}: {}\n", name, saved.error().message);
    return;
  }
  const double triangles = static_cast<double>(triangulate(model.meshes.front()).face.size());
  model = {};
  Stages stages;
  for (int round = 0; round < rounds; ++round) {
    run_stages(input, stages);
    stages.run("convert, 1 thread", [&] { run_convert(input, output, 1, stages); });
    stages.run("convert, 2 threads", [&] { run_convert(input, output, 2, stages); });
  }
  fmt::print("## {}: {:.0f} triangles\n\n", name, triangles);
  stages.print(triangles, kPeer);
  const double peer = stages[kPeer].cpu;
  fmt::print("\nsimplify + record {:.2f}, convert {:.2f} in one thread, {:.2f} of wall in two\n\n",
             (stages["simplify"].cpu + stages["record"].cpu) / peer,
             stages["convert, 1 thread"].cpu / peer,
             stages["convert, 2 threads"].wall / stages[kPeer].wall);
  std::filesystem::remove_all(folder);
}

void measure_all(int rounds) {
  const std::pair<const char*, const char*> kModels[] = {{"bunny", "classic/bun_zipper.ply"},
                                                         {"horse", "classic/horse.ply"},
                                                         {"igea", "classic/igea.ply"}};
  for (const auto& [name, path] : kModels)
    if (const auto mesh = test::model_mesh(path)) measure(name, *mesh, rounds);
  measure("grid", test::grid(838), rounds);
}

}  // namespace
}  // namespace pstrips

int main(int argc, char** argv) {
  int rounds = 5;
  bool any = false;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--rounds" && i + 1 < argc) {
      const std::string_view number = argv[++i];
      std::from_chars(number.data(), number.data() + number.size(), rounds);
      continue;
    }
    any = true;
    const auto file = pstrips::load(argv[i]);
    if (!file || file->is_progressive()) {
      fmt::print(stderr, "cannot read {}\n", argument);
      return 1;
    }
    pstrips::measure(argv[i], std::get<pstrips::Model>(file->content).meshes.front(), rounds);
  }
  if (!any) pstrips::measure_all(rounds);
}
