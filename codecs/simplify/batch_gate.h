#pragma once

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "codecs/collapse.h"
#include "codecs/simplify/vertex_buckets.h"
#include "core/mesh.h"

namespace pstrips::inline codecs {

/// Lets collapses through batch by batch: one that shares a vertex with another of the batch has to
/// wait for the next. A batch ends when it is full, and when what is left costs too much.
class BatchGate {
 public:
  /// keys  of all vertices, what each would cost; infinite: it does not collapse
  BatchGate(const BatchSchedule& schedule, std::vector<float> keys)
      : schedule_(schedule),
        keys_(std::move(keys)),
        batch_of_(keys_.size(), 0),
        left_(static_cast<Index>(keys_.size())) {}

  /// Begins a batch; returns the queue of what may collapse in it. Cost O(vertices).
  VertexBuckets next_batch();

  bool is_taken(Index vertex) const { return batch_of_[vertex] == batch_; }
  bool is_empty() const { return taken_ == 0; }
  /// So few collapses were let through that batches are not worth their cost: around one vertex
  /// that is everybody's neighbour there is one a batch.
  bool is_stuck() const { return taken_ < left_ / 64; }
  std::span<const float> keys() const { return keys_; }
  /// queue  as after its pop()
  bool is_full(const VertexBuckets& queue) const {
    return taken_ >= most_ || (taken_ > 0 && queue.limit() > limit_);
  }
  /// What a vertex costs if all its edges count.
  void set_key(Index vertex, float key) { keys_[vertex] = key; }
  void take(Index removed, Index kept) {
    keys_[removed] = std::numeric_limits<float>::infinity();
    batch_of_[removed] = batch_of_[kept] = batch_;
    ++taken_;
    --left_;
  }

 private:
  BatchSchedule schedule_;
  std::vector<float> keys_;
  std::vector<Index> batch_of_;  // in which each vertex took part last
  Index batch_ = 0, left_, taken_ = 0, most_ = 0;
  float limit_ = 0;
};

inline VertexBuckets BatchGate::next_batch() {
  ++batch_;
  taken_ = 0;
  const BatchShares& shares = schedule_.at(left_, static_cast<Index>(keys_.size()));
  most_ = shares.most_of(left_);
  std::vector<float> finite;
  std::ranges::copy_if(keys_, std::back_inserter(finite),
                       [](float key) { return key < std::numeric_limits<float>::infinity(); });
  limit_ = std::numeric_limits<float>::infinity();
  if (const auto at =
          static_cast<std::size_t>(shares.cheapest * static_cast<double>(finite.size()));
      at < finite.size()) {
    std::ranges::nth_element(finite, finite.begin() + static_cast<std::ptrdiff_t>(at));
    limit_ = VertexBuckets::limit_of(finite[at]);
  }
  return VertexBuckets(keys_);
}

}  // namespace pstrips::inline codecs
