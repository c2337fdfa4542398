#include "codecs/filter/derived_strips.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

// Half-edge h = 3 t + k runs from corner k of triangle t to the next corner.
constexpr Index next_of(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr Index previous_of(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

struct Triangles {
  std::span<const Index> corners;
  std::span<const Index> group;  // ascending, or empty
  Index wedge_count;

  Index origin(Index h) const { return corners[h]; }
  Index target(Index h) const { return corners[next_of(h)]; }
  bool same_group(Index g, Index h) const { return group.empty() || group[g / 3] == group[h / 3]; }
  // One past the last triangle of the group of t.
  Index end_of_group(Index t) const {
    if (group.empty()) return static_cast<Index>(corners.size() / 3);
    return static_cast<Index>(std::upper_bound(group.begin() + t, group.end(), group[t]) -
                              group.begin());
  }
};

// The half-edge that each is paired with, or kNone. Half-edges between the same wedges come one
// after the other in the list of the lower one: each is paired with the last before it when that is
// free, of its group and runs the other way.
std::vector<Index> opposites(const Triangles& triangles) {
  std::vector<Index> out(triangles.corners.size(), kNone);
  const Grouped<Index> of_lower =
      group_by(triangles.wedge_count, triangles.corners.size(),
               [&](Index h) { return std::min(triangles.origin(h), triangles.target(h)); });
  std::vector<Index> last(triangles.wedge_count, kNone);  // half-edge to each wedge, or from it
  for (Index low = 0; low < of_lower.keys(); ++low)
    for (const Index h : of_lower[low]) {
      const bool rises = triangles.origin(h) == low;
      const Index high = rises ? triangles.target(h) : triangles.origin(h);
      const Index other = std::exchange(last[high], h);
      if (other == kNone) continue;
      const Index other_low = rises ? triangles.target(other) : triangles.origin(other);
      if (other_low != low || !triangles.same_group(other, h)) continue;
      out[h] = other;
      out[other] = h;
      last[high] = kNone;
    }
  return out;
}

// Triangles that no strip has yet, of one group after the other.
class FreeTriangles {
 public:
  explicit FreeTriangles(std::span<const Index> opposite)
      : opposite_(opposite), neighbors_(opposite.size() / 3) {
    for (Index h = 0; h < opposite.size(); ++h) neighbors_[h / 3] += opposite[h] != kNone;
  }

  // Those of the next group. Precondition: none is free of the groups before.
  void file(Index first, Index end) {
    unfiled_ = first;
    end_ = end;
    for (Index t = end; t-- > first;)
      if (neighbors_[t] < filed_.size()) filed_[neighbors_[t]].push_back(t);
  }

  bool contains(Index t) const { return neighbors_[t] != kTaken; }
  unsigned neighbors(Index t) const { return neighbors_[t]; }

  void take(Index t) {
    neighbors_[t] = kTaken;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (opposite_[h] == kNone) continue;
      const Index n = opposite_[h] / 3;
      if (contains(n)) filed_[--neighbors_[n]].push_back(n);
    }
  }

  // One of the group with the fewest free neighbours, of these the one that lost a neighbour last.
  Index lowest() {
    for (unsigned count = 0; count < filed_.size(); ++count)
      for (std::vector<Index>& filed = filed_[count]; !filed.empty(); filed.pop_back())
        if (neighbors_[filed.back()] == count) return filed.back();
    while (unfiled_ < end_ && !contains(unfiled_)) ++unfiled_;
    return unfiled_ < end_ ? unfiled_ : kNone;
  }

 private:
  static constexpr std::uint8_t kTaken = 4;
  std::span<const Index> opposite_;
  std::vector<std::uint8_t> neighbors_;      // free ones of each
  std::array<std::vector<Index>, 3> filed_;  // by free neighbours at that time
  Index unfiled_ = 0, end_ = 0;              // of the group
};

class StripMaker {
 public:
  StripMaker(const Triangles& triangles, std::span<const Index> opposite)
      : triangles_(triangles), opposite_(opposite), free_(opposite) {
    out_.reserve(triangles.corners.size() / 2);
  }

  DisplayStrips run() {
    const auto count = static_cast<Index>(triangles_.corners.size() / 3);
    for (Index first = 0, end; first < count; first = end) {
      end = triangles_.end_of_group(first);
      free_.file(first, end);
      for (Index seed; (seed = free_.lowest()) != kNone;) add_strip(seed);
    }
    return std::move(out_);
  }

 private:
  void add_strip(Index seed) {
    if (!out_.empty()) out_.push_back(kRestart);
    free_.take(seed);
    ahead_.clear();
    behind_.clear();
    grow(seed, kNone, kNone, ahead_);
    if (!ahead_.empty()) grow_behind(seed);
    join();
    write(seed);
  }

  // Goes on from triangle t, entered over `entry`; `straight` is the half-edge over which it would
  // be left without a swap. Either may be kNone.
  void grow(Index t, Index entry, Index straight, std::vector<Index>& exits) {
    for (;;) {
      Index exit = kNone;
      unsigned least = 0;
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        if (h == entry || opposite_[h] == kNone) continue;
        const Index n = opposite_[h] / 3;
        if (!free_.contains(n)) continue;
        const unsigned cost = 2 * free_.neighbors(n) + (h != straight ? 1 : 0);
        if (exit != kNone && least <= cost) continue;
        exit = h;
        least = cost;
      }
      if (exit == kNone) return;
      exits.push_back(exit);
      // Turns alternate; the first may go either way.
      const bool before = entry != kNone && exit == previous_of(entry);
      entry = opposite_[exit];
      t = entry / 3;
      free_.take(t);
      straight = before ? next_of(entry) : previous_of(entry);
    }
  }

  void grow_behind(Index seed) {
    const Index exit = ahead_[0];
    Index straight = kNone;
    if (ahead_.size() > 1)
      straight = ahead_[1] == previous_of(opposite_[exit]) ? previous_of(exit) : next_of(exit);
    grow(seed, exit, straight, behind_);
  }

  // Makes one path of both: `ahead_` from the end of what was behind.
  void join() {
    if (behind_.empty()) return;
    std::ranges::reverse(behind_);
    for (Index& exit : behind_) exit = opposite_[exit];
    behind_.insert(behind_.end(), ahead_.begin(), ahead_.end());
    std::swap(ahead_, behind_);
  }

  bool swaps_at_start() const {
    return ahead_.size() > 1 && ahead_[1] != previous_of(opposite_[ahead_[0]]);
  }

  void reverse() {
    std::ranges::reverse(ahead_);
    for (Index& exit : ahead_) exit = opposite_[exit];
  }

  void write(Index seed) {
    if (ahead_.empty()) {
      for (Index k = 0; k < 3; ++k) out_.push_back(triangles_.corners[3 * seed + k]);
      return;
    }
    if (swaps_at_start()) {
      reverse();
      if (swaps_at_start()) reverse();
    }
    // The last two entries are the edge that the strip stands on.
    Index older = triangles_.origin(ahead_[0]), newer = triangles_.target(ahead_[0]);
    out_.insert(out_.end(), {triangles_.origin(previous_of(ahead_[0])), older, newer});
    bool before = true;  // the turn that needs no swap
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
      const Index entry = opposite_[ahead_[i]];
      if (i + 1 < ahead_.size() && (ahead_[i + 1] == previous_of(entry)) != before) {
        out_.push_back(older);
        std::swap(older, newer);
        before = !before;
      }
      out_.push_back(triangles_.origin(previous_of(entry)));
      older = std::exchange(newer, out_.back());
      before = !before;
    }
  }

  const Triangles& triangles_;
  std::span<const Index> opposite_;
  FreeTriangles free_;
  std::vector<Index> ahead_, behind_;  // half-edges over which the strip leaves its triangles
  DisplayStrips out_;
};

