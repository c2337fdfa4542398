#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/progressive_strips.h"

namespace pstrips::inline converters {

/// What a progressive file shows after one of its packets, all meshes together.
struct InspectedLevel {
  Index packet = 0;  ///< how many packets have arrived; 0 is the base
  Index mesh = 0;    ///< whose packet it was
  std::uint64_t bytes_so_far =
      0;  ///< of the file up to the packet's end; 0 where there is no such thing
  std::uint64_t vertices = 0, triangles = 0;
  std::uint64_t strips = 0;  ///< of the map; of a map of triangles those that are derived
  /// By the degenerate-triangle-free display strips [Kim04 §4], or by those that are derived. These
  /// may be the ones of a level that lacks a 64th of the triangles.
  std::uint64_t vertices_sent = 0;
  double error = 0, one_sided_error = 0;  ///< of the scene, see SceneLevel
};

/// What a progressive file holds and what it costs.
struct Inspection {
  std::uint64_t vertices = 0, wedges = 0, triangles = 0, faces = 0, strips = 0, vsplits = 0;
  std::uint64_t map_entries = 0, map_offsets = 0;
  double places_per_vsplit = 0;  ///< u of [Kim04 §5]
  std::vector<InspectedLevel> levels;
  /// Strips of the map, or those derived of the last level, by the number of their entries: 3, 4 to
  /// 7, 8 to 15, 16 to 31 …
  std::vector<std::uint64_t> strip_lengths;
};

/// Replays a file level by level.
///
/// chunk_ends  where the last BASE and each packet end in the file; empty: not a binary file
/// cost        O(file and rewritten entries)
Inspection inspect(const ProgressiveStrips& strips,
                   const std::vector<std::uint64_t>& chunk_ends = {});

/// "3", "4-7", "8-15" … for the bins of Inspection::strip_lengths.
std::string strip_length_bin(std::size_t bin);

}  // namespace pstrips::inline converters
