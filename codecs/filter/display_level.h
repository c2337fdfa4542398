#pragma once

#include <vector>

#include "codecs/filter/display_strips.h"
#include "codecs/vsplit/level.h"

namespace pstrips::inline codecs {

/// A level and its display strips, kept in step: after some vsplits only the strips that they
/// changed are filtered again. [Kim04 §3.1, the reconstruction stage]
///
/// A map of triangles has no strips: whatever the filter, those of derive_strips() are shown, and
/// all are made anew after vsplits.
class DisplayLevel {
 public:
  /// The mesh must outlive this. O(map) at first.
  DisplayLevel(const ProgressiveMesh& mesh, Filter filter);

  /// Applies the next vsplits. O(entries rewritten); filters nothing yet.
  void refine(Index vsplits);
  /// As Level's.
  void reload_positions() { level_.reload_positions(); }
  const Level& level() const { return level_; }

  /// Filters what has changed since the last call; returns how many strips that were. O(what they
  /// hold), of a map of triangles O(level).
  std::size_t update();
  /// Appends the display strips as of the last update(), restarts included. O(their size).
  void append_display(DisplayStrips& out) const;
  /// What they cost, as of the last update(). O(1).
  DisplayCost cost() const;
  /// How many strips were derived, as of the last update(); 0 of a map of strips. O(1).
  std::uint64_t derived_strips() const;

 private:
  struct Segment {
    std::size_t first = 0;
    Index entries = 0;
    DisplayCost cost;
  };
  bool is_derived() const { return level_.mesh().encoding == MapEncoding::triangles; }
  void derive();
  void mark_changed(std::span<const Index> entries);
  void refilter(std::size_t strip);
  void compact();

  Level level_;
  Filter filter_;
  std::vector<StripRange> strips_;
  std::vector<Segment> segments_;  // of the pool, one a strip
  // A restart, then segments that each begin with one; old ones stay until compact(). Derived
  // strips as they are.
  DisplayStrips pool_{kRestart};
  std::size_t used_ = 0;        // entries of the pool in segments
  RecordStart filtered_to_;     // the first record that is not in the pool
  std::vector<Index> changed_;  // strips; scratch of update()
  std::vector<bool> is_changed_;
  DisplayCost cost_;
};

}  // namespace pstrips::inline codecs
