// What batches of splits cost, in bits a vertex, and how quickly they are read: compact_bench
// [BITS] MODEL…. Positions on a grid of 2^BITS (12) steps on the longest side of the bounding box;
// the base is counted as it stands (three coordinates a vertex, three indices a triangle).

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

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

std::vector<Collapse> collapses_of(const GridMesh& mesh, std::uint64_t triangles) {
  std::vector<double> positions;
  for (const GridPoint& p : mesh.positions)
    positions.insert(positions.end(), {static_cast<double>(p.x), static_cast<double>(p.y),
                                       static_cast<double>(p.z)});
  SimplifyInput input;
  input.positions = positions;
  input.triangles = mesh.triangles;
  return simplify(input, {.target_triangles = triangles}).collapses;
}

void measure(const char* path, const Mesh& source, unsigned bits) {
  constexpr std::uint64_t kBaseTriangles = 200;
  constexpr int kRuns = 7;
  const GridMesh mesh = on_grid(source, bits);
  const std::vector<Collapse> collapses = collapses_of(mesh, kBaseTriangles);
  for (const Placement placement : {Placement::optimal, Placement::subset}) {
    SplitStreamMap map;
    const Clock::time_point start = Clock::now();
    const SplitStream stream = encode_splits(mesh, collapses, {.placement = placement}, &map);
    const double encoding = milliseconds_since(start);
    double decoding = std::numeric_limits<double>::max();
    for (int run = 0; run < kRuns; ++run) {
      const Clock::time_point from = Clock::now();
      auto decoder = SplitDecoder::start(placement, stream.base, stream.vertices, stream.triangles);
      for (const Bytes& batch : stream.batches)
        if (!decoder || !decoder->add(batch)) {
          fmt::print("{}: does not come back\n", path);
          return;
        }
      decoding = std::min(decoding, milliseconds_since(from));
      const GridMesh back = decoder->mesh();
      for (std::size_t v = 0; v < back.positions.size(); ++v)
        if (back.positions[v] != mesh.positions[map.vertex[v]]) {
          fmt::print("{}: comes back changed\n", path);
          return;
        }
    }
    std::size_t batch_bytes = 0;
    for (const Bytes& batch : stream.batches) batch_bytes += batch.size();
    const double vertices = static_cast<double>(mesh.positions.size());
    const double base_bits = 3.0 * bits * static_cast<double>(stream.base.positions.size()) +
                             static_cast<double>(stream.base.triangles.size()) *
                                 static_cast<double>(std::bit_width(stream.base.positions.size()));
    fmt::print("{},{},{},{},{},{},{:.3f},{:.3f},{:.2f},{:.2f},{:.2f}\n", path, bits,
               placement == Placement::optimal ? "optimal" : "subset", mesh.positions.size(),
               mesh.triangles.size() / 3, map.without_chord,
               8.0 * static_cast<double>(batch_bytes) / vertices, base_bits / vertices, encoding,
               decoding, static_cast<double>(mesh.triangles.size()) / 3000 / decoding);
  }
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) {
  unsigned bits = 12;
  fmt::print(
      "model,position_bits,placement,vertices,triangles,splits_without_chord,bits_a_vertex,"
      "base_bits_a_vertex,encoding_ms,decoding_ms,million_triangles_a_second\n");
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
