#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/strips.h"

namespace pstrips::inline codecs {

// What a renderer is sent at some level: generalized strips of wedges, parted by kRestart, whose
// triangles are exactly those of the index map, each with its winding (for_each_triangle of
// both gives the same multiset). A strip of the index map is filtered by itself, so a decoder
// filters only the strips that changed.

using DisplayStrips = std::vector<Index>;

/// How a strip of the index map becomes display strips.
enum class Filter : std::uint8_t {
  /// All entries. [Kim04 §5]
  none,
  /// The simple triangle strip scanner: drops the first two of four entries (a b a b), a = b
  /// included, until there are none left. The paper shortens runs (a a)+ whatever their length,
  /// which turns the winding after an odd one; dropping pairs keeps it. [Kim04 §2.3]
  stss,
  /// The degenerate triangle-free scanner with local strip reordering: takes the valid triangles
  /// (a b c), (d e f) … of the strip in turn and joins consecutive ones by one entry where (d e) is
  /// (b c), by two where (d e) is (c b), else starts a new strip; a strip that would start
  /// clockwise
  /// repeats its first entry. Unlike the paper, wedges are compared, so that a seam parts strips,
  /// and so is parity, so that triangles of conflicting winding do. [Kim04 §4]
  dtfs,
};

struct NamedFilter {
  std::string_view name;    ///< as on a command line
  std::string_view source;  ///< key and section in spec/references.md
  Filter filter;
};

/// "none", "stss" and "dtfs".
std::span<const NamedFilter> display_filters();

/// Nothing when there is no such name.
std::optional<Filter> find_display_filter(std::string_view name);

/// Appends one strip of the index map to the display strips.
///
/// strip         resolved entries without restarts, any number, each < wedge count of the level
/// wedge_vertex  vertex of each wedge at the level; empty: wedge i is vertex i
/// out           gets at most 4 entries and a restart a triangle; nothing for a strip without
///               triangles (Filter::none and Filter::stss may keep degenerate entries of it)
/// cost          O(entries), no allocation but for the growth of `out`
void append_filtered(Filter filter, std::span<const Index> strip,
                     std::span<const Index> wedge_vertex, DisplayStrips& out);

/// Filters a whole resolved index map.
DisplayStrips filter_strips(std::span<const Index> resolved, std::span<const Index> wedge_vertex,
                            Filter filter);

struct DisplayCost {
  std::uint64_t vertices_sent = 0;  ///< entries without restarts, as the paper counts
  std::uint64_t restarts = 0;       ///< beside them
};

DisplayCost display_cost(std::span<const Index> display);

}  // namespace pstrips::inline codecs
