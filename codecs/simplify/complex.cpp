#include "codecs/simplify/complex.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace pstrips::inline codecs {
namespace {

// A vertex takes over two corners more than it loses when its first neighbour goes to it.
constexpr Index kSpareCorners = 2;

bool is_finite(std::span<const double> p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

Complex::Complex(std::span<const double> positions, std::span<const Index> wedge_vertex,
                 std::span<const Index> triangles)
    : points(positions.size() / 3),
      vertices(points.size()),
      marks(points.size()),
      slot_(points.size()) {
  assert(triangles.size() / 3 < kMaxCount / 4);
  // Halved, so that the extent of the largest doubles is still one.
  double high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::max());
  std::fill_n(high, 3, std::numeric_limits<double>::lowest());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto p = positions.subspan(3 * v, 3);
    if (!is_finite(p)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k] / 2);
      high[k] = std::max(high[k], p[k] / 2);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 0.0});
  int exponent = 0;
  if (extent > 0) std::frexp(extent, &exponent);
  // Two factors, since 1 / extent of a denormal extent is too large for one.
  scale[0] = std::ldexp(1.0, -exponent / 2);
  scale[1] = std::ldexp(1.0, -exponent - -exponent / 2);
  const auto scaled = [&](double x, int k) {
    return static_cast<float>((x / 2 - low[k]) * scale[0] * scale[1]);
  };
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto p = positions.subspan(3 * v, 3);
    if (is_finite(p))
      points[v].position = {scaled(p[0], 0), scaled(p[1], 1), scaled(p[2], 2)};
    else
      points[v].error = std::numeric_limits<float>::infinity();
  }
  if (extent > 0)
    diagonal = std::hypot((high[0] - low[0]) * scale[0] * scale[1],
                          (high[1] - low[1]) * scale[0] * scale[1],
                          (high[2] - low[2]) * scale[0] * scale[1]);
  scale[0] /= 2;  // of the halves

  corner_vertex.resize(triangles.size() / 3 * 4);
  for (Index t = 0; t < triangle_count(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const Index wedge = triangles[std::size_t{3} * t + k];
      const Index vertex = wedge_vertex.empty() ? wedge : wedge_vertex[wedge];
      corner_vertex[4 * t + k] = vertex;
      ++vertices[vertex].ring_capacity;
    }
  Index first = 0;
  for (VertexRecord& v : vertices) {
    v.ring = first;
    if (v.ring_capacity > 0) v.ring_capacity += kSpareCorners;
    first += v.ring_capacity;
  }
  pool_.resize(first);
  for (Index t = 0; t < triangle_count(); ++t)
    for (Index c = 4 * t; c < 4 * t + 3; ++c) {
      VertexRecord& v = vertices[corner_vertex[c]];
      pool_[v.ring + v.ring_size++] = c;
    }
}

std::array<double, 3> Complex::model_position(Index vertex) const {
  constexpr double kMax = std::numeric_limits<double>::max();
  const Vec3f& p = points[vertex].position;
  const auto unscaled = [&](float x, int k) {
    const double half = x / (2 * scale[0]) / scale[1] + low[k];
    return std::clamp(2 * half, -kMax, kMax);
  };
  return {unscaled(p.x, 0), unscaled(p.y, 1), unscaled(p.z, 2)};
}

void Complex::gather(Index vertex, Star& star) {
  const auto corners = ring(vertex);
  const Index epoch = new_epoch();
  star.vertex = vertex;
  make_room(star, corners.size());
  Index edges = 0;
  for (Index i = 0; i < corners.size(); ++i) {
    IncidentCorner& incident = star.corner_buffer[i];
    incident.corner = corners[i];
    incident.next = corner_vertex[next(corners[i])];
    incident.previous = corner_vertex[previous(corners[i])];
    for (Index side = 0; side < 2; ++side) {
      const Index other = side == 0 ? incident.next : incident.previous;
      if (marks[other] != epoch) {
        marks[other] = epoch;
        slot_[other] = edges;
        star.edge_buffer[edges++] = {.vertex = other, .triangles = 0, .outgoing = 0};
      }
      StarEdge& edge = star.edge_buffer[slot_[other]];
      ++edge.triangles;
      edge.outgoing += side == 0 ? 1 : 0;
      incident.more[side] = edge.first;
      edge.first = 2 * i + side;
    }
  }
  place(star, static_cast<Index>(corners.size()), edges);
  star.open_edges = static_cast<Index>(
      std::ranges::count_if(star.edges, [](const StarEdge& edge) { return edge.triangles != 2; }));
}

