#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline core {

/// Tetrahedra over points; (b - a) × (c - a) · (d - a) > 0 where abcd is not turned over.
struct TetraMesh {
  std::vector<double> positions;  ///< x y z of each vertex
  std::vector<Index> tetrahedra;  ///< four vertices each

  Index vertex_count() const { return static_cast<Index>(positions.size() / 3); }
  std::size_t tetra_count() const { return tetrahedra.size() / 4; }
  friend bool operator==(const TetraMesh&, const TetraMesh&) = default;
};

using Tetra = std::array<Index, 4>;

/// Generalized tetrahedral strips, one after the other. A strip's first four entries are a
/// tetrahedron. Each further entry is a vertex; it replaces one of the four before it, which makes
/// the next tetrahedron. [King01; spec/tetra.md]
struct TetraStrips {
  std::vector<Index> vertices;
  /// One an entry: 0 in the first four of a strip, else 1 to 4: which of the four vertices goes.
  /// Those after it move up and the new one is the fourth.
  std::vector<std::uint8_t> replaced;
  friend bool operator==(const TetraStrips&, const TetraStrips&) = default;
};

/// Calls `visit(const Tetra&, bool is_first)` with each tetrahedron, oriented as in its mesh;
/// `is_first` at the start of a strip.
/// Precondition: the strips are whole, as TetraStrips says.
template <class Visit>
void for_each_tetra(const TetraStrips& strips, Visit&& visit) {
  assert(strips.vertices.size() == strips.replaced.size());
  Tetra window{};
  bool is_odd = false;
  for (std::size_t i = 0; i < strips.vertices.size(); ++i) {
    const unsigned slot = strips.replaced[i];
    if (slot == 0) {
      for (Index& v : window) v = strips.vertices[i++];
      is_odd = false;
      visit(std::as_const(window), true);
      --i;
      continue;
    }
    // The new vertex is on the other side of the face that stays, and a vertex that moves from
    // position `slot` to the fourth passes 4 - slot others.
    for (unsigned k = slot; k < 4; ++k) window[k - 1] = window[k];
    window[3] = strips.vertices[i];
    is_odd = is_odd != (slot % 2 == 0);
    if (is_odd)
      visit(Tetra{window[1], window[0], window[2], window[3]}, false);
    else
      visit(std::as_const(window), false);
  }
}

}  // namespace pstrips::inline core
