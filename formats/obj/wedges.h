#pragma once

#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline formats::obj {

/// The corners of a file and the tuples they refer to.
struct CornerTuples {
  Index vertex_count = 0;
  std::span<const Index> corner_vertex;          ///< < vertex_count
  std::span<const Index> corner_texcoord;        ///< vt or kNone, one a corner; empty: none
  std::span<const Index> corner_normal;          ///< vn or kNone, one a corner; empty: none
  std::span<const double> texcoord;              ///< three a vt
  std::span<const std::uint8_t> texcoord_flags;  ///< one a vt
  std::span<const double> normal;                ///< three a vn
};

struct WedgeTable {
  std::vector<Index> vertex;            ///< one a wedge, ascending
  std::vector<Index> texcoord, normal;  ///< one a wedge: a vt or vn with its value, or kNone
  std::vector<bool> cornerless;         ///< one a wedge: no corner names it
  std::vector<Index> corners;           ///< a wedge for each corner

  bool has_corner(std::size_t wedge) const { return !cornerless[wedge]; }
};

/// Two corners share a wedge when vertex, texture coordinate (flags included) and normal have the
/// same bits. Wedges ascend by vertex, then by their first corner; each vertex has at least one.
/// Cost O(corners · log of the most corners at a vertex), whatever the values.
WedgeTable build_wedges(const CornerTuples& in);

}  // namespace pstrips::inline formats::obj
