// What batches of splits cost, in bits a vertex, and how quickly they are read: compact_bench
// [BITS] MODEL…. Positions on a grid of 2^BITS (12) steps on the longest side of the bounding box;
// the base is counted as it stands (three coordinates a vertex, three indices a triangle). Orders:
// plain in small batches, what others are to be compared with; BatchSchedule's two; and the first
// of these with vertices that stand in the middle of what they become. RMS in steps of the grid.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "codecs/measure/measure.h"
#include "codecs/simplify/simplify.h"
#include "converters/files.h"
#include "core/mesh.h"
#include "tests/support/split_stream.h"

namespace pstrips::bench {
namespace {

using namespace test;

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The triangles of distinct vertices; vertices that none uses are left out.
GridMesh on_grid(const Mesh& mesh, unsigned bits) {
  const std::vector<double> positions = positions_as_double(mesh);
  std::vector<Index> number(mesh.vertex_count(), kNone), used;
  GridMesh out;
  const auto add = [&](Index a, Index b, Index c) {
    if (a == b || b == c || c == a) return;
    for (const Index v : {a, b, c}) {
      if (number[v] == kNone) {
        number[v] = static_cast<Index>(used.size());
        used.push_back(v);
      }
      out.triangles.push_back(number[v]);
    }
  };
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    for (std::size_t k = 2; k < face.size(); ++k)
      add(mesh.vertex_of(face[0]), mesh.vertex_of(face[k - 1]), mesh.vertex_of(face[k]));
  }
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const Index v : used)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], positions[std::size_t{3} * v + c]);
      high[c] = std::max(high[c], positions[std::size_t{3} * v + c]);
    }
  double side = 0;
  for (std::size_t c = 0; c < 3; ++c) side = std::max(side, high[c] - low[c]);
  const double scale = side > 0 ? ((1u << bits) - 1) / side : 0;
  for (const Index v : used) {
    const auto at = [&](std::size_t c) {
      return static_cast<std::int32_t>(
          std::lround((positions[std::size_t{3} * v + c] - low[c]) * scale));
    };
    out.positions.push_back({at(0), at(1), at(2)});
  }
  return out;
}

