#include "validators/replay.h"

#include <algorithm>
#include <numeric>

namespace pstrips::inline validators {
namespace {

// Symbols let one written place change many entries, and a reassigned wedge stands at many map
// offsets. The encoder of [Kim04 §3.3] needs about two changed entries for each written one.
constexpr std::uint64_t kWorkPerItem = 64;

/// The state of a decoder between two records, kept so that a record costs what it changes.
class State {
 public:
  explicit State(const ProgressiveMesh& mesh)
      : entry_(mesh.base_map),
        owner_(mesh.base_wedge_vertex),
        wedge_count_(mesh.base_vertices + mesh.vsplits.size()),
        strip_of_(entry_.size()),
        is_triangle_(entry_.size()),
        lists_uses_(!mesh.reassigned.empty()) {
    if (mesh.single_wedges) {
      owner_.resize(mesh.base_wedges);
      std::iota(owner_.begin(), owner_.end(), Index{0});
    }
    owner_.reserve(mesh.base_wedges + mesh.wedge_offset_counts.size());
    for (const Index v : owner_) ++wedge_count_[v];
    value_ = resolve(entry_).value();  // the index map is valid
    Index strip = 0;
    for (std::size_t i = 0; i < value_.size(); ++i)
      strip_of_[i] = value_[i] == kRestart ? strip++ : strip;
    triangles_of_strip_.resize(std::size_t{strip} + 1);
    for (std::size_t i = 0; i < value_.size(); ++i) refresh_window(i);
    work_left_ =
        1024 + kWorkPerItem * (entry_.size() + mesh.map_offsets.size() + mesh.reassigned.size());
    if (lists_uses_) list_uses();
  }

  Index wedges() const { return static_cast<Index>(owner_.size()); }
  Index owner(Index wedge) const { return owner_[wedge]; }
  Index wedges_of(Index vertex) const { return wedge_count_[vertex]; }
  Index entry(Index place) const { return entry_[place]; }
  Index value(Index place) const { return value_[place]; }
  bool exhausted() const { return exhausted_; }
  Shown shown(Index vertices) const { return {vertices, triangles_, strips_}; }

  void add_wedges(Index vertex, Index count) {
    owner_.insert(owner_.end(), count, vertex);
    wedge_count_[vertex] += count;
    if (lists_uses_) first_use_.resize(owner_.size(), kNone);
  }

  /// The entry at `place` becomes `wedge`, and with it every entry whose symbols lead there.
  void write(Index place, Index wedge) {
    entry_[place] = wedge;
    changing_.assign(1, place);
    while (!changing_.empty() && spend()) {
      const Index at = changing_.back();
      changing_.pop_back();
      set_value(at, wedge);
      for (const int d : {-2, -1, 1, 2}) {
        const std::int64_t other = std::int64_t{at} - d;
        if (other < 0 || other >= static_cast<std::int64_t>(entry_.size())) continue;
        if (entry_[static_cast<std::size_t>(other)] == symbol_of(d))
          changing_.push_back(static_cast<Index>(other));
      }
    }
  }

  /// An existing wedge moves, with its attributes, to `vertex`.
  void carry(Index wedge, Index vertex) {
    --wedge_count_[owner_[wedge]];
    ++wedge_count_[vertex];
    owner_[wedge] = vertex;
    for (Index at = first_use_[wedge]; at != kNone && spend(); at = next_use_[at])
      refresh_windows_with(at);
  }

  Replay finish(std::vector<Shown> levels) && {
    return {std::move(levels), std::move(value_), std::move(owner_), true};
  }

 private:
  bool spend() {
    if (work_left_ == 0) exhausted_ = true;
    return work_left_ > 0 && work_left_-- > 0;
  }

  void set_value(Index at, Index wedge) {
    if (lists_uses_) {
      unlink_use(at);
      link_use(at, wedge);
    }
    value_[at] = wedge;
    refresh_windows_with(at);
  }

  void refresh_windows_with(std::size_t at) {
    for (std::size_t i = at < 2 ? 0 : at - 2; i <= at; ++i) refresh_window(i);
  }

