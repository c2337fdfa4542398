#include "codecs/stripify/few_strips.h"

#include <algorithm>

#include "codecs/stripify/path_index.h"
#include "codecs/stripify/random.h"

namespace pstrips::inline codecs {
namespace {

using HalfEdge = LinkedPaths::HalfEdge;

class Joiner {
 public:
  Joiner(LinkedPaths& paths, const StripOptions& options)
      : paths_(paths),
        index_(paths),
        random_(options.seed),
        stop_(options.stop),
        moves_left_(static_cast<std::int64_t>(options.effort) * paths.triangle_count()),
        place_of_(paths.triangle_count(), kNone),
        seen_(paths.triangle_count()),
        distance_(paths.triangle_count()) {
    for (Index t = 0; t < paths.triangle_count(); ++t)
      if (paths.is_end(t)) add_end(t);
  }

  void run() {
    for (std::size_t walks = 1; moves_left_ > 0 && !ends_.empty(); ++walks) {
      if (walks % kWalksBetweenAsking == 0 && stop_ && stop_()) break;
      walk(ends_[random_.below(static_cast<Index>(ends_.size()))]);
    }
  }

 private:
  static constexpr std::size_t kWalksBetweenAsking = 16;
  static constexpr int kMovesAFlip = 2;  // takes as long as so many tries
  static constexpr int kMaxSlides = 300;
  static constexpr int kMaxSlidesAside = 40;  // without coming nearer
  // Scores are in eighths of a dual edge.
  static constexpr Index kEdge = 8, kNoise = 16, kSwap = 8, kOnTarget = 24;

  struct Slide {
    HalfEdge link, cut;
  };

  void add_end(Index t) {
    place_of_[t] = static_cast<Index>(ends_.size());
    ends_.push_back(t);
  }
  void remove_end(Index t) {
    const Index place = place_of_[t];
    if (place == kNone) return;
    ends_[place] = ends_.back();
    place_of_[ends_[place]] = place;
    ends_.pop_back();
    place_of_[t] = kNone;
  }
  void update_end(Index t) {
    if (!paths_.is_end(t))
      remove_end(t);
    else if (place_of_[t] == kNone)
      add_end(t);
  }

  Index neighbor(HalfEdge h) const { return LinkedPaths::triangle_of(paths_.opposite(h)); }

  void flip(HalfEdge h) {
    index_.flip(h);
    moves_left_ -= kMovesAFlip;
    update_end(LinkedPaths::triangle_of(h));
    update_end(neighbor(h));
  }

  // Calls visit(triangle) for every triangle around `from`, nearest first, until it gives false;
  // fills distance_ and seen_.
  template <class Visit>
  void search(Index from, Visit&& visit) {
    ++search_;
    queue_.assign(1, from);
    seen_[from] = search_;
    distance_[from] = 0;
    for (std::size_t i = 0; i < queue_.size() && visit(queue_[i]); ++i)
      for (Index k = 0; k < 3; ++k) {
        const HalfEdge h = LinkedPaths::half_edge(queue_[i], k);
        if (!paths_.has_opposite(h)) continue;
        const Index n = neighbor(h);
        if (seen_[n] == search_) continue;
        seen_[n] = search_;
        distance_[n] = distance_[queue_[i]] + 1;
        queue_.push_back(n);
      }
    moves_left_ -= static_cast<std::int64_t>(queue_.size() / 8 + 1);
  }

  bool has_free_edge(Index t) const {
    for (Index k = 0; k < 3; ++k) {
      const HalfEdge h = LinkedPaths::half_edge(t, k);
      if (paths_.has_opposite(h) && !paths_.is_linked(h)) return true;
    }
    return false;
  }

