#include "codecs/simplify/collapse_driver.h"

#include <cmath>

namespace pstrips::inline codecs {

CollapseState::CollapseState(const SimplifyInput& in, const SimplifyOptions& opts)
    : input(in),
      options(opts),
      memoryless(opts.metric == Metric::memoryless),
      complex(in.positions, in.wedge_vertex, in.triangles),
      wedges(wedge_table(in, complex.diagonal)) {
  out.triangles_left = input.triangles.size() / 3;
  target_triangles = options.target_triangles;
  if (options.component_triangles > 0) {
    guard.emplace(complex);
    if (guard->least_triangles() <= options.component_triangles)
      target_triangles = std::max(target_triangles, guard->least_triangles());
    else
      guard.reset();
  }
  if (options.max_error < 0) return;
  const double limit = options.max_error * complex.scale[0] * complex.scale[1];
  max_squared_error = static_cast<float>(std::min(limit * limit, 1e30));
}

void CollapseState::move_corners(const Star& star, Index kept) {
  moved_corners.clear();
  const std::uint64_t before = out.triangles_left;
  for (const IncidentCorner& incident : star.corners) {
    if (incident.next == kept || incident.previous == kept) {
      complex.kill(incident.corner);
      --out.triangles_left;
    } else {
      complex.corner_vertex[incident.corner] = kept;
      moved_corners.push_back(incident.corner);
    }
  }
  if (guard) guard->lose(star.vertex, static_cast<Index>(before - out.triangles_left));
}

void CollapseState::move_wedges(const Star& star, Index kept, Vec3f offset, Quadric& quadric) {
  if (wedges)
    wedges->collapse(complex, star, kept, offset, quadric, out.moves);
  else
    out.moves.push_back({star.vertex, kept});
}

void CollapseState::join_rings(const Star& star, const StarEdge& edge) {
  complex.append(edge.vertex, moved_corners);
  VertexRecord &from = complex.vertices[star.vertex], &to = complex.vertices[edge.vertex];
  from.ring_size = 0;
  count(out.forced, edge.refused);
  if (edge.refused != CollapseConstraint::none)
    for (const StarEdge& other : star.edges) complex.vertices[other.vertex].regular = false;
  to.regular &= from.regular;
}

void CollapseState::add_collapse(Index removed, Index kept, float squared_error,
                                 std::size_t first_move) {
  const float weight = complex.vertices[kept].quadric.weight;
  const float mean = weight > 0 ? std::sqrt(squared_error / weight) : 0;
  const double error = mean / complex.scale[0] / complex.scale[1];
  last_error = std::max(
      last_error, static_cast<float>(std::min(error, double{std::numeric_limits<float>::max()})));
  out.collapses.push_back(
      {removed, kept, last_error, static_cast<Index>(out.moves.size() - first_move)});
}

}  // namespace pstrips::inline codecs
