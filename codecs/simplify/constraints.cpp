#include "codecs/simplify/constraints.h"

#include <algorithm>

namespace pstrips::inline codecs {
namespace {

// Faces may turn by 78°.
constexpr float kLeastCosine = 0.2f;
// Height over longest side below which a face is a sliver. No more than what degenerates: the long
// faces that developable parts of CAD models need are much thinner than one would like.
constexpr float kSliver = 1e-4f;

// A vertex on a border or non-manifold edge may only slide along it, and not where several meet.
bool breaks_border(const Star& star, const StarEdge& edge) {
  return star.open_edges > 0 && (edge.triangles == 2 || star.open_edges > 2);
}

// Whether the face with sides a and b from a corner turns too far, or becomes a sliver that it was
// not, when that corner moves by `shift`.
bool face_flips(Vec3f a, Vec3f b, Vec3f shift) {
  const Vec3f before = cross(a, b), u = a - shift, v = b - shift, after = cross(u, v);
  const float turn = dot(before, after);
  const float size_before = dot(before, before), size_after = dot(after, after);
  if (!(size_before > 0)) return false;  // was no face to begin with
  // In double precision: fourth powers of lengths squared.
  if (turn <= 0 ||
      double{turn} * turn < double{kLeastCosine} * kLeastCosine * size_before * double{size_after})
    return true;
  const auto longest = [](Vec3f s, Vec3f t) {
    const Vec3f w = s - t;
    return std::max({dot(s, s), dot(t, t), dot(w, w)});
  };
  const float length = longest(u, v);
  if (size_after >= kSliver * kSliver * length * length) return false;
  const float length_before = longest(a, b);
  return double{size_after} * length_before * length_before < double{size_before} * length * length;
}

}  // namespace

CollapseConstraint CollapseConstraints::check(const Star& star, const StarEdge& edge) {
  if (breaks_border(star, edge)) return CollapseConstraint::border;
  if (breaks_link(star, edge.vertex)) return CollapseConstraint::link;
  return flips(star, edge.vertex, complex_.offset(star.vertex, edge.vertex))
             ? CollapseConstraint::flip
             : CollapseConstraint::none;
}

CollapseConstraint CollapseConstraints::check(const Star& star, const StarEdge& edge, Vec3f shift,
                                              Vec3f kept_shift) {
  if (breaks_border(star, edge)) return CollapseConstraint::border;
  if (breaks_link(star, edge.vertex)) return CollapseConstraint::link;
  return flips(star, edge.vertex, shift) || flips_kept(star.vertex, edge.vertex, kept_shift)
             ? CollapseConstraint::flip
             : CollapseConstraint::none;
}

// What breaks_link() says where every edge at q and p has two triangles: each neighbour of p is the
// next of one of its corners, and those that q has too are to be the two on triangles with both.
bool CollapseConstraints::breaks_regular_link(const Star& star, Index p) {
  Int4 shared = {};
  for (const Index corner : complex_.ring(p)) {
    const Index neighbour = complex_.corner_vertex[Complex::next(corner)];
    if (neighbour == star.vertex) continue;
    const auto x = static_cast<std::int32_t>(neighbour);
    for (const EdgeGroup& group : star.edge_groups) shared += group.vertex == x;
  }
  if (shared[0] + shared[1] + shared[2] + shared[3] != -2) return true;
  if (star.corners.size() != 3) return false;
  for (const IncidentCorner& incident : star.corners)
    if (incident.next != p && incident.previous != p)
      return has_triangle(p, incident.next, incident.previous);
  return false;
}

// Link condition: what p and q both neighbour is on a triangle with both, and no two faces become
// one. What is not known in time counts as broken.
bool CollapseConstraints::breaks_link(const Star& star, Index p) {
  const auto is_small = [&](Index v) {
    const VertexRecord& record = complex_.vertices[v];
    return record.regular && record.ring_size <= kMaxForPairs;
  };
  if (is_small(star.vertex) && is_small(p)) return breaks_regular_link(star, p);
  std::vector<Index>& marks = complex_.marks;
  const Index near = complex_.new_epoch(2), apex = near + 1;
  const bool large = complex_.vertices[p].ring_size > kLargeRing;
  if (!large)
    for (const Index corner : complex_.ring(p)) {
      marks[complex_.corner_vertex[Complex::next(corner)]] = near;
      marks[complex_.corner_vertex[Complex::previous(corner)]] = near;
    }
  for (const IncidentCorner& incident : star.corners) {
    if (incident.next == p) marks[incident.previous] = apex;
    if (incident.previous == p) marks[incident.next] = apex;
  }
  for (const IncidentCorner& incident : star.corners) {
    if (incident.next == p || incident.previous == p) continue;
    int apexes = 0;
    for (const Index x : {incident.next, incident.previous}) {
      if (marks[x] == apex)
        ++apexes;
      else if (large ? has_neighbour(x, p) : marks[x] == near)
        return true;
    }
    if (apexes == 2 && has_triangle(p, incident.next, incident.previous)) return true;
  }
  return false;
}

bool CollapseConstraints::has_neighbour(Index vertex, Index other) {
  if (complex_.vertices[vertex].ring_size > 4 * kLargeRing) return true;
  return std::ranges::any_of(complex_.ring(vertex), [&](Index corner) {
    return complex_.corner_vertex[Complex::next(corner)] == other ||
           complex_.corner_vertex[Complex::previous(corner)] == other;
  });
}

bool CollapseConstraints::has_triangle(Index a, Index b, Index c) {
  const auto size = [&](Index v) { return complex_.vertices[v].ring_size; };
  if (size(b) < size(a)) std::swap(a, b);
  if (size(c) < size(a)) std::swap(a, c);
  if (size(a) > 4 * kLargeRing) return true;
  return std::ranges::any_of(complex_.ring(a), [&](Index corner) {
    const Index x = complex_.corner_vertex[Complex::next(corner)];
    const Index y = complex_.corner_vertex[Complex::previous(corner)];
    return (x == b && y == c) || (x == c && y == b);
  });
}

// As face_flips() for four faces at once; those that may have become slivers are looked at singly.
bool CollapseConstraints::flips(const Star& star, Index p, Vec3f shift) const {
  for (std::size_t g = 0; g < star.corner_groups.size(); ++g) {
    const CornerGroup& group = star.corner_groups[g];
    const Vec3x4 u = group.next - shift, v = group.previous - shift, w = u - v;
    const Vec3x4 after = cross(u, v);
    const Float4 turn = dot(after, group.normal), size = dot(after, after);
    const Float4 length = max4(max4(dot(u, u), dot(v, v)), dot(w, w));
    const Int4 turns = (turn <= 0) | (turn * turn < kLeastCosine * kLeastCosine * size);
    const Int4 suspect = (group.area > 0) & (turns | (size < kSliver * kSliver * length * length));
    if (!any4(suspect)) continue;
    for (std::size_t i = 4 * g; i < std::min(4 * g + 4, star.corners.size()); ++i) {
      const IncidentCorner& incident = star.corners[i];
      if (suspect[i % 4] == 0 || incident.next == p || incident.previous == p) continue;
      if (turns[i % 4] != 0 ||
          face_flips(lane(group.next, i % 4), lane(group.previous, i % 4), shift))
        return true;
    }
  }
  return false;
}

bool CollapseConstraints::flips_kept(Index q, Index p, Vec3f shift) {
  if (shift.x == 0 && shift.y == 0 && shift.z == 0) return false;
  return std::ranges::any_of(complex_.ring(p), [&](Index corner) {
    const Index next = complex_.corner_vertex[Complex::next(corner)];
    const Index previous = complex_.corner_vertex[Complex::previous(corner)];
    return next != q && previous != q &&
           face_flips(complex_.offset(p, next), complex_.offset(p, previous), shift);
  });
}

}  // namespace pstrips::inline codecs
