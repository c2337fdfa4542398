#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/fault_list.h"
#include "formats/pstrip/payload/compact/mesh_state.h"

// For formats/pstrip/payload/compact: the wedges, groups and attributes that a split brings, once
// for writing and for reading. [spec/compact.md §7]
//
// A wedge of the parent that corners of the new vertex show has three fates: it goes over to the
// new vertex, or a new wedge comes from it, or, in a record that is not regular, several do.

namespace pstrips::inline formats {

/// What a record does beside the split of a vertex.
struct SplitRecord {
  std::vector<Index> moved;       ///< corners that the new vertex gets, as the split goes over them
  std::vector<Index> kept;        ///< that the parent keeps, those of new faces aside
  std::vector<Index> shown;       ///< the wedge of each moved one after the record
  std::vector<Index> reassigned;  ///< wedges that it takes over
  Index new_wedges = 0;
  std::vector<Index> corners;  ///< wedges, three for each new face
  std::vector<Index> groups;   ///< of the new faces; empty when the mesh has one group

  void clear() {
    for (auto* list : {&moved, &kept, &shown, &reassigned, &corners, &groups}) list->clear();
    new_wedges = 0;
  }
};

/// A number that is small nearly always.
template <class Coder>
Index code_count(Coder& coder, SymbolModel& model, Index count) {
  constexpr unsigned kMany = SymbolModel::kSymbols - 1;
  const unsigned coded = coder.symbol(model, std::min<Index>(count, kMany));
  return coded < kMany ? coded : kMany + coder.raw(count - kMany, 31);
}

/// Where a new face touches the one beyond an edge that the third vertex has with the parent or the
/// new vertex: the place in `corners`, those of one of the two, whose face has the third vertex
/// before or behind it; their number if there is none. One that is turned the other way will do.
inline std::size_t place_beside(const StarMesh& mesh, std::span<const Index> corners, Index third,
                                bool before) {
  for (const bool turned : {before, !before})
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (mesh.vertex_of(turned ? StarMesh::previous_in_face(corners[i])
                                : StarMesh::next_in_face(corners[i])) == third)
        return i;
  return corners.size();
}

/// Which corner of a new face is whose.
struct NewFace {
  std::array<Index, 3> corner{};  ///< of the parent, the new vertex, the third
  bool added_first = false;       ///< it is (parent, new, third)

  NewFace(const StarMesh& mesh, Index face, Index parent, Index added) {
    for (unsigned k = 0; k < 3; ++k) {
      const Index vertex = mesh.vertex_of(3 * face + k);
      corner[vertex == parent ? 0 : vertex == added ? 1 : 2] = 3 * face + k;
    }
    added_first = corner[1] == StarMesh::next_in_face(corner[0]);
  }
};

/// The wedges of one split that was carried out already.
template <class Coder>
class WedgeCode {
 public:
  /// record  to write; a reader fills it, but for `moved` and `kept`, which are there
  WedgeCode(Coder& coder, MeshState& state, Index parent, Index added, SplitRecord& record)
      : coder_(coder), state_(state), parent_(parent), added_(added), record_(record) {
    list_sources();
  }

  /// errors  corrupt: a wedge that is not there or not of its vertex, more wedges than the mesh has
  Result<void> run() {
    const std::size_t count = std::min<std::size_t>(sources_.size(), WedgeModels::kCounts - 1);
    const bool regular =
        coder_.bit(state_.models.regular[count], Coder::kReads ? false : is_regular());
    if (auto ok = regular ? code_regular(count) : code_moved(); !ok) return ok;
    for (Index face = state_.faces; face < state_.mesh().face_count(); ++face)
      if (auto ok = code_face(face, regular); !ok) return ok;
    return regular ? code_unseen() : Result<void>{};
  }

 private:
  /// A wedge of the parent that moved corners show.
  struct Source {
    Index wedge;
    Index corners;      ///< moved ones
    Index wedge_after;  ///< of the first of them
  };
  /// Wedges of a face by whom its corners belong to.
  struct FaceWedges {
    Index parent = kNone, added = kNone, third = kNone;
    bool usable() const { return parent != kNone && added != kNone && third != kNone; }
    friend bool operator==(const FaceWedges&, const FaceWedges&) = default;
  };

  static tl::unexpected<Error> too_many() { return broken(Fault::compact_counts); }
  static tl::unexpected<Error> misplaced() { return broken(Fault::compact_wedge); }
  Index first_new() const { return state_.wedges; }
  Index coarse_wedge(std::size_t i) const { return state_.corner_wedge[record_.moved[i]]; }
  Source* source_of(Index wedge) {
    if (wedge >= state_.wedges) return nullptr;
    const Index at = state_.slot[wedge];
    return at < sources_.size() && sources_[at].wedge == wedge ? &sources_[at] : nullptr;
  }
  /// Corners of the parent show the wedge, too.
  bool stays(const Source& source) const {
    return state_.lists.uses(source.wedge) > source.corners;
  }

