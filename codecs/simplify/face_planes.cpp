#include "codecs/simplify/face_planes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pstrips::inline codecs {
namespace {

// Four floats of each, from the `first` on.
template <class T>
void load_columns(const T* const (&of)[4], std::size_t first, Float4& a, Float4& b, Float4& c,
                  Float4& d) {
  const auto row = [&](std::size_t i) {
    return load4(reinterpret_cast<const std::byte*>(of[i]) + first * sizeof(float));
  };
  Float4 x = row(0), y = row(1), z = row(2), w = row(3);
  transpose4(x, y, z, w);
  a = x, b = y, c = z, d = w;
}

static_assert(offsetof(Quadric, b) == 6 * sizeof(float) &&
              offsetof(VertexPlanes, area) == 10 * sizeof(float));

// Planes and areas of the other ends, as load_columns() finds them.
void load_ends(const VertexPlanes* const (&its)[4], EdgeSums& sums) {
  Float4 unused;
  load_columns(its, 0, sums.xx, sums.yy, sums.zz, sums.xy);
  load_columns(its, 4, sums.xz, sums.yz, unused, unused);
  load_columns(its, 8, unused, unused, sums.area.x, sums.area.y);
  load_columns(its, 12, sums.area.z, unused, unused, unused);
}

}  // namespace

void FacePlanes::update(Index t) {
  const Index* const v = &complex_.corner_vertex[std::size_t{4} * t];
  faces_[t] = {};
  if (complex_.is_locked(v[0]) || complex_.is_locked(v[1]) || complex_.is_locked(v[2])) return;
  const Vec3f n = cross(complex_.offset(v[0], v[1]), complex_.offset(v[0], v[2]));
  const float length = std::sqrt(dot(n, n));
  if (length > 0) faces_[t] = {n * (1 / length), length / 2};
}

void FacePlanes::sum(Star& star, bool with_edges) {
  VertexPlanes around;
  for (const IncidentCorner& incident : star.corners) around.add(faces_[incident.corner / 4]);
  if (with_edges) {
    star.measure();
    builder_.add_edges(star, around.planes);
  }
  around_[star.vertex] = around;
}

void FacePlanes::sum_faces(Index vertex) {
  VertexPlanes around;
  for (const Index corner : complex_.ring_with_dead(vertex)) around.add(faces_[corner / 4]);
  around_[vertex] = around;
}

EdgeSum FacePlanes::edge_sum(const Star& star, const StarEdge& edge) const {
  const VertexPlanes &mine = around_[star.vertex], &its = around_[edge.vertex];
  const Vec3f offset = complex_.offset(star.vertex, edge.vertex);
  const Vec3f slope = its.planes.times(offset);
  EdgeSum sum;
  sum.quadric = mine.planes;
  sum.quadric.add_matrix(its.planes);
  sum.quadric.b = slope * -1;  // all planes pass through their vertex
  sum.constant = dot(slope, offset);
  sum.volume = {mine.area + its.area, dot(its.area, offset)};
  for (const IncidentCorner& incident : star.corners) {
    if (incident.next != edge.vertex && incident.previous != edge.vertex) continue;
    const FacePlane& face = faces_[incident.corner / 4];
    sum.quadric.add_plane(face.normal, -face.area);
    sum.volume.area = sum.volume.area - face.normal * face.area;
  }
  return sum;
}

EdgeSums FacePlanes::edge_sums(const Star& star, const Index (&at)[4]) const {
  const VertexPlanes& mine = around_[star.vertex];
  const VertexPlanes* its[4];
  const VertexPoint* ends[4];
  const FacePlane* faces[2][4];  // the two on each edge
  for (std::size_t i = 0; i < 4; ++i) {
    const Index p = star.edges[at[i]].vertex;
    its[i] = &around_[p];
    faces[0][i] = &faces_[star.corners[at[i]].corner / 4];
    faces[1][i] =
        &faces_[std::ranges::find(star.corners, p, &IncidentCorner::previous)->corner / 4];
    ends[i] = &complex_.points[p];
  }
  EdgeSums sums;
  Float4 unused;
  load_columns(ends, 0, sums.offset.x, sums.offset.y, sums.offset.z, unused);
  sums.offset = sums.offset - complex_.points[star.vertex].position;
  load_ends(its, sums);

  // All planes pass through their vertex.
  const Vec3x4& o = sums.offset;
  const Vec3x4 slope = {sums.xx * o.x + sums.xy * o.y + sums.xz * o.z,
                        sums.xy * o.x + sums.yy * o.y + sums.yz * o.z,
                        sums.xz * o.x + sums.yz * o.y + sums.zz * o.z};
  sums.constant = dot(slope, o);
  sums.b = {-slope.x, -slope.y, -slope.z};
  sums.volume = dot(sums.area, o);
  sums.xx += mine.planes.xx, sums.yy += mine.planes.yy, sums.zz += mine.planes.zz;
  sums.xy += mine.planes.xy, sums.xz += mine.planes.xz, sums.yz += mine.planes.yz;
  sums.area.x += mine.area.x, sums.area.y += mine.area.y, sums.area.z += mine.area.z;
  for (const auto& four : faces) {  // counted twice
    Vec3x4 normal;
    Float4 area;
    load_columns(four, 0, normal.x, normal.y, normal.z, area);
    sums.add_plane(normal, -area);
  }
  return sums;
}

}  // namespace pstrips::inline codecs
