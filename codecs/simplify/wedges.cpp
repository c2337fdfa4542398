#include "codecs/simplify/wedges.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pstrips::inline codecs {
namespace {

// Area over the longest side squared below which a triangle of the texture is a sliver.
constexpr float kSliver = 1e-2f;

// Whether a triangle of the texture turns over when its corner goes from `from` to `to`, or becomes
// a sliver that it was not. All flat.
bool turns_over(Vec3f next, Vec3f previous, Vec3f from, Vec3f to) {
  const auto area = [&](Vec3f corner) {
    const Vec3f a = next - corner, b = previous - corner;
    return a.x * b.y - a.y * b.x;
  };
  const auto longest = [&](Vec3f corner) {
    const Vec3f a = next - corner, b = previous - corner, c = next - previous;
    return std::max({dot(a, a), dot(b, b), dot(c, c)});
  };
  const float before = area(from), after = area(to);
  if (before == 0) return false;  // was no triangle to begin with
  if ((before > 0) != (after > 0)) return true;
  const float length = longest(to);
  return std::abs(after) < kSliver * length &&
         std::abs(after) * longest(from) < std::abs(before) * length;
}

}  // namespace

WedgeTable::WedgeTable(const SimplifyInput& input, double diagonal)
    : corner_wedge(input.triangles.size() / 3 * 4),
      attributes_(input.attributes),
      count_(input.attributes.empty() ? 0 : input.attribute_count),
      texture_(input.texture),
      scale_(static_cast<float>(diagonal)) {
  const std::size_t vertices = input.positions.size() / 3;
  const std::size_t wedges = input.wedge_vertex.empty() ? vertices : input.wedge_vertex.size();
  assert(attributes_.size() == wedges * count_);
  assert(texture_ == kNone || texture_ + 1 < count_);
  for (std::size_t t = 0; 3 * t < input.triangles.size(); ++t)
    std::copy_n(input.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t), 3,
                corner_wedge.begin() + static_cast<std::ptrdiff_t>(4 * t));
  weight_.resize(wedges);
  terms_.resize(wedges * count_);
  mark_.resize(wedges);
  other_.resize(wedges);
  first_.assign(vertices, kNone);
  next_.assign(wedges, kNone);
  for (std::size_t w = wedges; w-- > 0;) {  // backwards, so that each list ascends
    Index& first = first_[input.wedge_vertex.empty() ? w : input.wedge_vertex[w]];
    next_[w] = first;
    first = static_cast<Index>(w);
  }
}

std::optional<WedgeTable> wedge_table(const SimplifyInput& input, double diagonal) {
  if (input.wedge_vertex.empty() && input.attribute_count == 0) return std::nullopt;
  return WedgeTable(input, diagonal);
}

float WedgeTable::largest_difference(Index a, Index b) const {
  float largest = 0;
  for (std::uint32_t k = 0; k < count_; ++k)
    largest = std::max(largest, std::abs(attributes_[std::size_t{a} * count_ + k] -
                                         attributes_[std::size_t{b} * count_ + k]));
  return largest;
}

float WedgeTable::live_weight(const Star& star) {
  float sum = 0;
  new_epoch();
  for (const IncidentCorner& incident : star.corners) {
    const Index wedge = corner_wedge[incident.corner];
    if (is_marked(wedge)) continue;
    mark(wedge, kNone);
    sum += weight_[wedge];
  }
  return sum;
}

// Calls visit(corner of the star's vertex, corner of the other end) for the triangles of an edge.
template <class Visit>
void WedgeTable::for_each_triangle(const Star& star, const StarEdge& edge, Visit&& visit) const {
  for (Index i = edge.first; i != kNone; i = star.corners[i / 2].more[i % 2]) {
    const Index corner = star.corners[i / 2].corner;
    visit(corner, i % 2 == 0 ? Complex::next(corner) : Complex::previous(corner));
  }
}

WedgeTable::Cost WedgeTable::cost(const Star& star, const StarEdge& edge) {
  new_epoch();
  for_each_triangle(star, edge, [&](Index from, Index to) { mark_first(from, to); });
  Cost sum;
  for_each_triangle(star, edge, [&](Index from, Index to) {
    const Index wedge = corner_wedge[from], first = other(wedge);
    if (first == to) {
      sum.mapped_weight += weight_[wedge];
      add_cost(wedge, corner_wedge[to], sum);
    } else if (corner_wedge[first] != corner_wedge[to]) {
      sum.conflicts += conflict(wedge, corner_wedge[first], corner_wedge[to]);
    }
  });
  return sum;
}