  void list_sources() {
    state_.slot.resize(state_.wedges);
    for (std::size_t i = 0; i < record_.moved.size(); ++i) {
      const Index wedge = coarse_wedge(i);
      if (Source* const source = source_of(wedge)) {
        ++source->corners;
        continue;
      }
      state_.slot[wedge] = static_cast<Index>(sources_.size());
      sources_.push_back({wedge, 1, Coder::kReads ? kNone : record_.shown[i]});
    }
  }

  /// Whether each source has one fate, and new wedges are numbered as they appear.
  bool is_regular() {
    std::vector<Index> taken;
    Index next = first_new();
    for (const Source& source : sources_) {
      if (source.wedge_after == source.wedge && !stays(source))
        taken.push_back(source.wedge);
      else if (source.wedge_after != next++)
        return false;
    }
    for (std::size_t i = 0; i < record_.moved.size(); ++i)
      if (record_.shown[i] != source_of(coarse_wedge(i))->wedge_after) return false;
    for (const Index wedge : record_.corners) {
      if (wedge > next) return false;
      next += wedge == next ? 1 : 0;
    }
    return taken == record_.reassigned;
  }

  Result<void> code_regular(std::size_t count) {
    next_new_ = first_new();
    for (Source& source : sources_) {
      BitModel& model = state_.models.reassigned[count][source.corners > 1 ? 1 : 0];
      const bool taken = !stays(source) && coder_.bit(model, source.wedge_after == source.wedge);
      source.wedge_after = taken ? source.wedge : next_new_++;
      if (taken) state_.lists.move(source.wedge, added_);
      if constexpr (Coder::kReads)
        if (taken) record_.reassigned.push_back(source.wedge);
    }
    if constexpr (Coder::kReads) {
      for (std::size_t i = 0; i < record_.moved.size(); ++i)
        record_.shown.push_back(source_of(coarse_wedge(i))->wedge_after);
    }
    return {};
  }

  /// Those that no triangle shows have the last numbers.
  Result<void> code_unseen() {
    const Index shown = next_new_ - first_new();
    const Index unseen =
        code_count(coder_, state_.models.unseen, Coder::kReads ? 0 : record_.new_wedges - shown);
    if (std::uint64_t{next_new_} + unseen > state_.max_wedges) return too_many();
    record_.new_wedges = shown + unseen;
    return {};
  }

  static unsigned bits_for(Index largest) { return static_cast<unsigned>(std::bit_width(largest)); }

  /// Corner by corner.
  Result<void> code_moved() {
    record_.new_wedges = code_count(coder_, state_.models.new_wedges, record_.new_wedges);
    if (std::uint64_t{state_.wedges} + record_.new_wedges > state_.max_wedges) return too_many();
    next_new_ = first_new() + record_.new_wedges;
    if (auto ok = code_taken(); !ok) return ok;
    if constexpr (Coder::kReads) record_.shown.assign(record_.moved.size(), 0);
    for (std::size_t i = 0; i < record_.moved.size(); ++i) {
      const Index wedge = coarse_wedge(i);
      const bool keeps = record_.shown[i] == wedge;
      const Index coded = coder_.raw(keeps ? record_.new_wedges : record_.shown[i] - first_new(),
                                     bits_for(record_.new_wedges));
      if (coded > record_.new_wedges ||
          (coded == record_.new_wedges && state_.lists.vertex_of(wedge) != added_))
        return misplaced();
      const Index after = coded == record_.new_wedges ? wedge : first_new() + coded;
      if constexpr (Coder::kReads) record_.shown[i] = after;
      if (Source* const source = source_of(wedge); source->wedge_after == kNone)
        source->wedge_after = after;
    }
    return {};
  }

  Result<void> code_taken() {
    const auto wanted = static_cast<std::uint32_t>(record_.reassigned.size());
    const std::uint32_t count = code_count(coder_, state_.models.taken, wanted);
    if (count > state_.wedges) return misplaced();
    for (std::uint32_t i = 0; i < count; ++i) {
      const Index wedge =
          coder_.raw(Coder::kReads ? 0 : record_.reassigned[i], bits_for(state_.wedges));
      if (wedge >= state_.wedges || state_.lists.vertex_of(wedge) != parent_) return misplaced();
      const Source* const source = source_of(wedge);
      if (source != nullptr ? stays(*source) : state_.lists.uses(wedge) > 0) return misplaced();
      state_.lists.move(wedge, added_);
      if constexpr (Coder::kReads) record_.reassigned.push_back(wedge);
    }
    return {};
  }

