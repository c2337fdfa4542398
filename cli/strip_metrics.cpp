#include "cli/strip_metrics.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "codecs/stripify/check.h"
#include "codecs/stripify/delaunay.h"
#include "converters/strip_mesh.h"

namespace pstrips::cli {
namespace {

std::string find_fault(const Mesh& mesh, const StripMap& map) {
  const Triangulation triangles = triangulate(mesh);
  std::vector<Index> group;
  for (const Index face : triangles.face) group.push_back(mesh.group_of(face));
  return find_strip_fault(StripInput{.triangles = triangles.corners,
                                     .group = group,
                                     .wedge_count = static_cast<Index>(mesh.wedge_count())},
                          map.entries);
}

std::string find_polygon_fault(const Mesh& mesh, const StripMap& map) {
  const StrippableFaces faces = strippable_faces(mesh);
  return find_polygon_strip_fault(
      PolygonInput{.corners = faces.corners,
                   .face_first = faces.face_first,
                   .group = faces.group,
                   .wedge_count = static_cast<Index>(mesh.wedge_count())},
      map.entries);
}

std::vector<double> wedge_positions(const Mesh& mesh) {
  std::vector<double> positions = positions_as_double(mesh);
  if (mesh.wedge_vertex.empty()) return positions;
  std::vector<double> out;
  for (const Index v : mesh.wedge_vertex) {
    const auto at = positions.begin() + 3 * std::ptrdiff_t{v};
    out.insert(out.end(), at, at + 3);
  }
  return out;
}

std::string find_point_fault(std::span<const double> positions, const Strips& strips,
                             const StripOptions& options) {
  const std::vector<Index> triangles = delaunay_triangles(positions, options);
  return find_strip_fault(StripInput{.triangles = triangles,
                                     .group = {},
                                     .wedge_count = static_cast<Index>(positions.size() / 3)},
                          strips);
}

class Stopwatch {
 public:
  void add_to(StripMetrics& metrics) const {
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - wall_;
    metrics.milliseconds += time.count();
    metrics.cpu_milliseconds += 1e3 * static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

void add(StripStats& sum, const StripStats& stats) {
  const double misses = sum.acmr16 * static_cast<double>(sum.triangles) +
                        stats.acmr16 * static_cast<double>(stats.triangles);
  sum.triangles += stats.triangles;
  sum.strips += stats.strips;
  sum.singletons += stats.singletons;
  sum.swaps += stats.swaps;
  sum.entries += stats.entries;
  sum.indices_sent += stats.indices_sent;
  sum.acmr16 = sum.triangles == 0 ? 0 : misses / static_cast<double>(sum.triangles);
}

}  // namespace

StripMetrics measure_strips(const Model& model, const NamedStripifier& stripifier,
                            const StripOptions& options, const HeapMeter& heap,
                            std::vector<StripMap>* maps) {
  StripMetrics out;
  for (const Mesh& mesh : model.meshes) {
    if (heap) heap.start();
    const Stopwatch stopwatch;
    StripMap map = strip_faces(mesh, stripifier, options);
    stopwatch.add_to(out);
    if (heap) out.peak_bytes = std::max(out.peak_bytes, heap.peak());
    add(out.stats, strip_stats(map.entries));
    // With diagonals of its own the strips have other triangles than the triangulation.
    const bool free_diagonals = stripifier.run_polygons && !mesh.face_first.empty();
    if (out.fault.empty())
      out.fault = free_diagonals ? find_polygon_fault(mesh, map) : find_fault(mesh, map);
    if (maps) maps->push_back(std::move(map));
  }
  return out;
}

StripMetrics measure_point_strips(const Model& model, const NamedPointStripifier& stripifier,
                                  const StripOptions& options, std::vector<StripMap>* maps) {
  StripMetrics out;
  for (const Mesh& mesh : model.meshes) {
    const std::vector<double> positions = wedge_positions(mesh);
    const Stopwatch stopwatch;
    StripMap map{.entries = stripifier.run(positions, options), .group_entries = {}};
    stopwatch.add_to(out);
    add(out.stats, strip_stats(map.entries));
    if (out.fault.empty()) out.fault = find_point_fault(positions, map.entries, options);
    map.group_entries.assign(1, static_cast<Index>(map.entries.size()));
    if (maps) maps->push_back(std::move(map));
  }
  return out;
}

}  // namespace pstrips::cli
