#include "codecs/stripify/qstrip.h"

#include <tuple>

#include "codecs/stripify/face_walk.h"

namespace pstrips::inline codecs {
namespace {

Strips strips_of(const StripFaces& faces, StripGoal goal) {
  FaceWalk walk(faces);
  const auto rank = [&](Index exit, std::uint32_t swaps) {
    const Index degree = walk.free().degree(faces.neighbor(exit));
    const Index beyond = walk.lowest_degree_beyond(exit);
    return goal == StripGoal::indices ? std::tuple(swaps, degree, beyond)
                                      : std::tuple(degree, beyond, swaps);
  };
  for (Index seed; (seed = walk.free().lowest()) != kNone;) {
    walk.start(seed);
    walk.grow(rank);
    walk.reverse();
    walk.grow(rank);
    walk.finish();
  }
  return emit_face_strips(faces, walk.visits());
}

}  // namespace

Strips qstrip(const StripInput& input, const StripOptions& options) {
  return strips_of(make_strip_faces(input), options.goal);
}

Strips qstrip_polygons(const PolygonInput& input, const StripOptions& options) {
  return strips_of(make_strip_faces(input), options.goal);
}

}  // namespace pstrips::inline codecs
