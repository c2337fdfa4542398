#pragma once

#include <cstdint>
#include <vector>

#include "codecs/stripify/linked_paths.h"

namespace pstrips::inline codecs {

/// Positions that are breaks, with the next one either way in a few steps.
class BreakSet {
 public:
  void reset(Index size);  ///< no breaks in [0, size)
  void set(Index i, bool on);
  bool contains(Index i) const { return (words_[i / 64] >> (i % 64) & 1) != 0; }
  Index first_from(Index i) const;  ///< Precondition: there is one at or after i
  Index last_to(Index i) const;     ///< Precondition: there is one at or before i

 private:
  std::vector<std::uint64_t> words_, summary_;  // bit w of the summary: word w is not 0
};

/// Finds the far end of a path in few steps, however long the paths are, while links change.
///
/// Triangles are numbered along the paths; a walk goes along a stretch of consecutive numbers in
/// one step, to where a link was cut since, and from there over a link that was made since. When
/// there are too many of those, all triangles are numbered anew.
class PathIndex {
 public:
  explicit PathIndex(LinkedPaths& paths) : paths_(paths) { number(); }

  /// The end of the path that leaves over `exit`. Precondition: is_linked(exit).
  Index end_over(LinkedPaths::HalfEdge exit) const;
  /// The other end of the path of an end; itself when it is alone. Precondition: is_end(end).
  Index mate(Index end) const {
    return paths_.is_single(end) ? end : end_over(paths_.first_link(end));
  }
  /// LinkedPaths::flip.
  void flip(LinkedPaths::HalfEdge h);

 private:
  void number();
  // The half-edge of t that is linked to `neighbor`.
  LinkedPaths::HalfEdge link_to(Index t, Index neighbor) const;

  LinkedPaths& paths_;
  std::vector<Index> position_, at_;  // positions from 1 on
  BreakSet breaks_;                   // i: at_[i] and at_[i + 1] are not linked; 0 is one
  int detours_ = 0;  // links cut and made since, those not counted that were taken back
  int max_detours_ = 0;
};

}  // namespace pstrips::inline codecs
