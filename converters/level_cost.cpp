#include "converters/level_cost.h"

#include <array>
#include <utility>

#include "core/parallel.h"

namespace pstrips::inline converters {
namespace {

// Which vertices have become one, and when: sets that are joined by size, so that no vertex is more
// than log2 n below its root.
class MergeTimes {
 public:
  explicit MergeTimes(Index vertices) : nodes_(vertices), size_(vertices, 1) {
    for (Index v = 0; v < vertices; ++v) nodes_[v] = {v, kNone};
  }

  void join(Index a, Index b, Index time) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] > size_[b]) std::swap(a, b);
    nodes_[a] = {b, time};
    size_[b] += size_[a];
  }

  // When a and b became one; kNone: never. The times rise on the way to the root.
  Index time(Index a, Index b) const {
    Index last = 0;
    while (a != b) {
      if (nodes_[a].joined > nodes_[b].joined) std::swap(a, b);
      last = nodes_[a].joined;
      if (last == kNone) return kNone;
      a = nodes_[a].parent;
    }
    return last;
  }

 private:
  Index root(Index v) const {
    while (nodes_[v].parent != v) v = nodes_[v].parent;
    return v;
  }

  struct Node {
    Index parent, joined;
  };
  std::vector<Node> nodes_;
  std::vector<Index> size_;
};

}  // namespace

std::vector<std::uint8_t> level_step_cost(std::span<const Index> triangles, Index vertex_count,
                                          std::span<const Collapse> collapses, std::uint8_t cost,
                                          unsigned threads) {
  MergeTimes merged(vertex_count);
  for (Index i = 0; i < collapses.size(); ++i)
    merged.join(collapses[i].removed, collapses[i].kept, i);
  std::vector<std::uint8_t> out(triangles.size());
  constexpr std::size_t kGrain = 1 << 14;
  parallel_for(threads, triangles.size() / 3, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = 3 * begin; t < 3 * end; t += 3) {
      Index first = kNone;
      std::size_t vanishing = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index time = merged.time(triangles[t + k], triangles[t + (k + 1) % 3]);
        if (time >= first) continue;
        first = time;
        vanishing = k;
      }
      if (first != kNone) out[t + vanishing] = cost;
    }
  });
  return out;
}

}  // namespace pstrips::inline converters
