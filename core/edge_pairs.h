#pragma once

#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline core {

// Half-edge h = 3 t + k runs from corner k of triangle t to the next corner.
constexpr Index next_half_edge(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr Index previous_half_edge(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// The half-edge that each is paired with, or kNone. In ascending order, each is paired with the
/// last one before it between the same two corners, if that is not paired yet, of the same group,
/// and runs the other way. [spec/compact.md §9]
///
/// corners  wedges below `wedges`, three different ones a triangle
/// group    one a triangle; empty: all are of one group
/// cost     O(corners + wedges)
std::vector<Index> pair_half_edges(std::span<const Index> corners, std::span<const Index> group,
                                   Index wedges);

}  // namespace pstrips::inline core
