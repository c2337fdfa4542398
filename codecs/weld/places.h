#pragma once

#include <vector>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// For each vertex the first one at its place, itself if there is none before.
///
/// A place is a position by its value: -0 is 0, and no NaN is anywhere near. With a distance d > 0
/// it is the ball of radius d around the first vertex that is in no earlier ball.
///
/// distance  0 or more, finite, model units
/// cost      O(n)
std::vector<Index> places(const Attribute& position, double distance);

}  // namespace pstrips::inline codecs
