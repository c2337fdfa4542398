#include "formats/pstrip/payload/compact/split_finder.h"

#include <algorithm>

namespace pstrips::inline formats {

bool SplitFinder::find(const VsplitRecord& record, Index new_wedges, GridSplit& split,
                       SplitRecord& rest) {
  split = {};
  state_.mesh().corners_of(record.parent, corners_);
  rest.new_wedges = new_wedges;
  rest.reassigned.assign(record.reassigned.begin(), record.reassigned.end());
  rest.corners.assign(record.new_corners.begin(), record.new_corners.end());
  if (!find_moved(record) || !find_triangles(record)) return false;
  split.chord = find_chord(record.parent, split);
  if (!split.chord) name_corners(split);
  list_shown(split, rest.shown);
  return true;
}

const SplitFinder::Moved* SplitFinder::moved(Index corner) const {
  const auto found = std::ranges::lower_bound(moved_, corner, {}, &Moved::corner);
  return found != moved_.end() && found->corner == corner ? &*found : nullptr;
}

/// The corners of the parent that become the new vertex's, and what they show then.
bool SplitFinder::find_moved(const VsplitRecord& record) {
  moved_.clear();
  Index wedge = state_.wedges;
  const Index* offset = record.map_offsets.data();
  for (const Index count : record.offset_counts) {
    for (Index i = 0; i < count; ++i) moved_.push_back({*offset++, wedge});
    ++wedge;
  }
  for (const Index w : record.reassigned)
    if (state_.single_wedges || state_.lists.vertex_of(w) != record.parent) return false;
  for (const Index corner : corners_)
    if (std::ranges::find(record.reassigned, state_.wedge_of(corner)) != record.reassigned.end())
      moved_.push_back({corner, state_.wedge_of(corner)});
  std::ranges::sort(moved_, {}, &Moved::corner);
  const auto is_foreign = [&](const Moved& m) {
    return m.corner >= 3 * state_.faces || state_.mesh().vertex_of(m.corner) != record.parent;
  };
  return std::ranges::adjacent_find(moved_, {}, &Moved::corner) == moved_.end() &&
         std::ranges::none_of(moved_, is_foreign);
}

/// In the order in which the split goes over the corners.
void SplitFinder::list_shown(const GridSplit& split, std::vector<Index>& shown) const {
  shown.clear();
  const auto add = [&](Index corner) {
    if (const Moved* const m = moved(corner)) shown.push_back(m->wedge);
  };
  if (!split.chord) {
    std::ranges::for_each(corners_, add);
    return;
  }
  for (unsigned i = split.from; i != split.to; i = ring_.next(i))
    if (ring_.corner[i] != kNone) add(ring_.corner[i]);
}

Index SplitFinder::vertex_after(Index wedge, const VsplitRecord& record) const {
  if (wedge >= state_.wedges) return record.vertex;
  if (std::ranges::find(record.reassigned, wedge) != record.reassigned.end()) return record.vertex;
  return state_.vertex_of_wedge(wedge);
}

/// Each new triangle has the parent first and the new vertex behind it or before it.
bool SplitFinder::find_triangles(const VsplitRecord& record) {
  triangles_.clear();
  for (std::size_t c = 0; c < record.new_corners.size(); c += 3) {
    const auto vertex = [&](std::size_t k) {
      return vertex_after(record.new_corners[c + k], record);
    };
    const bool added_first = vertex(1) == record.vertex;
    const Index third = vertex(added_first ? 2 : 1);
    if (vertex(0) != record.parent || vertex(added_first ? 1 : 2) != record.vertex ||
        third == record.parent || third == record.vertex)
      return false;
    triangles_.push_back({third, added_first});
  }
  return true;
}

/// Whether the neighbours that new triangles name bound the corners that move.
bool SplitFinder::find_chord(Index parent, GridSplit& split) {
  if (triangles_.empty() || triangles_.size() > 2) return false;
  // The one at the start comes first.
  if (triangles_.size() == 2 && (triangles_[0].added_first || !triangles_[1].added_first))
    return false;
  state_.mesh().ring_of(parent, ring_);
  const unsigned size = ring_.size;
  const auto place_of = [&](Index vertex) {
    unsigned i = 0;
    while (i < size && ring_.vertex[i] != vertex) ++i;
    return i;
  };
  split.from = split.to = place_of(kNone);
  for (const NewTriangle& t : triangles_)
    (t.added_first ? split.to : split.from) = place_of(t.third);
  if (split.from >= size || split.to >= size || split.from == split.to) return false;
  const unsigned side = (split.to + size - split.from) % size;
  if (side >= SymbolModel::kSymbols) return false;  // the last symbol stands for no chord
  const bool halves = 2 * side == size, optimal = state_.splits.placement == Placement::optimal;
  if (optimal && halves && ring_.vertex[split.from] > ring_.vertex[split.to]) return false;
  if (optimal && state_.splits.mixed && 2 * side > size) return false;
  unsigned at = split.from;
  for (unsigned i = 0; i < size; ++i, at = ring_.next(at))
    if (ring_.corner[at] != kNone && (moved(ring_.corner[at]) != nullptr) != (i < side))
      return false;
  return true;
}

void SplitFinder::name_corners(GridSplit& split) const {
  for (const Index corner : corners_) split.moves.push_back(moved(corner) != nullptr);
  for (const NewTriangle& t : triangles_) {
    split.third.push_back(t.third);
    split.new_first.push_back(t.added_first);
  }
}

}  // namespace pstrips::inline formats