  void walk(Index t) {
    const Index mate = index_.mate(t);
    Index target = kNone;
    bool is_alone = true;
    // A slide is two steps and a join is one: without an odd vertex in between, as in a regular
    // grid, only ends at an odd distance can be joined, and they may not be the nearest.
    const bool odd_only = random_.below(4) == 0;
    search(t, [&](Index n) {
      if (n == t || n == mate || !paths_.is_end(n)) return true;
      is_alone = false;
      if ((odd_only && distance_[n] % 2 == 0) || !has_free_edge(n)) return true;
      target = n;
      return false;
    });
    if (target == kNone) {
      if (is_alone) remove_end(t);
      return;
    }
    const Index reach = distance_[target] + 4;
    search(target, [&](Index n) { return distance_[n] < reach; });

    Slide last{kNone, kNone};
    Index nearest = distance_[t];
    int aside = 0;
    for (int slides = 0; slides < kMaxSlides && aside < kMaxSlidesAside; ++slides) {
      if (try_join(t)) return;
      const Slide slide = best_slide(t, target, last, reach);
      if (slide.link == kNone) return;
      flip(slide.cut);
      flip(slide.link);
      last = slide;
      t = neighbor(slide.cut);
      const Index distance = seen_[t] == search_ ? distance_[t] : reach;
      aside = distance < nearest ? 0 : aside + 1;
      nearest = std::min(nearest, distance);
    }
  }

  bool try_join(Index t) {
    HalfEdge best = kNone;
    int fewest_swaps = 0;
    for (Index k = 0; k < 3; ++k) {
      const HalfEdge h = LinkedPaths::half_edge(t, k);
      if (!paths_.has_opposite(h) || paths_.is_linked(h)) continue;
      const Index n = neighbor(h);
      if (!paths_.is_end(n) || index_.mate(t) == n) continue;
      const int swaps = paths_.link_cost(h);
      if (best != kNone && swaps >= fewest_swaps) continue;
      best = h;
      fewest_swaps = swaps;
    }
    if (best == kNone) return false;
    flip(best);
    return true;
  }

  Slide best_slide(Index t, Index target, const Slide& last, Index reach) {
    Slide best{kNone, kNone};
    Index best_score = 0;
    for (Index k = 0; k < 3; ++k) {
      const HalfEdge h = LinkedPaths::half_edge(t, k);
      if (!paths_.has_opposite(h) || paths_.is_linked(h)) continue;
      const Index n = neighbor(h);
      if (paths_.is_single(n)) continue;
      const HalfEdge first = paths_.first_link(n);
      for (HalfEdge cut = first; cut != kNone;
           cut = cut == first ? paths_.other_link(first) : kNone) {
        --moves_left_;
        const bool undoes = last.link != kNone && h == paths_.opposite(last.cut) &&
                            paths_.opposite(cut) == last.link;
        if (undoes) continue;
        const Index new_end = neighbor(cut);
        const Index distance = seen_[new_end] == search_ ? distance_[new_end] : reach + 2;
        const int before = paths_.link_cost(cut);
        paths_.flip(cut);
        const int swaps = paths_.link_cost(h) - before;
        paths_.flip(cut);
        const Index score = kEdge * (distance + 6) + random_.below(kNoise + 1) +
                            static_cast<Index>(static_cast<int>(kSwap) * swaps) +
                            (new_end == target ? kOnTarget : 0);
        if (best.link != kNone && score >= best_score) continue;
        const HalfEdge kept = paths_.other_link(cut);
        if (kept != kNone && index_.end_over(kept) == t) continue;  // would be a cycle
        best = {h, cut};
        best_score = score;
      }
    }
    return best;
  }

  LinkedPaths& paths_;
  PathIndex index_;
  Random random_;
  const std::function<bool()>& stop_;
  std::int64_t moves_left_;
  std::vector<Index> ends_, place_of_;  // the ends that may still find another
  std::vector<Index> seen_, distance_, queue_;
  Index search_ = 0;
};

}  // namespace

void join_strips(LinkedPaths& paths, const StripOptions& options) { Joiner(paths, options).run(); }

}  // namespace pstrips::inline codecs
