#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "codecs/stripify/face_strips.h"

namespace pstrips::inline codecs {

/// The faces that no strip has taken yet, by number of free neighbours; FreeTriangles for polygons.
/// Beyond kMany neighbours all are filed as equal.
class FreeFaces {
 public:
  explicit FreeFaces(const StripFaces& faces) : faces_(faces), degree_(faces.count()) {
    for (Index f = faces.count(); f-- > 0;) {  // backwards, so that the lowest is on top
      for (Index h = faces.first[f]; h < faces.first[f + 1]; ++h)
        degree_[f] += faces.opposite[h] != kNone;
      file(f);
    }
  }

  bool contains(Index f) const { return degree_[f] != kNone; }
  /// Edges over which a free face follows. Precondition: contains(f).
  Index degree(Index f) const { return degree_[f]; }

  void take(Index f) {
    degree_[f] = kNone;
    for (Index h = faces_.first[f]; h < faces_.first[f + 1]; ++h) {
      const Index n = faces_.neighbor(h);
      if (n == kNone || !contains(n)) continue;
      if (--degree_[n] < kMany) file(n);
    }
  }

  /// A free face of lowest degree, the one filed last; kNone when none is left.
  Index lowest() {
    for (Index d = 0; d <= kMany; ++d)
      for (std::vector<Index>& bucket = buckets_[d]; !bucket.empty(); bucket.pop_back())
        if (contains(bucket.back()) && std::min(degree_[bucket.back()], kMany) == d)
          return bucket.back();
    return kNone;
  }

 private:
  static constexpr Index kMany = 8;
  void file(Index f) { buckets_[std::min(degree_[f], kMany)].push_back(f); }

  const StripFaces& faces_;
  std::vector<Index> degree_;
  std::array<std::vector<Index>, kMany + 1> buckets_;
};

/// Greedy strips of free faces. Every face is taken once, by the strip that was there first.
class FaceWalk {
 public:
  explicit FaceWalk(const StripFaces& faces) : faces_(faces), free_(faces) {}

  FreeFaces& free() { return free_; }
  const FreeFaces& free() const { return free_; }

  bool is_free_over(Index h) const {
    const Index n = faces_.neighbor(h);
    return n != kNone && free_.contains(n);
  }
  /// The fewest free neighbours among the free neighbours of the face over h; kNone without any.
  /// Of a large face only the first kFarEnough edges count, for the sake of time.
  Index lowest_degree_beyond(Index h) const {
    const Index n = faces_.neighbor(h);
    const Index end = std::min(faces_.first[n + 1], faces_.first[n] + kFarEnough);
    Index lowest = kNone;
    for (Index g = faces_.first[n]; g < end; ++g)
      if (is_free_over(g)) lowest = std::min(lowest, free_.degree(faces_.neighbor(g)));
    return lowest;
  }

  /// Begins a strip with a free face, or with a row of them (taken already, joined).
  void start(Index face) {
    free_.take(face);
    strip_.assign(1, {face, kNone, kNone});
  }
  void start(std::vector<FaceVisit> row) { strip_ = std::move(row); }

  /// Lets the strip grow at its end as long as a free face follows that it can pass: to the one
  /// with the lowest rank(exit, swaps), the first in order around the face among equals.
  template <class Rank>
  void grow(Rank&& rank) {
    SwapCounts counts;
    for (std::size_t i = 0; i + 1 < strip_.size(); ++i) counts = pass(faces_, strip_[i], counts);
    for (;;) {
      FaceVisit& last = strip_.back();
      Index best = kNone;
      decltype(rank(Index{}, std::uint32_t{})) best_rank{};
      SwapCounts best_counts;
      for (Index h = faces_.first[last.face]; h < faces_.first[last.face + 1]; ++h) {
        if (h == last.entry || !is_free_over(h)) continue;
        const SwapCounts after = pass(faces_, {last.face, last.entry, h}, counts);
        if (after.fewest() >= SwapCounts::kImpossible) continue;
        const auto h_rank = rank(h, after.fewest() - counts.fewest());
        if (best != kNone && best_rank <= h_rank) continue;
        best = h;
        best_rank = h_rank;
        best_counts = after;
      }
      if (best == kNone) return;
      last.exit = best;
      counts = best_counts;
      const Index next = faces_.neighbor(best);
      free_.take(next);
      strip_.push_back({next, faces_.opposite[best], kNone});
    }
  }

  /// So that grow() works on the other end.
  void reverse() {
    std::reverse(strip_.begin(), strip_.end());
    for (FaceVisit& visit : strip_) std::swap(visit.entry, visit.exit);
  }

  /// The strip at hand.
  const std::vector<FaceVisit>& strip() const { return strip_; }
  void finish() { visits_.insert(visits_.end(), strip_.begin(), strip_.end()); }
  const std::vector<FaceVisit>& visits() const { return visits_; }

 private:
  static constexpr Index kFarEnough = 16;

  const StripFaces& faces_;
  FreeFaces free_;
  std::vector<FaceVisit> strip_, visits_;
};

}  // namespace pstrips::inline codecs
