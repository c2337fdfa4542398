#pragma once

#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "codecs/stripify/face_strips.h"

namespace pstrips::inline codecs {

/// Rows of free quads, each entered and left over opposite edges, while faces are taken. Every quad
/// is in two rows, one either way across it.
///
/// cost  O(n log n) altogether: a row that loses a quad is parted, and the shorter part renumbered
class StraightRuns {
 public:
  explicit StraightRuns(const StripFaces& faces);

  /// To be called for every face that is taken; other faces than quads are ignored.
  void take(Index face);

  /// A longest row of at least `least` quads, as the half-edge over which each is left; among
  /// equals the one laid down first. Empty when there is none. Quads that the row crosses twice are
  /// in it twice. Valid until the next call of take().
  std::span<const Index> longest(Index least);

 private:
  struct Run {
    Index begin, end;
    Index length() const { return end - begin; }
  };

  Index slot(Index half_edge) const;
  void lay_down(Index first_exit);
  void add(Run run);
  void part(Index place);

  const StripFaces& faces_;
  std::vector<Index> exits_;     // all rows one after the other
  std::vector<Index> place_of_;  // in exits_; of quad f: 2 f and 2 f + 1, kNone when taken
  std::vector<Index> run_at_;    // of each place
  std::vector<Run> runs_;
  std::priority_queue<std::pair<Index, Index>> queue_;  // length, ~run; old lengths are left behind
};

}  // namespace pstrips::inline codecs
