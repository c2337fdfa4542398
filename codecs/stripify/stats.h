#pragma once

#include <cstdint>
#include <span>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// The figures of an index map without symbols whose strips all have triangles.
struct StripStats {
  std::uint64_t triangles = 0;
  std::uint64_t strips = 0;
  std::uint64_t singletons = 0;    ///< strips of one triangle
  std::uint64_t swaps = 0;         ///< entries that bring no triangle, beyond a strip's first two
  std::uint64_t entries = 0;       ///< without restarts: triangles + 2 strips + swaps
  std::uint64_t indices_sent = 0;  ///< with restarts
  double acmr16 = 0;               ///< see cache_misses_per_triangle
};

StripStats strip_stats(std::span<const Index> strips);

/// Average cache miss ratio: loads into a first-in first-out cache of `cache_entries` transformed
/// wedges, over triangles. Restarts leave the cache alone. 0 without triangles.
double cache_misses_per_triangle(std::span<const Index> strips, std::uint32_t cache_entries);

}  // namespace pstrips::inline codecs
