#include "core/edge_pairs.h"

#include <algorithm>

#include "core/group_by.h"

namespace pstrips::inline core {
namespace {

struct Listed {
  Index high, half_edge;
};
struct Unpaired {
  Index low = kNone, half_edge = kNone;
};

// Half-edges between a wedge and higher ones, in ascending order.
Grouped<Listed> list_by_lower(std::span<const Index> corners, Index wedges) {
  return group_each<Listed>(wedges, [&](auto&& visit) {
    for (Index h = 0; h < corners.size(); h += 3) {
      const Index a = corners[h], b = corners[h + 1], c = corners[h + 2];
      visit(std::min(a, b), [&] { return Listed{std::max(a, b), h}; });
      visit(std::min(b, c), [&] { return Listed{std::max(b, c), h + 1}; });
      visit(std::min(c, a), [&] { return Listed{std::max(c, a), h + 2}; });
    }
  });
}

}  // namespace

std::vector<Index> pair_half_edges(std::span<const Index> corners, std::span<const Index> group,
                                   Index wedges) {
  const Grouped<Listed> of_lower = list_by_lower(corners, wedges);
  // Precondition: they are between the same wedges.
  const auto can_pair = [&](Index a, Index b) {
    return corners[a] != corners[b] && (group.empty() || group[a / 3] == group[b / 3]);
  };
  std::vector<Index> opposite(corners.size(), kNone);
  std::vector<Unpaired> last(wedges);  // in the lists so far, to each higher wedge
  for (Index low = 0; low < of_lower.keys(); ++low)
    for (const auto [high, h] : of_lower[low]) {
      Unpaired& before = last[high];
      if (before.low == low && can_pair(before.half_edge, h)) {
        opposite[h] = before.half_edge;
        opposite[before.half_edge] = h;
        before.low = kNone;
      } else {
        before = {low, h};
      }
    }
  return opposite;
}

}  // namespace pstrips::inline core
