#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh.h"
#include "core/result.h"

namespace pstrips::inline core {

// The index map: strips of wedges one after the other, parted by kRestart. An entry of the
// offset encoding may instead be one of four symbols, "the same wedge as the entry at
// that distance". [Kim04 §3.2, §3.3; spec/strips.md]

inline constexpr Index kRestart = 0xffff'ffff;
inline constexpr Index kSameAsMinus2 = 0xffff'fffb;
inline constexpr Index kSameAsMinus1 = 0xffff'fffc;
inline constexpr Index kSameAsPlus1 = 0xffff'fffd;
inline constexpr Index kSameAsPlus2 = 0xffff'fffe;

constexpr bool is_symbol(Index entry) { return entry >= kSameAsMinus2 && entry != kRestart; }
constexpr bool is_wedge(Index entry) { return entry < kSameAsMinus2; }
/// -2, -1, +1 or +2. Precondition: is_symbol(symbol).
constexpr int distance_of(Index symbol) {
  const int d = static_cast<int>(symbol - kSameAsMinus2) - 2;
  return d < 0 ? d : d + 1;
}
/// Precondition: distance is -2, -1, 1 or 2.
constexpr Index symbol_of(int distance) {
  return static_cast<Index>(static_cast<int>(kSameAsMinus2) + 2 +
                            (distance < 0 ? distance : distance - 1));
}

/// Calls `visit(i)` for entry `at`, then for every entry whose chain of symbols leads there. The
/// one walk against the direction of the symbols, whatever a map is stored in.
///
/// pending     scratch, so that no call allocates
/// repeats     repeats(i, d): whether entry i is the symbol of distance d; also called for up to
/// two
///             entries before the map and behind it, which are none
/// visit       false ends the walk
/// cost        O(entries visited), each once: chains have no cycles
template <class Repeats, class Visit>
void for_each_follower(Index at, std::vector<Index>& pending, Repeats&& repeats, Visit&& visit) {
  pending.clear();
  while (visit(at)) {
    for (const int d : {-2, -1, 1, 2})
      if (const std::int64_t from = std::int64_t{at} - d; repeats(from, d))
        pending.push_back(static_cast<Index>(from));
    if (pending.empty()) return;
    at = pending.back();
    pending.pop_back();
  }
}

/// Replaces every symbol by the wedge its chain ends at; restarts stay.
///
/// errors  corrupt when a chain leaves its strip or never ends; offset is the entry's index
/// cost    O(map size), however long the chains are
Result<std::vector<Index>> resolve(std::span<const Index> map);

/// Calls `visit(a, b, c)` with the three wedges of every triangle of a resolved index map, in map
/// order, wound as the mesh. A window of three entries is a triangle when its vertices
/// (`vertex_of(wedge)`) differ; the second, fourth … window of a strip is wound the other way and
/// visited as (second, first, third). [spec/strips.md §4]
template <class VertexOf, class Visit>
void for_each_triangle(std::span<const Index> resolved, VertexOf&& vertex_of, Visit&& visit) {
  std::size_t strip = 0;  // where the current strip starts
  for (std::size_t i = 0; i + 2 < resolved.size(); ++i) {
    const Index a = resolved[i], b = resolved[i + 1], c = resolved[i + 2];
    if (c == kRestart) {
      strip = i + 3;
      i += 2;
      continue;
    }
    if (a == kRestart || b == kRestart) {  // a strip of fewer than three entries
      strip = a == kRestart ? i + 1 : i + 2;
      continue;
    }
    const auto va = vertex_of(a), vb = vertex_of(b), vc = vertex_of(c);
    if (va == vb || vb == vc || va == vc) continue;
    if ((i - strip) % 2 == 0)
      visit(a, b, c);
    else
      visit(b, a, c);
  }
}

}  // namespace pstrips::inline core
