#include "codecs/compact/batches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pstrips::inline codecs {

std::vector<Index> batches_of(std::span<const Collapse> collapses, Index vertices,
                              const BatchOptions& options, Index most_batches) {
  std::vector<Index> batch(collapses.size(), kNone);
  std::vector<Index> left(collapses.size());
  std::iota(left.begin(), left.end(), Index{0});
  std::vector<Index> taken(vertices, kNone);  // the last batch in which the vertex stands aside
  const Index all = vertices;
  for (Index number = 0; !left.empty() && number < most_batches; ++number) {
    const Index most = options.schedule.at(vertices, all).most_of(vertices);
    const auto wanted = static_cast<std::size_t>(std::ceil(options.window * most));
    const std::size_t window = std::min(left.size(), std::max(wanted, std::size_t{1}));
    std::vector<Index> later;
    later.reserve(left.size());
    std::size_t in_batch = 0, at = 0;
    for (; at < window && in_batch < most; ++at) {
      const Collapse& pair = collapses[left[at]];
      const bool free = taken[pair.kept] != number && taken[pair.removed] != number;
      // What shares a vertex with a collapse that waits has to wait as well.
      taken[pair.kept] = taken[pair.removed] = number;
      if (free) {
        batch[left[at]] = number;
        ++in_batch;
      } else {
        later.push_back(left[at]);
      }
    }
    later.insert(later.end(), left.begin() + static_cast<std::ptrdiff_t>(at), left.end());
    left.swap(later);
    vertices -= static_cast<Index>(in_batch);
  }
  return batch;
}

CollapseForest::CollapseForest(std::span<const Collapse> collapses, std::span<const Index> batch,
                               Index vertices)
    : vertices_(vertices), sequence_(collapses.size()) {
  std::iota(sequence_.begin(), sequence_.end(), Index{0});
  std::ranges::stable_sort(sequence_, {}, [&](Index i) { return batch[i]; });
  std::vector<Index> node(vertices);
  std::iota(node.begin(), node.end(), Index{0});
  inner_.reserve(collapses.size());
  std::vector<bool> has_parent(vertices + collapses.size());
  for (const Index i : sequence_) {
    const Collapse& pair = collapses[i];
    inner_.push_back({node[pair.kept], node[pair.removed], batch[i]});
    has_parent[node[pair.kept]] = has_parent[node[pair.removed]] = true;
    node[pair.kept] = static_cast<Index>(vertices + inner_.size() - 1);
  }
  for (Index n = 0; n < has_parent.size(); ++n)
    if (!has_parent[n]) roots_.push_back(n);
  number_leaves();
}

void CollapseForest::number_leaves() {
  first_leaf_.resize(vertices_ + inner_.size());
  end_leaf_.resize(first_leaf_.size());
  Index leaf = 0;
  std::vector<Index> open;  // nodes to number; a node comes up a second time when its leaves have
  std::vector<bool> begun(first_leaf_.size());
  for (const Index root : roots_) {
    open.push_back(root);
    while (!open.empty()) {
      const Index node = open.back();
      if (begun[node] || is_leaf(node)) {
        if (is_leaf(node)) first_leaf_[node] = leaf++;
        end_leaf_[node] = leaf;
        open.pop_back();
        continue;
      }
      begun[node] = true;
      first_leaf_[node] = leaf;
      open.push_back(removed(node));
      open.push_back(kept(node));
    }
  }
}

Index CollapseForest::root_of(Index leaf) const {
  const auto after =
      std::ranges::upper_bound(roots_, leaf, {}, [&](Index r) { return first_leaf_[r]; });
  return static_cast<Index>(after - roots_.begin() - 1);
}

}  // namespace pstrips::inline codecs
