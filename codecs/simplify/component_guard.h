#pragma once

#include <span>
#include <vector>

#include "codecs/simplify/complex.h"

namespace pstrips::inline codecs {

/// Keeps components from vanishing: of each at least four triangles stay, a tetrahedron if it was
/// closed, or all if it had fewer. A component is what triangles with common vertices are.
class ComponentGuard {
 public:
  /// Cost O(triangles).
  explicit ComponentGuard(const Complex& complex);

  /// How many triangles have to be left, and one more where two go at a time.
  std::uint64_t least_triangles() const;
  /// Whether the component of a vertex can do without so many triangles.
  bool can_lose(Index vertex, Index triangles) const {
    const Index component = component_[vertex];
    return live_[component] >= triangles + least_[component];
  }
  void lose(Index vertex, Index triangles) { live_[component_[vertex]] -= triangles; }

 private:
  std::vector<Index> component_;     // of each vertex, named by one of its vertices
  std::vector<Index> live_, least_;  // of each component, in triangles
};

}  // namespace pstrips::inline codecs