  /// The wedge of the third vertex beside a corner.
  Index wedge_beside(Index corner, Index third) const {
    const Index next = StarMesh::next_in_face(corner);
    return state_
        .corner_wedge[state_.mesh().vertex_of(next) == third ? next
                                                             : StarMesh::previous_in_face(corner)];
  }

  /// The face's wedges as the face beyond the edge of the new vertex and the third has them.
  FaceWedges as_added(Index third, bool added_first) const {
    const std::size_t i = place_beside(state_.mesh(), record_.moved, third, added_first);
    if (i == record_.moved.size()) return {};
    const Index coarse = coarse_wedge(i), shown = record_.shown[i];
    // One that went over is no longer the parent's.
    return {coarse == shown ? kNone : coarse, shown, wedge_beside(record_.moved[i], third)};
  }

  /// The same of the parent and the third.
  FaceWedges as_kept(Index third, bool added_first, bool regular) {
    const std::size_t i = place_beside(state_.mesh(), record_.kept, third, !added_first);
    if (i == record_.kept.size()) return {};
    const Index corner = record_.kept[i], wedge = state_.corner_wedge[corner];
    return {wedge, new_wedge_from(wedge, regular), wedge_beside(corner, third)};
  }

  /// The new wedge that comes from one of the parent, or the next one that nothing shows yet.
  Index new_wedge_from(Index wedge, bool regular) {
    if (const Source* const source = source_of(wedge);
        source != nullptr && source->wedge_after != kNone && source->wedge_after != wedge)
      return source->wedge_after;
    return regular ? next_new_ : kNone;
  }

  Result<void> code_face(Index face, bool regular) {
    const NewFace corners(state_.mesh(), face, parent_, added_);
    const Index third = state_.mesh().vertex_of(corners.corner[2]);
    FaceWedges beyond = as_added(third, corners.added_first);
    const FaceWedges kept = as_kept(third, corners.added_first, regular);
    if (beyond.parent == kNone) beyond.parent = kept.parent;
    const auto place = [&](unsigned k) { return corners.corner[k] - 3 * state_.faces; };
    FaceWedges wanted;
    if constexpr (!Coder::kReads)
      wanted = {record_.corners[place(0)], record_.corners[place(1)], record_.corners[place(2)]};
    const Result<FaceWedges> coded = code_wedges(wanted, beyond, kept, third, regular);
    if (!coded) return tl::unexpected<Error>(coded.error());
    if (regular && coded->added == next_new_) ++next_new_;
    if constexpr (Coder::kReads) {
      record_.corners.resize(std::size_t{3} * (face + 1 - state_.faces));
      record_.corners[place(0)] = coded->parent;
      record_.corners[place(1)] = coded->added;
      record_.corners[place(2)] = coded->third;
    }
    for (const Index wedge : {coded->parent, coded->added, coded->third})
      if (wedge < state_.wedges) ++state_.lists.uses(wedge);
    return {};
  }

  Result<FaceWedges> code_wedges(const FaceWedges& wanted, const FaceWedges& beyond,
                                 const FaceWedges& kept, Index third, bool regular) {
    WedgeModels& models = state_.models;
    const unsigned agree = !beyond.usable() ? 0 : beyond == kept ? 1 : 2;
    const unsigned spare = (has_spare(parent_) ? 1 : 0) | (has_spare(third) ? 2 : 0);
    if (beyond.usable() && coder_.bit(models.as_new[agree][spare], wanted == beyond)) return beyond;
    if (kept.usable() && agree != 1 && coder_.bit(models.as_kept[agree][spare], wanted == kept))
      return kept;
    const Index end = next_new_ + (regular ? 1 : 0);
    FaceWedges out;
    list_likely(parent_, beyond.parent, kept.parent, kNone);
    out.parent = code_likely(models.of_parent[spare & 1], wanted.parent, end);
    if (!is_of(out.parent, parent_, end)) return misplaced();
    list_likely(third, beyond.third, kept.third, out.parent);
    out.third = code_likely(models.of_third[spare >> 1], wanted.third, end);
    likely_.clear();
    for (const Index wedge :
         {new_wedge_from(out.parent, regular), beyond.added, regular ? next_new_ : kNone})
      add_likely(wedge);
    for (const Source& source : sources_) add_likely(source.wedge_after);
    out.added = code_likely(models.of_added, wanted.added, end);
    if (!is_of(out.third, third, end) || !is_of(out.added, added_, end)) return misplaced();
    return out;
  }