void Complex::gather_regular(Index vertex, Star& star) {
  VertexRecord& record = vertices[vertex];
  star.vertex = vertex;
  star.open_edges = 0;
  make_room(star, record.ring_size);
  Index live = 0;
  Index* const first = pool_.data() + record.ring;
  for (Index i = 0; i < record.ring_size; ++i) {
    const Index corner = first[i];
    if (is_dead(corner)) continue;
    first[live] = corner;
    IncidentCorner& incident = star.corner_buffer[live];
    incident.next = corner_vertex[next(corner)];
    incident.previous = corner_vertex[previous(corner)];
    incident.corner = corner;
    StarEdge& edge = star.edge_buffer[live];
    edge.vertex = incident.next;
    edge.triangles = 2;
    edge.refused = CollapseConstraint::none;
    edge.counts_new_faces = false;
    ++live;
  }
  record.ring_size = live;
  place(star, live, live);
}

void Complex::make_room(Star& star, std::size_t corners) {
  const std::size_t edges = 2 * corners;
  if (star.edge_buffer.size() >= edges + 3) return;
  star.corner_buffer.resize(corners + 3);
  star.edge_buffer.resize(edges + 3);
  star.corner_group_buffer.resize(corners / 4 + 1);
  star.edge_group_buffer.resize(edges / 4 + 1);
}

// Where there is no edge or corner any more, the star's vertex takes its place. A triangle with a
// locked vertex gets no area.
void Complex::place(Star& star, Index corners, Index edges) const {
  star.corners = {star.corner_buffer.data(), corners};
  star.edges = {star.edge_buffer.data(), edges};
  star.corner_groups = {star.corner_group_buffer.data(), (corners + 3) / 4};
  star.edge_groups = {star.edge_group_buffer.data(), (edges + 3) / 4};
  for (Index i = corners; i % 4 != 0; ++i)
    star.corner_buffer[i].next = star.corner_buffer[i].previous = star.vertex;
  for (Index i = edges; i % 4 != 0; ++i) star.edge_buffer[i].vertex = star.vertex;

  const Vec3f own = points[star.vertex].position;
  const auto offsets = [&](Index a, Index b, Index c, Index d, Float4& error) {
    Vec3x4 p = {load4(&points[a]), load4(&points[b]), load4(&points[c])};
    error = load4(&points[d]);
    transpose4(p.x, p.y, p.z, error);
    return p - own;
  };
  const StarEdge* e = star.edge_buffer.data();
  for (EdgeGroup& group : star.edge_groups) {
    group.vertex =
        Int4{static_cast<std::int32_t>(e[0].vertex), static_cast<std::int32_t>(e[1].vertex),
             static_cast<std::int32_t>(e[2].vertex), static_cast<std::int32_t>(e[3].vertex)};
    group.offset = offsets(e[0].vertex, e[1].vertex, e[2].vertex, e[3].vertex, group.error);
    e += 4;
  }
  const IncidentCorner* s = star.corner_buffer.data();
  for (CornerGroup& group : star.corner_groups) {
    Float4 next_error, previous_error;
    group.next = offsets(s[0].next, s[1].next, s[2].next, s[3].next, next_error);
    group.previous =
        offsets(s[0].previous, s[1].previous, s[2].previous, s[3].previous, previous_error);
    const Int4 known = max4(next_error, previous_error) < std::numeric_limits<float>::infinity();
    group.next = {known ? group.next.x : Float4{}, known ? group.next.y : Float4{},
                  known ? group.next.z : Float4{}};
    s += 4;
  }
}

void Complex::append(Index vertex, std::span<const Index> corners) {
  VertexRecord& record = vertices[vertex];
  Index size = record.ring_size + static_cast<Index>(corners.size());
  if (size > record.ring_capacity) {
    const Index live = static_cast<Index>(ring(vertex).size());
    size = live + static_cast<Index>(corners.size());
    // Room for a third more, or the dead would be looked for too often.
    if (size + size / 3 > record.ring_capacity) {
      const Index capacity = size + size / 2;
      const Index first = static_cast<Index>(pool_.size());
      pool_.resize(pool_.size() + capacity);
      std::copy_n(pool_.begin() + record.ring, live, pool_.begin() + first);
      record.ring = first;
      record.ring_capacity = capacity;
    }
  }
  std::ranges::copy(corners, pool_.begin() + record.ring + record.ring_size);
  record.ring_size = size;
}

Index Complex::new_epoch(Index how_many) {
  if (epoch_ > std::numeric_limits<Index>::max() - how_many) {
    std::ranges::fill(marks, Index{0});
    epoch_ = 0;
  }
  epoch_ += how_many;
  return epoch_ - how_many + 1;
}

}  // namespace pstrips::inline codecs
