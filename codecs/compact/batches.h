#pragma once

#include <span>
#include <vector>

#include "codecs/collapse.h"
#include "core/progressive_strips.h"

namespace pstrips::inline codecs {

struct BatchOptions {
  /// subset: coarse vertices stand where the kept vertices of the source stand. optimal: a vertex
  /// stands in the middle of the two that it becomes, whatever the collapses say: about as many
  /// bits, and levels that are twice as far from the source.
  Placement placement = Placement::subset;
  BatchSchedule schedule = {};
  /// A batch is chosen from the next collapses, so many times its size; `cheapest` does not count.
  /// Sequences that fall into batches want little, others 2.
  double window = 1.2;
  /// A coarsest batch with less than this share of what it might have is left to the base: a packet
  /// has its price.
  double least_share = 0;
};

/// The batch of each collapse, 0 the finest. In a batch no vertex takes part in two collapses, so
/// that their order is free; across batches the sequence's order holds wherever two collapses
/// share a vertex. Cost O(vertices + collapses) a batch.
///
/// most  so many batches; collapses for which there is none are in batch kNone
std::vector<Index> batches_of(std::span<const Collapse> collapses, Index vertices,
                              const BatchOptions& options, Index most = kNone);

/// The collapses of a sequence as a forest: leaves are the vertices of the source, an inner node
/// is what two vertices became. Node numbers: vertices, then collapses, fine batches first.
class CollapseForest {
 public:
  CollapseForest(std::span<const Collapse> collapses, std::span<const Index> batch, Index vertices);

  static constexpr Index kLeafBatch = kNone;

  bool is_leaf(Index node) const { return node < vertices_; }
  Index kept(Index node) const { return inner_[node - vertices_].kept; }
  Index removed(Index node) const { return inner_[node - vertices_].removed; }
  Index batch(Index node) const {
    return is_leaf(node) ? kLeafBatch : inner_[node - vertices_].batch;
  }
  std::span<const Index> roots() const { return roots_; }  ///< ascending leaves
  Index vertices() const { return vertices_; }
  Index collapses() const { return static_cast<Index>(inner_.size()); }
  /// The inner nodes, fine batches first, each by its collapse's number in the sequence.
  std::span<const Index> sequence() const { return sequence_; }

  /// The leaves below a node are those with numbers first_leaf to end_leaf - 1.
  Index leaf_of(Index vertex) const { return first_leaf_[vertex]; }
  bool holds(Index node, Index leaf) const {
    return leaf >= first_leaf_[node] && leaf < end_leaf_[node];
  }
  /// The root above a leaf, as a number into roots().
  Index root_of(Index leaf) const;

 private:
  struct Inner {
    Index kept, removed, batch;
  };
  void number_leaves();

  Index vertices_;
  std::vector<Inner> inner_;
  std::vector<Index> sequence_, roots_, first_leaf_, end_leaf_;
};

}  // namespace pstrips::inline codecs
