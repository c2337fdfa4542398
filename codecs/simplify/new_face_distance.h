#pragma once

#include "codecs/simplify/complex.h"

namespace pstrips::inline codecs {

/// How far from the model a collapse of a star's vertex onto the other end of an edge leaves the
/// place where it stood: its distance, squared, to the nearest of the faces that the star becomes
/// and of their edges at the other end. Planes of faces do not show it: the tip of a thin spike
/// lies near all of them wherever it goes. Cost O(star); the star must have been measured.
float squared_new_face_distance(const Star& star, Vec3f offset);

}  // namespace pstrips::inline codecs
