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

float squared_new_face_distance(const Star& star, Vec3f apex, Vec3f point, Index other) {
  const Vec3f to_apex = apex - point;
  float least = dot(to_apex, to_apex);
  for (std::size_t i = 0; i < star.corners.size(); ++i) {
    if (star.corners[i].next == other || star.corners[i].previous == other) continue;
    const CornerGroup& group = star.corner_groups[i / 4];
    const Vec3f a = lane(group.next, i % 4) - point, b = lane(group.previous, i % 4) - point;
    const Vec3f along = a - to_apex;
    const float length = dot(along, along);
    const float t = length > 0 ? std::clamp(-dot(to_apex, along) / length, 0.f, 1.f) : 0.f;
    const Vec3f foot = to_apex + along * t;
    least = std::min(least, dot(foot, foot));
    const Vec3f n = cross(along, b - to_apex);
    const float size = dot(n, n);
    if (size > 0 && dot(cross(a, b), n) >= 0 && dot(cross(b, to_apex), n) >= 0 &&
        dot(cross(to_apex, a), n) >= 0) {
      const float height = dot(to_apex, n);
      least = std::min(least, height * height / size);
    }
  }
  return least;
}

}  // namespace pstrips::inline codecs