std::vector<double> as_double(const std::vector<GridPoint>& points) {
  std::vector<double> out;
  for (const GridPoint& p : points)
    out.insert(out.end(),
               {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  return out;
}

std::vector<Collapse> collapses_of(const GridMesh& mesh, CollapseOrder order, bool in_batches) {
  constexpr std::uint64_t kBaseTriangles = 200;
  const std::vector<double> positions = as_double(mesh.positions);
  SimplifyInput input;
  input.positions = positions;
  input.triangles = mesh.triangles;
  return simplify(input,
                  {.target_triangles = kBaseTriangles, .in_batches = in_batches, .order = order})
      .collapses;
}

/// Decodes; calls `level` with each mesh between two batches if it is given. False if it fails.
bool decode(const SplitStream& stream, const std::function<void(const GridMesh&)>& level = {}) {
  auto decoder =
      SplitDecoder::start(stream.placement, stream.base, stream.vertices, stream.triangles);
  if (!decoder) return false;
  if (level) level(decoder->mesh());
  for (const Bytes& batch : stream.batches) {
    if (!decoder->add(batch)) return false;
    if (level) level(decoder->mesh());
  }
  return true;
}

double fastest_decoding(const SplitStream& stream) {
  constexpr int kRuns = 7;
  double out = std::numeric_limits<double>::max();
  for (int run = 0; run < kRuns; ++run) {
    const Clock::time_point start = Clock::now();
    decode(stream);
    out = std::min(out, milliseconds_since(start));
  }
  return out;
}

/// The distance of levels with these shares of the vertices from the whole, in steps of the grid;
/// between two batches as if it were a power of the number of vertices.
std::array<double, 3> distances(const SplitStream& stream, const GridMesh& mesh) {
  constexpr std::array<double, 3> kShares = {0.5, 0.2, 0.05};
  constexpr std::uint64_t kSamples = 100'000;
  const std::vector<double> whole = as_double(mesh.positions);
  std::vector<std::array<double, 2>> known;  // logarithms: share, distance
  const double vertices = static_cast<double>(mesh.positions.size());
  decode(stream, [&](const GridMesh& level) {
    const double share = static_cast<double>(level.positions.size()) / vertices;
    if (share < kShares.back() / 2 || share > 0.95) return;
    const std::vector<double> positions = as_double(level.positions);
    const Distance d =
        measure_distance({whole, mesh.triangles}, {positions, level.triangles}, kSamples);
    known.push_back({std::log(share), std::log(std::max(d.rms, 1e-9))});
  });
  std::array<double, 3> out{};
  for (std::size_t k = 0; k < kShares.size(); ++k)
    for (std::size_t i = 1; i < known.size(); ++i) {
      const auto [x0, y0] = known[i - 1];
      const auto [x1, y1] = known[i];
      const double x = std::log(kShares[k]);
      if (x >= x0 && x <= x1) out[k] = std::exp(y0 + (y1 - y0) * (x - x0) / (x1 - x0));
    }
  return out;
}

struct Way {
  const char* name;
  CollapseOrder order;
  bool in_batches;
  BatchOptions options;
};

void measure(const char* path, const GridMesh& mesh, unsigned bits, const Way& way) {
  const std::vector<Collapse> collapses = collapses_of(mesh, way.order, way.in_batches);
  SplitStreamMap map;
  const Clock::time_point start = Clock::now();
  const SplitStream stream = encode_splits(mesh, collapses, way.options, &map);
  const double encoding = milliseconds_since(start);
  GridMesh back;
  if (!decode(stream, [&](const GridMesh& level) { back = level; })) {
    fmt::print("{}: does not come back\n", path);
    return;
  }
  for (std::size_t v = 0; v < back.positions.size(); ++v)
    if (back.positions[v] != mesh.positions[map.vertex[v]]) {
      fmt::print("{}: comes back changed\n", path);
      return;
    }
  std::size_t bytes = 0;
  for (const Bytes& batch : stream.batches) bytes += batch.size();
  const double vertices = static_cast<double>(mesh.positions.size());
  const double base_bits = 3.0 * bits * static_cast<double>(stream.base.positions.size()) +
                           static_cast<double>(stream.base.triangles.size()) *
                               static_cast<double>(std::bit_width(stream.base.positions.size()));
  const double decoding = fastest_decoding(stream);
  const auto [half, fifth, twentieth] = distances(stream, mesh);
  fmt::print("{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f},{:.2f},{:.2f}\n", path,
             bits, way.name, mesh.positions.size(), mesh.triangles.size() / 3, map.without_chord,
             8.0 * static_cast<double>(bytes) / vertices, base_bits / vertices, half, fifth,
             twentieth, encoding, decoding,
             static_cast<double>(mesh.triangles.size()) / 3000 / decoding);
}

void measure(const char* path, const Mesh& source, unsigned bits) {
  const GridMesh mesh = on_grid(source, bits);
  const BatchSchedule by_error = BatchSchedule::of(CollapseOrder::error),
                      by_bits = BatchSchedule::of(CollapseOrder::bits);
  constexpr BatchShares kFew = {0.05, 1};
  const Way kWays[] = {
      {"small batches", CollapseOrder::error, false, {.schedule = {kFew, kFew, kFew}, .window = 2}},
      {"error", CollapseOrder::error, true, {.schedule = by_error}},
      {"bits", CollapseOrder::bits, true, {.schedule = by_bits}},
      {"middle",
       CollapseOrder::error,
       true,
       {.placement = Placement::optimal, .schedule = by_error}},
  };
  for (const Way& way : kWays) measure(path, mesh, bits, way);
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) {
  unsigned bits = 12;
  fmt::print(
      "model,position_bits,order,vertices,triangles,splits_without_chord,bits_a_vertex,"
      "base_bits_a_vertex,rms_at_half,rms_at_fifth,rms_at_twentieth,encoding_ms,decoding_ms,"
      "million_triangles_a_second\n");
  for (int i = 1; i < argc; ++i) {
    if (const int number = std::atoi(argv[i]); number >= 8 && number <= 22) {
      bits = static_cast<unsigned>(number);
      continue;
    }
    auto file = pstrips::load(argv[i]);
    if (!file || file->is_progressive()) {
      fmt::print("{}: no model\n", argv[i]);
      return 1;
    }
    for (const pstrips::Mesh& mesh : std::get<pstrips::Model>(file->content).meshes)
      pstrips::bench::measure(argv[i], mesh, bits);
  }
}