void sort_by_group(std::size_t groups, std::vector<Index>& corners, std::vector<Index>& group) {
  const Grouped<Index> triangles =
      group_by(groups, group.size(), [&](Index t) { return group[t]; });
  std::vector<Index> sorted;
  sorted.reserve(corners.size());
  for (const Index t : triangles.elements)
    sorted.insert(sorted.end(), corners.begin() + 3 * std::ptrdiff_t{t},
                  corners.begin() + 3 * std::ptrdiff_t{t} + 3);
  corners = std::move(sorted);
  std::ranges::sort(group);
}

}  // namespace

DisplayStrips derive_strips(std::span<const Index> corners, std::span<const Index> group,
                            Index wedge_count) {
  assert(corners.size() % 3 == 0 && (group.empty() || group.size() == corners.size() / 3));
  const Triangles triangles{corners, group, wedge_count};
  const std::vector<Index> opposite = opposites(triangles);
  return StripMaker(triangles, opposite).run();
}

DisplayStrips derive_strips(const LevelView& level) {
  std::vector<Index> corners, group;
  corners.reserve(level.resolved.size());
  bool sorted = true;
  for_each_triangle(level, [&](Index a, Index b, Index c, Index g) {
    corners.insert(corners.end(), {a, b, c});
    if (level.mesh->groups.size() < 2) return;
    sorted &= group.empty() || group.back() <= g;
    group.push_back(g);
  });
  if (!sorted) sort_by_group(level.mesh->groups.size(), corners, group);
  return derive_strips(corners, group, level.wedges);
}

}  // namespace pstrips::inline codecs
