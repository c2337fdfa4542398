#include "codecs/simplify/initial_quadrics.h"

#include <algorithm>
#include <cmath>

namespace pstrips::inline codecs {
namespace {

// Weight of the plane that stands on an edge, times the edge's length squared; a face's plane
// counts by its area. Found by measuring: large enough that borders stay, small enough that the
// faces beside them keep their share of the triangles.
constexpr float kBorderWeight = 2;
constexpr float kSeamWeight = 1;

// Faces that lie on each other, back to back, do not hold their common edge; beyond a right angle
// it needs holding more and more.
float fold_weight(Vec3f normal, Vec3f other, bool same_direction) {
  const float cosine = dot(normal, other) * (same_direction ? -1.f : 1.f);
  return kBorderWeight * std::max(0.f, -cosine);
}

}  // namespace

// The gradient of each attribute over each triangle, as a plane in (x, a).
void QuadricBuilder::add_attributes(Quadric* also) {
  for (Index c = 0; c < complex_.corner_vertex.size(); c += 4) {
    const Index* const v = &complex_.corner_vertex[c];
    const Index* const w = &wedges_->corner_wedge[c];
    if (complex_.is_locked(v[0]) || complex_.is_locked(v[1]) || complex_.is_locked(v[2])) continue;
    const Vec3f e1 = complex_.offset(v[0], v[1]), e2 = complex_.offset(v[0], v[2]);
    const Vec3f n = cross(e1, e2);
    const float area = std::sqrt(dot(n, n)) / 2;
    if (!(area > 0)) continue;
    for (int i = 0; i < 3; ++i) wedges_->add_weight(w[i], area);
    // Along a needle's short side the gradient has no bounds and says nothing.
    const float longest = std::max(dot(e1, e1), dot(e2, e2));
    if (4 * area * area < 1e-6f * longest * longest) continue;
    const Vec3f u1 = cross(e2, n) * (1 / (4 * area * area));
    const Vec3f u2 = cross(n, e1) * (1 / (4 * area * area));
    for (std::uint32_t k = 0; k < wedges_->attribute_count(); ++k) {
      const float a0 = wedges_->attribute(w[0], k);
      const float d1 = wedges_->attribute(w[1], k) - a0, d2 = wedges_->attribute(w[2], k) - a0;
      const Vec3f gradient = {u1.x * d1 + u2.x * d2, u1.y * d1 + u2.y * d2, u1.z * d1 + u2.z * d2};
      for (int i = 0; i < 3; ++i) {
        Quadric& sum = complex_.vertices[v[i]].quadric;
        sum.add_plane(gradient, area);
        sum.weight -= area;  // counted once, with the face
        if (also) also[v[i]].add_plane(gradient, area);
        wedges_->add_gradient(w[i], k, gradient * area);
      }
    }
  }
}

// Two faces within 45° of a third lie within 90° of each other.
bool QuadricBuilder::may_fold(const Star& star) {
  const Vec3f n = star.normal(0);
  Int4 far = {};
  for (const CornerGroup& group : star.corner_groups)
    far |= (group.area > 0) & (dot(group.normal, n) < 0.71f);
  return any4(far);
}

void QuadricBuilder::add_edges(const Star& star, Quadric& quadric) const {
  if (complex_.is_locked(star.vertex)) return;
  for (const StarEdge& edge : star.edges)
    if (!complex_.is_locked(edge.vertex)) add_edge(star, edge, quadric);
}

void QuadricBuilder::add_edge(const Star& star, const StarEdge& edge, Quadric& quadric) const {
  float weight = kBorderWeight;
  if (edge.triangles == 2) {
    const Index second = edge.first, first = star.corners[second / 2].more[second % 2];
    const IncidentCorner &a = star.corners[first / 2], &b = star.corners[second / 2];
    weight = fold_weight(star.normal(first / 2), star.normal(second / 2), first % 2 == second % 2);
    if (!input_.group.empty() && input_.group[a.corner / 4] != input_.group[b.corner / 4])
      weight = std::max(weight, kSeamWeight);
    if (wedges_) weight = std::max(weight, seam_weight(a, first % 2, b, second % 2));
    if (weight == 0) return;
  }
  const Vec3f along = complex_.offset(star.vertex, edge.vertex);
  const float length_squared = dot(along, along);
  weight *= length_squared / static_cast<float>(edge.triangles);
  for (Index i = edge.first; i != kNone; i = star.corners[i / 2].more[i % 2]) {
    const Vec3f side = cross(along, star.normal(i / 2));
    const float length = std::sqrt(dot(side, side));
    if (length > 0)
      quadric.add_plane(side * (1 / length), weight);
    else if (length_squared > 0)  // a face without area: hold the line from all sides
      quadric.add_line(along * (1 / std::sqrt(length_squared)), weight);
  }
}

// An edge is a seam where its faces use different wedges; as much as their attributes differ.
float QuadricBuilder::seam_weight(const IncidentCorner& a, Index side_a, const IncidentCorner& b,
                                  Index side_b) const {
  const auto far = [](const IncidentCorner& s, Index side) {
    return side == 0 ? Complex::next(s.corner) : Complex::previous(s.corner);
  };
  const std::vector<Index>& wedge = wedges_->corner_wedge;
  float weight = 0;
  for (const auto& [x, y] : {std::pair{wedge[a.corner], wedge[b.corner]},
                             std::pair{wedge[far(a, side_a)], wedge[far(b, side_b)]}}) {
    if (x == y) continue;
    if (wedges_->attribute_count() == 0) return kSeamWeight;
    // From a tenth of the whole range on a jump is as visible as it can be.
    weight = std::max(weight, std::min(1.f, 10 * wedges_->largest_difference(x, y)));
  }
  return kSeamWeight * weight;
}

}  // namespace pstrips::inline codecs
