#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh.h"
#include "core/strips.h"

namespace pstrips::inline codecs {

/// Triangles to cover, as triples of wedges. An edge joins two triangles only where both of its
/// wedges are the same, so strips never cross an attribute seam; nor do they cross groups.
struct StripInput {
  std::span<const Index> triangles;  ///< 3 n wedges < wedge_count, the three of a triangle distinct
  std::span<const Index> group;      ///< one a triangle; empty: all in group 0
  Index wedge_count = 0;
  std::span<const double> positions = {};  ///< 3 a wedge, all finite, or empty: shape unknown
  /// What a step over an edge costs beside a swap, in indices, for each half-edge: corner k of
  /// triangle t to the next is at 3 t + k. Both half-edges of an edge count. Empty: nothing.
  std::span<const std::uint8_t> step_cost = {};
};

/// Faces of three and more corners, before their diagonals are chosen; joined as in StripInput.
struct PolygonInput {
  std::span<const Index> corners;     ///< wedges < wedge_count, those of a face distinct
  std::span<const Index> face_first;  ///< faces + 1 places in `corners`, rising by 3 or more
  std::span<const Index> group;       ///< one a face; empty: all in group 0
  Index wedge_count = 0;
  std::span<const double> positions = {};  ///< 3 a wedge, all finite, or empty: faces are convex
};

/// What `best` brings down. Few strips take many swaps, and the other way round.
enum class StripGoal : std::uint8_t { indices, strips };

/// Which strips `multi-path-weighted` prefers. [Vanecek05 §5]
enum class StripWeight : std::uint8_t { topological, axis };

// Effort of `best`, in moves tried per triangle; the result depends on nothing but the input and
// the options. On a mesh of 70,000 triangles about 0.03, 2 and 10 seconds; few strips take up to
// twice as long.
inline constexpr std::uint32_t kEffortFast = 1;
inline constexpr std::uint32_t kEffortHigh = 500;
inline constexpr std::uint32_t kEffortMax = 2500;

inline constexpr std::uint32_t kMaxStripPrice = 1000;

struct StripOptions {
  std::uint32_t seed = 1;  ///< for the algorithms that choose at random; same seed, same strips
  StripGoal goal = StripGoal::indices;
  std::uint32_t effort = kEffortFast;
  /// What a strip costs beside its triangles and swaps, in indices: two entries and a restart. A
  /// higher price gives fewer strips and more indices; StripGoal::strips is any price.
  std::uint32_t strip_price = 3;
  StripWeight weight = StripWeight::topological;
  /// Most edges of a tunnel; 0: no tunnels. The longer, the fewer strips and the more swaps;
  /// Stewart found little more beyond 75 on bunny.
  std::uint32_t tunnel_length = 75;
  /// Steps of all searches for tunnels together, a triangle; 2 to 5 are enough for most meshes.
  std::uint32_t tunnel_effort = 32;
  /// Called every few thousand steps of a long search; true ends it with the best strips so far.
  /// The only way for time to change a result. May be empty.
  std::function<bool()> stop = {};
};

/// An index map without symbols: strips in ascending order of group, parted by kRestart (none at
/// the end). Every triangle appears once with its winding; see for_each_triangle.
using Strips = std::vector<Index>;

using Stripifier = Strips (*)(const StripInput&, const StripOptions&);

/// Every face appears once, as the triangles of one of its triangulations.
using PolygonStripifier = Strips (*)(const PolygonInput&, const StripOptions&);

struct NamedStripifier {
  std::string_view name;    ///< as on the command line
  std::string_view source;  ///< key in spec/references.md and section, or where ours is described
  Stripifier run;
  PolygonStripifier run_polygons = nullptr;  ///< nullptr: takes triangles only
  bool honors_goal = false;                  ///< StripOptions::goal changes what it does
  bool honors_weight = false;                ///< and StripOptions::weight
  bool uses_positions = false;
};

/// All algorithms, in the order in which help lists them.
std::span<const NamedStripifier> stripifiers();

/// nullptr when there is no such name.
const NamedStripifier* find_stripifier(std::string_view name);

/// Strips over points that have no triangles yet: x y z a point; entries are points.
using PointStripifier = Strips (*)(std::span<const double> positions, const StripOptions&);

struct NamedPointStripifier {
  std::string_view name;
  std::string_view source;
  PointStripifier run;
};

std::span<const NamedPointStripifier> point_stripifiers();

/// nullptr when there is no such name.
const NamedPointStripifier* find_point_stripifier(std::string_view name);

}  // namespace pstrips::inline codecs
