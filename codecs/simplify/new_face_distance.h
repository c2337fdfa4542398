#pragma once

#include "codecs/simplify/complex.h"

namespace pstrips::inline codecs {

/// How far from the model a collapse of a star's vertex onto the other end of an edge leaves the
/// place where it stood: its distance, squared, to the nearest of the faces that the star becomes
/// and of their edges at the other end. Planes of faces do not show it: the tip of a thin spike
/// lies near all of them wherever it goes. Cost O(star); the star must have been measured.
float squared_new_face_distance(const Star& star, Vec3f offset);

/// The same of any point where the star's vertex goes to `apex`, both as offsets from it, over the
/// faces that the vertex `other` is not on.
float squared_new_face_distance(const Star& star, Vec3f apex, Vec3f point, Index other);

}  // namespace pstrips::inline codecs
