#pragma once

#include <span>

#include "codecs/filter/display_strips.h"
#include "codecs/vsplit/level.h"

namespace pstrips::inline codecs {

/// Display strips of a level whose map is one of triangles: made anew, by a rule that gives the
/// same strips on every machine. They cross neither a seam nor the border of a group, group after
/// group.
///
/// returns  each triangle once, with its winding; strips parted by kRestart
/// cost     O(triangles + wedges), whatever the triangles are; integers only
/// source   spec/compact.md, "Derived strips". Spanning trees cut by dynamic programming as in
///          [Xiang99], but for the least of indices, and nothing is concatenated: cutting the trees
///          saves 0.005 to 0.015 indices a triangle beside the walk alone
DisplayStrips derive_strips(const LevelView& level);

/// The same of triangles given as three wedges each, of distinct vertices, in the order in which
/// strips are wanted.
///
/// group  ascending, one each, or empty
DisplayStrips derive_strips(std::span<const Index> corners, std::span<const Index> group,
                            Index wedge_count);

}  // namespace pstrips::inline codecs