  bool is_of(Index wedge, Index vertex, Index end) const {
    return wedge < state_.wedges ? state_.lists.vertex_of(wedge) == vertex
                                 : wedge < end && vertex == added_;
  }

  /// Nothing shows the wedge.
  bool is_spare(Index wedge) const { return state_.lists.uses(wedge) == 0; }
  bool has_spare(Index vertex) {
    state_.lists.list(vertex, kMostLooks, own_);
    return std::ranges::any_of(own_, [&](Index wedge) { return is_spare(wedge); });
  }

  void add_likely(Index wedge) {
    if (wedge == kNone || likely_.size() + 1 == SymbolModel::kSymbols) return;
    if (std::ranges::find(likely_, wedge) == likely_.end()) likely_.push_back(wedge);
  }

  /// Wedges of a vertex, the likeliest first: those beside, those that nothing shows, the others;
  /// the more alike to `like` (kNone: to none) the earlier.
  void list_likely(Index vertex, Index beyond, Index kept, Index like) {
    likely_.clear();
    add_likely(beyond);
    add_likely(kept);
    state_.lists.list(vertex, kMostLooks, own_);
    ranked_.clear();
    for (const Index wedge : own_)
      ranked_.push_back(
          {is_spare(wedge) ? 0u : 1u, like == kNone ? 0 : distance(wedge, like), wedge});
    std::ranges::stable_sort(ranked_, [](const Ranked& a, const Ranked& b) {
      return a.shown != b.shown ? a.shown < b.shown : a.distance < b.distance;
    });
    for (const Ranked& ranked : ranked_) add_likely(ranked.wedge);
  }

  /// Between attributes. Below 2^33.
  std::int64_t distance(Index a, Index b) const {
    if (b >= state_.wedges) return 0;
    const std::int32_t* const of_a = state_.wedge_cells.data() + std::size_t{a} * state_.columns;
    const std::int32_t* const of_b = state_.wedge_cells.data() + std::size_t{b} * state_.columns;
    std::int64_t sum = 0;
    for (unsigned c = 0; c < state_.columns; ++c) sum += std::abs(of_a[c] - of_b[c]);
    return sum;
  }

  /// A place in the list, or the wedge by its number.
  Index code_likely(SymbolModel& model, Index wanted, Index end) {
    constexpr unsigned kNamed = SymbolModel::kSymbols - 1;
    unsigned symbol = kNamed;
    if constexpr (!Coder::kReads)
      if (const auto found = std::ranges::find(likely_, wanted); found != likely_.end())
        symbol = static_cast<unsigned>(found - likely_.begin());
    symbol = coder_.symbol(model, symbol);
    return symbol < likely_.size() ? likely_[symbol] : coder_.raw(wanted, bits_for(end));
  }

  struct Ranked {
    unsigned shown;
    std::int64_t distance;
    Index wedge;
  };
  static constexpr std::size_t kMostLooks = 64;  // at wedges of one vertex

  Coder& coder_;
  MeshState& state_;
  const Index parent_, added_;
  SplitRecord& record_;
  std::vector<Source> sources_;
  std::vector<Index> own_, likely_;  // scratch: wedges of a vertex
  std::vector<Ranked> ranked_;
  Index next_new_ = 0;  // the first wedge that nothing shows yet, or past the last
};

/// The groups of the new faces of a split. Precondition: the mesh has several.
template <class Coder>
void code_groups(Coder& coder, MeshState& state, Index parent, Index added, SplitRecord& record) {
  const StarMesh& mesh = state.mesh();
  if constexpr (Coder::kReads) record.groups.assign(mesh.face_count() - state.faces, 0);
  for (Index face = state.faces; face < mesh.face_count(); ++face) {
    const NewFace corners(mesh, face, parent, added);
    const Index third = mesh.vertex_of(corners.corner[2]);
    Index beside = 0;
    if (const auto i = place_beside(mesh, record.moved, third, corners.added_first);
        i < record.moved.size())
      beside = state.face_group[record.moved[i] / 3];
    else if (const auto k = place_beside(mesh, record.kept, third, !corners.added_first);
             k < record.kept.size())
      beside = state.face_group[record.kept[k] / 3];
    Index& group = record.groups[face - state.faces];
    const auto bits = static_cast<unsigned>(std::bit_width(state.groups - 1));
    group = coder.bit(state.models.same_group, group == beside)
                ? beside
                : std::min(coder.raw(group, bits), state.groups - 1);
  }
}

}  // namespace pstrips::inline formats
