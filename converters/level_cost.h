#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codecs/collapse.h"
#include "core/mesh.h"

namespace pstrips::inline converters {

/// What strips at full resolution should pay for falling apart at coarser levels, as
/// StripInput::step_cost.
///
/// A triangle vanishes with the first of its sides that a collapse makes a point; the other two
/// sides are one edge from then on. A strip that steps over those two lives on, one that steps over
/// the vanishing side is torn: the triangles before and after it share no more than a vertex. So
/// that side costs `cost`, and no other. Strips guided by the order of
/// collapses are [Belmonte01]'s idea, there by weights of a spanning tree.
///
/// triangles  3 n vertices, not wedges
/// collapses  each vertex removed at most once, and onto one that is still there
/// threads    see thread_count(); the costs do not depend on it
/// returns    3 n costs
/// cost       O((n + vertices) log vertices)
std::vector<std::uint8_t> level_step_cost(std::span<const Index> triangles, Index vertex_count,
                                          std::span<const Collapse> collapses, std::uint8_t cost,
                                          unsigned threads = 1);

}  // namespace pstrips::inline converters
