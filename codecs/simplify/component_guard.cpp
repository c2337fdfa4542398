#include "codecs/simplify/component_guard.h"

#include <algorithm>
#include <numeric>

namespace pstrips::inline codecs {
namespace {

constexpr Index kLeast = 4;

Index find(std::vector<Index>& parent, Index v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

ComponentGuard::ComponentGuard(const Complex& complex)
    : component_(complex.vertex_count()), live_(complex.vertex_count(), 0) {
  std::iota(component_.begin(), component_.end(), Index{0});
  const std::vector<Index>& corners = complex.corner_vertex;
  for (std::size_t c = 0; c < corners.size(); c += 4)
    for (std::size_t k = 1; k < 3; ++k) {
      const Index a = find(component_, corners[c]), b = find(component_, corners[c + k]);
      component_[std::max(a, b)] = std::min(a, b);
    }
  for (Index v = 0; v < component_.size(); ++v) component_[v] = find(component_, v);
  for (std::size_t c = 0; c < corners.size(); c += 4) ++live_[component_[corners[c]]];
  for (const Index live : live_) least_.push_back(std::min(live, kLeast));
}

std::uint64_t ComponentGuard::least_triangles() const {
  std::uint64_t sum = 0;
  for (const Index live : live_) sum += std::min(live, kLeast + 1);
  return sum;
}

}  // namespace pstrips::inline codecs