  /// Counts the triangle of the entries i, i+1, i+2 when it has come or gone.
  void refresh_window(std::size_t i) {
    const bool is = shows_triangle(i);
    if (is == (is_triangle_[i] != 0)) return;
    is_triangle_[i] = is;
    Index& of_strip = triangles_of_strip_[strip_of_[i]];
    if (is) {
      ++triangles_;
      if (of_strip++ == 0) ++strips_;
    } else {
      --triangles_;
      if (--of_strip == 0) --strips_;
    }
  }

  bool shows_triangle(std::size_t i) const {
    if (value_.size() - i < 3) return false;
    const Index a = value_[i], b = value_[i + 1], c = value_[i + 2];
    if (a == kRestart || b == kRestart || c == kRestart) return false;
    return owner_[a] != owner_[b] && owner_[b] != owner_[c] && owner_[a] != owner_[c];
  }

  // Which entries hold a wedge: doubly linked lists over the map.
  void list_uses() {
    first_use_.assign(owner_.size(), kNone);
    next_use_.assign(value_.size(), kNone);
    previous_use_.assign(value_.size(), kNone);
    for (Index at = 0; at < value_.size(); ++at)
      if (value_[at] != kRestart) link_use(at, value_[at]);
  }
  void link_use(Index at, Index wedge) {
    previous_use_[at] = kNone;
    next_use_[at] = first_use_[wedge];
    if (next_use_[at] != kNone) previous_use_[next_use_[at]] = at;
    first_use_[wedge] = at;
  }
  void unlink_use(Index at) {
    const Index next = next_use_[at], previous = previous_use_[at];
    if (next != kNone) previous_use_[next] = previous;
    (previous != kNone ? next_use_[previous] : first_use_[value_[at]]) = next;
  }

  std::vector<Index> entry_;        // as the file has it: symbols stay until written over
  std::vector<Index> value_;        // what each entry resolves to
  std::vector<Index> owner_;        // a vertex for each wedge
  std::vector<Index> wedge_count_;  // of each vertex
  std::vector<Index> strip_of_;
  std::vector<std::uint8_t> is_triangle_;  // by first entry
  std::vector<Index> triangles_of_strip_;
  std::vector<Index> first_use_, next_use_, previous_use_;
  std::vector<Index> changing_;
  Index triangles_ = 0, strips_ = 0;
  std::uint64_t work_left_ = 0;
  bool exhausted_ = false;
  bool lists_uses_;  // a wedge is reassigned at some time
};

/// Where the lists of the current record start, from the start of the mesh.
struct Cursor {
  std::size_t vsplit = 0, offset_count = 0, reassigned = 0, map_offset = 0;
};

/// Replays one record at a time; a rule that is broken becomes a fault.
class Records {
 public:
  Records(const ProgressiveMesh& mesh, Faults& faults)
      : mesh_(mesh), faults_(faults), state_(mesh), vertices_(mesh.base_vertices) {}

  Replay run(std::span<const Index> packets) {
    std::vector<Shown> levels{state_.shown(vertices_)};
    for (packet_ = 0; packet_ < packets.size(); ++packet_) {
      packet_start_ = at_;
      for (Index record = 0; record < packets[packet_]; ++record)
        if (!apply(record)) {
          Replay stopped = std::move(state_).finish(std::move(levels));
          stopped.finished = false;
          return stopped;
        }
      levels.push_back(state_.shown(vertices_));
    }
    return std::move(state_).finish(std::move(levels));
  }

