#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/progressive_strips.h"
#include "core/strips.h"

namespace pstrips::inline core {

/// Where the lists of a record start in those of its mesh.
struct RecordStart {
  std::size_t vsplit = 0, offset_count = 0, reassigned = 0, map_offset = 0, new_corner = 0;
  /// Moves on to the record after one with these counts.
  void skip(const Vsplit& split) {
    ++vsplit;
    offset_count += split.wedges;
    reassigned += split.reassigned;
    map_offset += split.map_offsets;
    new_corner += std::size_t{3} * split.triangles;
  }
  friend bool operator==(const RecordStart&, const RecordStart&) = default;
};

/// One record of a mesh with its lists, which stay the mesh's.
struct VsplitRecord {
  Index vertex;                          ///< the new one
  Index parent;                          ///< or `vertex`, for one that appears on its own
  std::span<const Index> reassigned;     ///< wedges taken over from the parent
  std::span<const Index> offset_counts;  ///< one a new wedge
  std::span<const Index> map_offsets;    ///< of all new wedges, one list after the other
  std::span<const Index> new_corners;    ///< of the triangles that are appended to the map
};

/// Precondition: the mesh has a record at `start`, and its lists are as long as the record says.
VsplitRecord record_at(const ProgressiveMesh& mesh, const RecordStart& start);

/// What one step changed: what undo() needs to take it back.
struct StripChange {
  enum class Kind : std::uint8_t {
    entry,   ///< entry `at` held `stored` and showed the wedge `before`
    owner,   ///< wedge `at` belonged to vertex `before`
    wedge,   ///< wedge `at` was not there
    append,  ///< nor were the three entries from `at` on
  };
  Kind kind;
  Index at;
  Index before;
  Index stored = kNone;
};

/// For steps whose changes nobody looks at.
inline constexpr auto kUnobserved = [](const auto&) {};

/// A mesh between two records: which wedge each entry of its index map shows, and which vertex each
/// wedge belongs to. [spec/vsplit.md §2, §3]
///
/// Records are applied as a whole or step by step, and steps are undone, the last one first.
/// `changed(entry)` is called for each entry that shows another wedge after a step, or another
/// vertex by its wedge; once a step for each.
///
/// Symbols, and wedges that go over to another vertex, make one step change many entries. Each that
/// changes without being named is one unit of **work**; when what was granted is spent,
/// is_exhausted() becomes true, and steps change nothing but what they name until resolve_again().
class StripState {
 public:
  /// The encoder of [Kim04 §3.3] needs about one for each map offset; a file that needs this many
  /// was made to cost time.
  static constexpr std::uint64_t kMaxWorkPerItem = 64;

  /// The base of a mesh, with work granted for the entries of its map. O(base).
  ///
  /// Precondition: the chain of each symbol of the map ends at a wedge. [S-003]
  explicit StripState(const ProgressiveMesh& mesh);

  /// Keeps lists of the entries that show each wedge from now on: reassign() finds its entries by
  /// them. O(map), and a change then costs about three times as much.
  void list_uses();

  void grant_work(std::uint64_t items) { work_left_ += kMaxWorkPerItem * items; }
  /// Replaces all grants.
  void limit_work(std::uint64_t work) { work_left_ = work; }
  bool is_exhausted() const { return exhausted_; }
  /// Brings all entries up to date again. O(map).
  void resolve_again();

  /// Frees what only steps need; there must be none from now on.
  void release_symbols();

  Index wedge_count() const { return wedge_count_; }
  Index vertex_of(Index wedge) const {
    return wedge_vertex_.empty() ? wedge : wedge_vertex_[wedge];
  }
  /// A vertex for each wedge; empty with single wedges.
  std::span<const Index> wedge_vertices() const { return wedge_vertex_; }
  /// The map with every symbol replaced by its wedge; restarts stay.
  std::span<const Index> resolved() const { return resolved_; }
  /// An entry as it is stored: a wedge, a symbol or a restart.
  Index stored(Index offset) const {
    return stored_.empty() ? resolved_[offset] : stored_[std::size_t{offset} + kMargin];
  }
  Index vertex_at(Index offset) const { return vertex_of(resolved_[offset]); }

  /// Calls `visit(entry)` for each entry that shows the wedge, in no particular order.
  /// Precondition: list_uses().
  template <class Visit>
  void for_each_use(Index wedge, Visit&& visit) const {
    for (Index at = first_use_[wedge]; at != kNone; at = uses_[at].next) visit(at);
  }

  /// Applies a record in the order of the specification.
  ///
  /// record   in range, and no map offset that of a restart
  /// changed  as above
  /// keep     called with the StripChange of each step, after it
  /// cost     O(lists + changed entries)
  template <class Changed, class Keep>
  void apply(const VsplitRecord& record, Changed&& changed, Keep&& keep) {
    for (const Index wedge : record.reassigned) keep(reassign(wedge, record.vertex, changed));
    const Index* offset = record.map_offsets.data();
    for (const Index count : record.offset_counts) {
      const Index wedge = wedge_count_;
      keep(add_wedge(record.vertex));
      for (const Index* const end = offset + count; offset != end; ++offset)
        keep(write(*offset, wedge, wedge, changed));
    }
    for (std::size_t c = 0; c < record.new_corners.size(); c += 3)
      keep(append(record.new_corners.subspan(c).first<3>(), changed));
  }

