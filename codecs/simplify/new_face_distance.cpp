#include "codecs/simplify/new_face_distance.h"

#include <algorithm>
#include <limits>

namespace pstrips::inline codecs {

float squared_new_face_distance(const Star& star, Vec3f offset) {
  constexpr float kFar = std::numeric_limits<float>::max();
  const Vec3x4 p = {all4(offset.x), all4(offset.y), all4(offset.z)};
  Float4 least = all4(dot(offset, offset));
  for (const CornerGroup& group : star.corner_groups) {
    const Vec3x4 &a = group.next, &b = group.previous;
    const Vec3x4 along = a - p;
    // The vertex, which is the origin, beside the edge from p to a.
    const Float4 length = dot(along, along);
    Float4 t = length > 0 ? -dot(p, along) / length : Float4{};
    t = t < 0 ? Float4{} : t > 1 ? all4(1) : t;
    const Vec3x4 foot = {p.x + along.x * t, p.y + along.y * t, p.z + along.z * t};
    Float4 distance = dot(foot, foot);
    // Above the face of p, a and b.
    const Vec3x4 n = cross(along, b - p);
    const Float4 size = dot(n, n);
    const Int4 is_above = (size > 0) & (dot(cross(a, b), n) >= 0) & (dot(cross(b, p), n) >= 0) &
                          (dot(cross(p, a), n) >= 0);
    const Float4 height = dot(p, n);
    distance = is_above ? height * height / size : distance;
    distance = group.area > 0 ? distance : all4(kFar);
    least = distance < least ? distance : least;
  }
  return std::min({least[0], least[1], least[2], least[3]});
}

}  // namespace pstrips::inline codecs