bool WedgeTable::breaks_texture(const Star& star, const StarEdge& edge) {
  if (texture_ == kNone) return false;
  new_epoch();
  for_each_triangle(star, edge, [&](Index from, Index to) { mark_first(from, to); });
  const auto place = [&](Index wedge) {
    const float* const a = &attributes_[std::size_t{wedge} * count_ + texture_];
    return Vec3f{a[0], a[1], 0};
  };
  return std::ranges::any_of(star.corners, [&](const IncidentCorner& incident) {
    const Index wedge = corner_wedge[incident.corner];
    if (incident.next == edge.vertex || incident.previous == edge.vertex || !is_marked(wedge))
      return false;  // gone, or reassigned
    return turns_over(place(corner_wedge[Complex::next(incident.corner)]),
                      place(corner_wedge[Complex::previous(incident.corner)]), place(wedge),
                      place(corner_wedge[other(wedge)]));
  });
}

void WedgeTable::add_cost(Index wedge, Index to, Cost& sum) const {
  for (std::uint32_t k = 0; k < count_; ++k) {
    const Term& term = terms_[std::size_t{wedge} * count_ + k];
    const float a = attribute(to, k) - attribute(wedge, k);
    sum.constant += a * (a * weight_[wedge] - 2 * term.d);
    sum.linear = sum.linear - term.g * a;
  }
}

// What merging two values costs.
float WedgeTable::conflict(Index wedge, Index a, Index b) const {
  float sum = 0;
  for (std::uint32_t k = 0; k < count_; ++k) {
    const float difference = attribute(a, k) - attribute(b, k);
    sum += difference * difference;
  }
  return sum * weight_[wedge] / 2;  // about half of its triangles get the wrong one
}

void WedgeTable::replace(Index wedge, Index to, Vec3f offset, Quadric& quadric) {
  for (std::uint32_t k = 0; k < count_; ++k) {
    const Term& from = terms_[std::size_t{wedge} * count_ + k];
    Term& sum = terms_[std::size_t{to} * count_ + k];
    const float a = attribute(to, k) - attribute(wedge, k);
    sum.g = {sum.g.x + from.g.x, sum.g.y + from.g.y, sum.g.z + from.g.z};
    sum.d += from.d + dot(from.g, offset) - a * weight_[wedge];
    quadric.b = quadric.b - from.g * a;
  }
  weight_[to] += weight_[wedge];
}

void WedgeTable::shift_term(Index wedge, Vec3f offset) {
  for (std::uint32_t k = 0; k < count_; ++k) {
    Term& term = terms_[std::size_t{wedge} * count_ + k];
    term.d += dot(term.g, offset);
  }
}

void WedgeTable::collapse(const Complex& complex, const Star& star, Index kept, Vec3f offset,
                          Quadric& quadric, std::vector<WedgeMove>& moves) {
  // The two corners of a removed triangle correspond.
  new_epoch();
  Index any = kNone;
  for (const IncidentCorner& incident : star.corners) {
    if (incident.next != kept && incident.previous != kept) continue;
    const Index corner = incident.corner;
    mark_first(corner, incident.next == kept ? Complex::next(corner) : Complex::previous(corner));
  }
  for (const IncidentCorner& incident : star.corners) {
    const Index corner = incident.corner;
    const Index wedge = corner_wedge[corner];
    if (complex.is_dead(corner)) {
      any = std::min(any, corner_wedge[other(wedge)]);
    } else if (!is_marked(wedge)) {
      mark(wedge, kNone);
    } else if (other(wedge) != kNone) {
      corner_wedge[corner] = corner_wedge[other(wedge)];
    }
  }
  Index last_reassigned = kNone;
  for (Index wedge = first_[star.vertex], after; wedge != kNone; wedge = after) {
    after = next_[wedge];
    if (!is_marked(wedge)) {  // in no triangle any more
      moves.push_back({wedge, any});
      continue;
    }
    const Index to = other(wedge) == kNone ? kNone : corner_wedge[other(wedge)];
    moves.push_back({wedge, to});
    if (to != kNone) {
      replace(wedge, to, offset, quadric);
      continue;
    }
    shift_term(wedge, offset);
    next_[wedge] = last_reassigned;
    last_reassigned = wedge;
  }
  first_[star.vertex] = kNone;
  for (Index wedge = last_reassigned, after; wedge != kNone; wedge = after) {
    after = next_[wedge];
    next_[wedge] = first_[kept];
    first_[kept] = wedge;
  }
}

}  // namespace pstrips::inline codecs