  /// A new wedge, which no entry shows yet.
  StripChange add_wedge(Index vertex);

  /// Entry `offset` becomes `stored`: the wedge `shown` itself, or a symbol whose chain ends at it.
  /// Entries whose chains end here follow. A vsplit writes wedges, a collapse symbols too, in a map
  /// of the offset encoding.
  template <class Changed>
  StripChange write(Index offset, Index stored, Index shown, Changed&& changed);

  /// The map gets a triangle more. Precondition: it is one of triangles.
  template <class Changed>
  StripChange append(std::span<const Index, 3> corners, Changed&& changed);

  /// An existing wedge goes over, with its attributes, to `vertex`. `changed` is called only when
  /// uses are listed. Precondition: not with single wedges.
  template <class Changed>
  StripChange reassign(Index wedge, Index vertex, Changed&& changed);

  /// Takes the last step back that has not been taken back. Needs work as that step did.
  template <class Changed>
  void undo(const StripChange& change, Changed&& changed);

 private:
  struct Use {
    Index next = kNone, previous = kNone;  // entries that show the same wedge
  };

  bool spend() {
    exhausted_ |= work_left_ == 0;
    if (exhausted_) return false;
    --work_left_;
    return true;
  }
  void show(Index at, Index wedge) {
    if (!lists_uses_) {
      resolved_[at] = wedge;
    } else {
      unlink(at);
      resolved_[at] = wedge;
      link(at);
    }
  }
  void link(Index at) {
    Index& first = first_use_[resolved_[at]];
    uses_[at] = {first, kNone};
    if (first != kNone) uses_[first].previous = at;
    first = at;
  }
  void unlink(Index at) {
    const auto [next, previous] = uses_[at];
    if (next != kNone) uses_[next].previous = previous;
    (previous != kNone ? uses_[previous].next : first_use_[resolved_[at]]) = next;
  }
  void remove_wedge();
  void remove_triangle();

  // Restarts before and behind the stored map, so that neighbours of entries need no check.
  static constexpr std::size_t kMargin = 2;

  std::vector<Index> resolved_;
  std::vector<Index> stored_;        // empty when it has no symbols: `resolved_` is the map then
  std::vector<Index> wedge_vertex_;  // empty with single wedges
  Index wedge_count_;
  bool single_wedges_;
  bool lists_uses_ = false;
  bool exhausted_ = false;
  std::uint64_t work_left_;
  std::vector<Index> first_use_;  // of each wedge, if uses are listed
  std::vector<Use> uses_;         // of each entry, likewise
  std::vector<Index> pending_;    // scratch of write()
};

template <class Changed>
StripChange StripState::write(Index offset, Index stored, Index shown, Changed&& changed) {
  StripChange change{StripChange::Kind::entry, offset, resolved_[offset], kNone};
  if (stored_.empty()) {
    change.stored = change.before;
    show(offset, shown);
    changed(offset);
    return change;
  }
  Index* const map = stored_.data() + kMargin;
  change.stored = std::exchange(map[offset], stored);
  for_each_follower(
      offset, pending_, [map](std::ptrdiff_t i, int d) { return map[i] == symbol_of(d); },
      [&](Index at) {
        if (at != offset && !spend()) return false;
        show(at, shown);
        changed(at);
        return !exhausted_;
      });
  return change;
}

template <class Changed>
StripChange StripState::append(std::span<const Index, 3> corners, Changed&& changed) {
  const auto first = static_cast<Index>(resolved_.size());
  for (const Index wedge : corners) {
    const auto at = static_cast<Index>(resolved_.size());
    resolved_.push_back(wedge);
    if (lists_uses_) {
      uses_.emplace_back();
      link(at);
    }
    changed(at);
  }
  return {StripChange::Kind::append, first, kNone};
}

template <class Changed>
StripChange StripState::reassign(Index wedge, Index vertex, Changed&& changed) {
  const StripChange change{StripChange::Kind::owner, wedge, wedge_vertex_[wedge]};
  wedge_vertex_[wedge] = vertex;
  if (lists_uses_)
    for (Index at = first_use_[wedge]; at != kNone && spend(); at = uses_[at].next) changed(at);
  return change;
}

template <class Changed>
void StripState::undo(const StripChange& change, Changed&& changed) {
  switch (change.kind) {
    case StripChange::Kind::entry:
      write(change.at, change.stored, change.before, changed);
      return;
    case StripChange::Kind::owner:
      reassign(change.at, change.before, changed);
      return;
    case StripChange::Kind::wedge:
      remove_wedge();
      return;
    case StripChange::Kind::append:
      remove_triangle();
      return;
  }
}

}  // namespace pstrips::inline core
