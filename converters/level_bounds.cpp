#include "converters/level_bounds.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace pstrips::inline converters {
namespace {

std::vector<Index> corner_vertices(const Mesh& mesh, const Triangulation& triangles) {
  std::vector<Index> out;
  out.reserve(triangles.corners.size());
  for (const Index wedge : triangles.corners) out.push_back(mesh.vertex_of(wedge));
  return out;
}

std::vector<Point> vertex_points(const Attribute& position) {
  std::vector<Point> out(position.elements());
  const std::size_t axes = std::min<std::size_t>(3, position.count);
  for (std::size_t v = 0; v < out.size(); ++v)
    for (std::size_t k = 0; k < axes; ++k) out[v][k] = component(position, v, k);
  return out;
}

// As record() stores them and a decoder gets them back.
std::vector<double> stored_placements(const Attribute& position,
                                      const std::vector<double>& placements) {
  Attribute stored = position.format();
  stored.data.resize(stored.element_bytes());
  const std::size_t axes = std::min<std::size_t>(3, position.count);
  std::vector<double> out(placements.size(), 0);
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const std::size_t axis = i % 3;
    if (axis >= axes) continue;
    set_component(stored, 0, axis, placements[i]);
    out[i] = component(stored, 0, axis);
  }
  return out;
}

std::uint64_t triangles_left(const Mesh& mesh, const Triangulation& triangles,
                             const std::vector<Collapse>& collapses) {
  std::vector<Index> stands_for(mesh.vertex_count());
  std::iota(stands_for.begin(), stands_for.end(), Index{0});
  for (std::size_t i = collapses.size(); i-- > 0;)
    stands_for[collapses[i].removed] = stands_for[collapses[i].kept];
  const std::vector<Index> corners = corner_vertices(mesh, triangles);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Index a = stands_for[corners[i]], b = stands_for[corners[i + 1]],
                c = stands_for[corners[i + 2]];
    count += a != b && b != c && c != a;
  }
  return count;
}

}  // namespace

std::vector<ErrorBounds> level_bounds(const Mesh& mesh, const Triangulation& triangles,
                                      const CollapseSequence& sequence, double most) {
  const std::vector<double> placements = stored_placements(mesh.position, sequence.placements);
  return error_bounds({vertex_points(mesh.position), corner_vertices(mesh, triangles),
                       sequence.collapses, placements},
                      most);
}

void cut_back(const Mesh& mesh, const Triangulation& triangles, double most,
              CollapseSequence& sequence, std::vector<ErrorBounds>& bounds) {
  while (bounds.size() > 1 && bounds.back().two_sided > most) bounds.pop_back();
  const std::size_t count = bounds.size() - 1;
  assert(count <= sequence.collapses.size());
  if (count == sequence.collapses.size()) return;
  sequence.collapses.resize(count);
  const auto moves = [](std::size_t sum, const Collapse& c) { return sum + c.moves; };
  sequence.moves.resize(
      std::accumulate(sequence.collapses.begin(), sequence.collapses.end(), std::size_t{0}, moves));
  if (!sequence.placements.empty()) sequence.placements.resize(3 * count);
  sequence.triangles_left = triangles_left(mesh, triangles, sequence.collapses);
  sequence.stop = SimplifyStop::max_error;
}

}  // namespace pstrips::inline converters