 private:
  bool apply(Index record) {
    record_ = record;
    const Vsplit& split = mesh_.vsplits[at_.vsplit];
    const Index vertex = vertices_;
    if (split.parent > vertex) return broken(Fault::parent_not_there, Field::parent);
    const bool alone = split.parent == vertex;
    if (alone && split.reassigned > 0)
      return broken(Fault::isolated_vertex_reassigns, Field::record);
    if (alone && split.map_offsets > 0) return broken(Fault::isolated_vertex_writes, Field::record);
    if (alone && moves(vertex)) return broken(Fault::isolated_vertex_moves, Field::record);
    ++vertices_;
    const Index first_wedge = state_.wedges();
    state_.add_wedges(vertex, split.wedges);
    if (!write_offsets(split, first_wedge)) return false;
    if (!reassign_wedges(split, first_wedge, vertex)) return false;
    if (state_.wedges_of(vertex) == 0)
      return broken(Fault::new_vertex_without_wedge, Field::record);
    if (state_.wedges_of(split.parent) == 0)
      return broken(Fault::parent_without_wedge, Field::record);
    if (state_.exhausted()) return broken(Fault::too_much_work, Field::record);
    ++at_.vsplit;
    return true;
  }

  /// With free placement: the record gives its own vertex two positions.
  bool moves(Index vertex) const {
    if (mesh_.placement != Placement::optimal) return false;
    const std::size_t bytes = mesh_.position.element_bytes();
    const ByteView moved = ByteView(mesh_.parent_position).subspan(at_.vsplit * bytes, bytes);
    return !std::ranges::equal(mesh_.position.element(vertex), moved);
  }

  /// All map offsets are judged by the state before the record, then written.
  bool write_offsets(const Vsplit& split, Index first_wedge) {
    const std::size_t first_list = at_.offset_count, first_place = at_.map_offset;
    for (Index w = 0; w < split.wedges; ++w, ++at_.offset_count)
      for (Index k = 0; k < mesh_.wedge_offset_counts[at_.offset_count]; ++k, ++at_.map_offset) {
        const Index place = mesh_.map_offsets[at_.map_offset];
        if (place >= mesh_.base_map.size())
          return broken(Fault::offset_past_end, Field::map_offset);
        if (state_.value(place) == kRestart)
          return broken(Fault::offset_is_restart, Field::map_offset);
        if (k > 0 && place <= mesh_.map_offsets[at_.map_offset - 1])
          return broken(Fault::offsets_not_ascending, Field::map_offset);
        if (state_.owner(state_.value(place)) != split.parent)
          return broken(Fault::offset_not_of_parent, Field::map_offset);
      }
    at_.map_offset = first_place;
    for (Index w = 0; w < split.wedges; ++w)
      for (Index k = 0; k < mesh_.wedge_offset_counts[first_list + w]; ++k, ++at_.map_offset) {
        const Index place = mesh_.map_offsets[at_.map_offset];
        const Index before = state_.entry(place);
        if (is_wedge(before) && before >= first_wedge)
          return broken(Fault::offset_twice, Field::map_offset);
        state_.write(place, first_wedge + w);
      }
    return true;
  }

  bool reassign_wedges(const Vsplit& split, Index first_wedge, Index vertex) {
    for (Index k = 0; k < split.reassigned; ++k, ++at_.reassigned) {
      const Index wedge = mesh_.reassigned[at_.reassigned];
      if (wedge >= first_wedge) return broken(Fault::reassigned_not_there, Field::reassigned);
      if (state_.owner(wedge) != split.parent)
        return broken(Fault::reassigned_not_of_parent, Field::reassigned);
      state_.carry(wedge, vertex);
    }
    return true;
  }

  bool broken(Fault fault, Field field) {
    Where where{.field = field, .packet = packet_, .record = record_};
    if (field == Field::parent) where.element = record_;
    if (field == Field::map_offset) where.element = at_.map_offset - packet_start_.map_offset;
    if (field == Field::reassigned) where.element = at_.reassigned - packet_start_.reassigned;
    faults_.add(fault, where);
    return false;
  }

  const ProgressiveMesh& mesh_;
  Faults& faults_;
  State state_;
  Index vertices_;
  Cursor at_, packet_start_;
  Index packet_ = 0, record_ = 0;
};

}  // namespace

Replay replay(const ProgressiveMesh& mesh, std::span<const Index> packets, Faults& faults) {
  return Records(mesh, faults).run(packets);
}

}  // namespace pstrips::inline validators
