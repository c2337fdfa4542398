#pragma once

#include <array>
#include <span>
#include <vector>

#include "codecs/triangulate/predicates.h"
#include "core/mesh.h"

namespace pstrips::inline codecs {

/// Cuts a polygon into n - 2 triangles, each three of its n >= 3 corners, counter-clockwise.
///
/// Simple polygons and those that only touch themselves (bridges to holes, corners that coincide,
/// whiskers) are covered once, simple ones without triangles of no area unless all corners lie on
/// one line. Others still give n - 2 triangles.
///
/// loop     finite, its signed area is not negative
/// cost     O(n log n)
/// source   two ears [Meisters75], of which a cut changes its two neighbours alone. Ours: a queue a
///          degree of strictness, so that what is degenerate is cut last; exact predicates; corners
///          in a tree of boxes
std::vector<std::array<Index, 3>> clip_ears(std::span<const Point2> loop);

}  // namespace pstrips::inline codecs
