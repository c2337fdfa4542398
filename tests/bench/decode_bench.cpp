// How fast a decoder is: vsplits applied from memory, a whole file fed to the streaming decoder,
// one filter pass over all strips. Bunny and Igea of the models folder, else a torus. [Kim04 §5,
// tables 1 and 3]

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "codecs/filter/display_strips.h"
#include "codecs/vsplit/level.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/stream_decoder.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"

namespace pstrips {
namespace {

struct Sample {
  ProgressiveStrips strips;
  Bytes file;
  const ProgressiveMesh& mesh() const { return strips.meshes[0]; }
  std::int64_t vsplits() const { return static_cast<std::int64_t>(mesh().vsplits.size()); }
};

bool shows_all_triangles(const Sample& sample, const Level& level) {
  Index triangles = 0;
  for_each_triangle(
      level.resolved(), [&](Index w) { return level.vertex_of(w); },
      [&](Index, Index, Index) { ++triangles; });
  return triangles == sample.mesh().triangles;
}

/// The state machine alone: records in memory, base to full resolution.
void refine(benchmark::State& state, const Sample& sample) {
  Level checked(sample.mesh());
  checked.refine_fully();
  if (!shows_all_triangles(sample, checked)) return state.SkipWithError("triangles are missing");
  for (auto _ : state) {
    state.PauseTiming();
    Level level(sample.mesh());
    state.ResumeTiming();
    level.refine_fully();
    benchmark::DoNotOptimize(level.resolved().data());
  }
  state.SetItemsProcessed(state.iterations() * sample.vsplits());  // vsplits/s
  state.counters["map_offsets_per_vsplit"] =
      static_cast<double>(sample.mesh().map_offsets.size()) / static_cast<double>(sample.vsplits());
}

/// Bytes to the full level: parsing, checksums, checks, vsplits; `slice` bytes a call, 0 is all at
/// once. With `update` display strips are rebuilt after each call.
void feed(benchmark::State& state, const Sample& sample, std::size_t slice, bool update) {
  const ByteView file = sample.file;
  if (slice == 0) slice = file.size();
  for (auto _ : state) {
    StreamDecoder decoder;
    for (std::size_t at = 0; at < file.size(); at += slice) {
      if (!decoder.feed(file.subspan(at, std::min(slice, file.size() - at))))
        return state.SkipWithError("the file is refused");
      if (update) decoder.update();
    }
    if (!decoder.complete()) return state.SkipWithError("the file is not complete");
    benchmark::DoNotOptimize(decoder.totals());
  }
  state.SetItemsProcessed(state.iterations() * sample.vsplits());  // vsplits/s
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(file.size()));
  state.counters["bytes_per_vertex"] =
      static_cast<double>(file.size()) / static_cast<double>(sample.mesh().vertices);
}

/// Bytes to a mesh.
void read_and_decode(benchmark::State& state, const Sample& sample) {
  for (auto _ : state) {
    const auto strips = read_binary(sample.file);
    const auto model = decode(strips.value());
    if (!model) return state.SkipWithError("does not decode");
    benchmark::DoNotOptimize(model->meshes[0].corners.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sample.mesh().triangles));
}

/// One pass over the strips of a level, `percent` of the way from the base to full resolution.
void filter(benchmark::State& state, const Sample& sample, Filter filter_by, Index percent) {
  Level level(sample.mesh());
  level.refine(static_cast<Index>(sample.mesh().vsplits.size() * percent / 100));
  std::int64_t triangles = 0;
  for_each_triangle(
      level.resolved(), [&](Index w) { return level.vertex_of(w); },
      [&](Index, Index, Index) { ++triangles; });
  DisplayStrips display;
  for (auto _ : state) {
    display = filter_strips(level.resolved(), level.wedge_vertices(), filter_by);
    benchmark::DoNotOptimize(display.data());
  }
  state.SetItemsProcessed(state.iterations() * triangles);
  state.counters["sent_per_triangle"] = static_cast<double>(display_cost(display).vertices_sent) /
                                        static_cast<double>(std::max<std::int64_t>(triangles, 1));
}

template <class Run>
void add(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
}

void add_model(const std::string& name, const Mesh& mesh) {
  Model model;
  model.meshes = {mesh};
  for (const MapEncoding encoding : {MapEncoding::naive, MapEncoding::offset}) {
    const auto sample = std::make_shared<Sample>();
    sample->strips = encode(model, {.encoding = encoding}).value();
    sample->file = write_binary(sample->strips).value();
    const std::string start = name + (encoding == MapEncoding::naive ? "/naive/" : "/offset/");
    add(start + "refine", [=](benchmark::State& s) { refine(s, *sample); });
    add(start + "feed", [=](benchmark::State& s) { feed(s, *sample, 0, false); });
    add(start + "feed/slice:16384", [=](benchmark::State& s) { feed(s, *sample, 16384, false); });
    add(start + "feed/slice:16384/update",
        [=](benchmark::State& s) { feed(s, *sample, 16384, true); });
    add(start + "read_and_decode", [=](benchmark::State& s) { read_and_decode(s, *sample); });
    if (encoding == MapEncoding::naive) continue;  // filters see resolved entries
    for (const char* filter_name : {"stss", "dtfs"})
      for (const Index percent : {0u, 50u, 100u})
        add(name + "/" + filter_name + "/level:" + std::to_string(percent),
            [=](benchmark::State& s) {
              filter(s, *sample, *find_display_filter(filter_name), percent);
            });
  }
}

void add_models() {
  const auto bunny = test::model_mesh("classic/bun_zipper.ply");
  const auto igea = test::model_mesh("classic/igea.ply");
  if (bunny) add_model("bunny", *bunny);
  if (igea) add_model("igea", *igea);
  if (!bunny && !igea) add_model("torus", test::torus(200, 170));
}

}  // namespace
}  // namespace pstrips

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  pstrips::add_models();
  benchmark::RunSpecifiedBenchmarks();
}
