#pragma once

#include <array>
#include <set>
#include <span>

#include "codecs/vsplit/level.h"
#include "core/strips.h"

namespace pstrips::test {

/// The triangles that strips of a level show, each from its lowest vertex on, winding kept.
std::multiset<std::array<Index, 3>> triangles_of(std::span<const Index> strips, const Level& level);

/// The triangles of the level's own map likewise.
std::multiset<std::array<Index, 3>> triangles_of(const Level& level);

}  // namespace pstrips::test
