#include "codecs/simplify/star.h"

namespace pstrips::inline codecs {

// Each corner's previous vertex is the next of one corner, and no two have the same.
bool Star::is_regular() const {
  if (corners.size() > kMaxForPairs) return false;
  Int4 hits_of_lane[kMaxForPairs / 4] = {};
  for (const IncidentCorner& incident : corners) {
    Int4 hits = {};
    for (std::size_t g = 0; g < edge_groups.size(); ++g) {
      const Int4 hit = edge_groups[g].vertex == static_cast<std::int32_t>(incident.previous);
      hits += hit;
      hits_of_lane[g] += hit;
    }
    if (hits[0] + hits[1] + hits[2] + hits[3] != -1) return false;
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (hits_of_lane[i / 4][i % 4] != -1) return false;
  return true;
}

Quadric Star::measure() {
  Float4 xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {}, weight = {};
  for (CornerGroup& group : corner_groups) {
    const Vec3x4 n = cross(group.next, group.previous);
    const Float4 length = sqrt4(dot(n, n));
    const Float4 inverse = length > 0 ? 1 / length : Float4{};
    group.normal = {n.x * inverse, n.y * inverse, n.z * inverse};
    group.area = length > 0 ? length * 0.5f : Float4{};
    const Vec3x4& u = group.normal;
    const Vec3x4 w = {u.x * group.area, u.y * group.area, u.z * group.area};
    xx += w.x * u.x, yy += w.y * u.y, zz += w.z * u.z;
    xy += w.x * u.y, xz += w.x * u.z, yz += w.y * u.z;
    weight += group.area;
  }
  Quadric sum;
  sum.xx = sum4(xx), sum.yy = sum4(yy), sum.zz = sum4(zz);
  sum.xy = sum4(xy), sum.xz = sum4(xz), sum.yz = sum4(yz);
  sum.weight = sum4(weight);
  return sum;
}

}  // namespace pstrips::inline codecs
