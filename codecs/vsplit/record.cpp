// Strip-edge collapses on an index map, recorded as vsplits.
//
// [Kim04] Kim, Park, Yang, Neelamkavil, "A Rendering-Efficient Progressive Transmission of 3D
// Meshes", §3.

#include "codecs/vsplit/record.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "core/gather.h"
#include "core/group_by.h"
#include "core/prefetch.h"

namespace pstrips::inline codecs {
namespace {

// An entry of the map with all that a collapse needs of it: entries are visited in an order that
// jumps across the mesh, so that what counts is how many cache lines a visit takes.
struct Entry {
  Index wedge;         // that it stands for; kRestart between strips
  Index next;          // the next entry that holds the same wedge itself; kNone: none
  Index window;        // of the triangle that starts here: kShown, kNoTriangle, or what closed it
  std::int8_t symbol;  // distance to the entry that it repeats; 0: it holds its wedge itself
};
static_assert(sizeof(Entry) == 16);

constexpr Index kShown = kNone;
constexpr Index kNoTriangle = kNone - 1;
constexpr Index kRemoved = kNone - 1;  // instead of a wedge's first entry

// Restarts before and behind the map, so that neighbours of entries need no check.
constexpr std::size_t kMargin = 2;

std::vector<Entry> entries_of(std::span<const Index> map) {
  std::vector<Entry> entries;
  entries.reserve(map.size() + 2 * kMargin);
  entries.assign(kMargin, {kRestart, kNone, kNoTriangle, 0});
  for (const Index wedge : map) entries.push_back({wedge, kNone, kNoTriangle, 0});
  entries.insert(entries.end(), kMargin, {kRestart, kNone, kNoTriangle, 0});
  return entries;
}

// "All swap operations can be encoded with symbol R-2" [Kim04 §3.4]; a doubled start with R-1.
void encode_repetitions(std::vector<Entry>& entries) {
  for (std::size_t i = kMargin; i < entries.size() - kMargin; ++i) {
    Entry* e = &entries[i];
    if (e->wedge == kRestart || e[-1].wedge == kRestart) continue;
    if (e[-2].wedge == e->wedge)
      e->symbol = -2;
    else if (e[-1].wedge == e->wedge)
      e->symbol = -1;
  }
}

// Lists are written fine to coarse and turned round in the end.
class Recorder {
 public:
  Recorder(const Mesh& mesh, const StripMap& strips, const CollapseSequence& sequence,
           MapEncoding encoding);
  void remove_isolated_vertices();
  void collapse_all();
  Recording finish(const StripMap& strips) &&;

 private:
  // New numbers of the source's; with single wedges both are the same and `wedge_to` is empty.
  struct Numbering {
    std::vector<Index> vertex_to, wedge_to;
  };

  Index vertex_of(Index wedge) const {
    return wedge_vertex_.empty() ? wedge : wedge_vertex_[wedge];
  }
  bool stands_at(const Entry& entry, Index vertex) const {
    if (wedge_vertex_.empty()) return entry.wedge == vertex;
    return entry.wedge != kRestart && wedge_vertex_[entry.wedge] == vertex;
  }
  Entry& entry(Index i) { return entries_[std::size_t{i} + kMargin]; }

  void list_entries();
  void find_triangles();
  void fetch(std::span<const WedgeMove> moves);
  void collapse(const Collapse& collapse, std::span<const WedgeMove> moves);
  void reassign(Index wedge, Index kept);
  void remove_wedge(Index wedge, Index replacement);
  void place(Index vertex, std::span<const double> position);
  void rewrite(Index at, Index to);
  void change_wedge(Index at, Index to, Index vertex);
  void close_windows(Entry* entry, Index vertex);
  void close(Entry& window);
  void begin_removal(Index vertex, Index parent);
  void end_removal();
  void turn_lists_round();
  void count_strips();
  Numbering number_all();
  void write_base(const Numbering& numbers);

  static constexpr std::size_t kFetched = 32;  // moves at a time

  const Mesh& mesh_;
  const CollapseSequence& sequence_;
  const bool moves_kept_;
  const bool symbols_;
  Attribute
      moved_;  // with optimal placement: where vertices stand, or stood when they were removed
  std::vector<Entry> entries_;
  std::vector<Index> wedge_vertex_;  // empty as long as wedge i is vertex i
  std::vector<Index> first_entry_;   // of each wedge that holds it itself; kNone, kRemoved
  Index triangles_ = 0;
  std::vector<Index> pending_;

  Recording out_;
  std::vector<Index> removed_vertices_, removed_wedges_;
};

Recorder::Recorder(const Mesh& mesh, const StripMap& strips, const CollapseSequence& sequence,
                   MapEncoding encoding)
    : mesh_(mesh),
      sequence_(sequence),
      moves_kept_(!sequence.placements.empty()),
      symbols_(encoding == MapEncoding::offset),
      entries_(entries_of(strips.entries)),
      wedge_vertex_(mesh.wedge_vertex) {
  if (moves_kept_) moved_ = mesh.position;
  if (symbols_) encode_repetitions(entries_);
  list_entries();
  find_triangles();
  out_.mesh.encoding = encoding;
  out_.mesh.placement = moves_kept_ ? Placement::optimal : Placement::subset;
  const std::size_t vsplits = mesh.vertex_count();  // all but those of the base, most of them
  removed_vertices_.reserve(vsplits);
  out_.levels.reserve(vsplits + 1);
  out_.mesh.vsplits.reserve(vsplits);
  out_.mesh.wedge_offset_counts.reserve(mesh.wedge_count());
  out_.mesh.map_offsets.reserve(strips.entries.size());
  if (moves_kept_) out_.mesh.parent_position.reserve(mesh.position.data.size());
}

void Recorder::list_entries() {
  first_entry_.assign(mesh_.wedge_count(), kNone);
  for (std::size_t i = entries_.size() - kMargin; i-- > kMargin;) {
    Entry& e = entries_[i];
    if (e.wedge == kRestart || e.symbol != 0) continue;
    e.next = first_entry_[e.wedge];
    first_entry_[e.wedge] = static_cast<Index>(i - kMargin);
  }
}

void Recorder::find_triangles() {
  for (std::size_t i = kMargin; i < entries_.size() - kMargin; ++i) {
    Entry* e = &entries_[i];
    if (e->wedge == kRestart || e[1].wedge == kRestart || e[2].wedge == kRestart) continue;
    const Index a = vertex_of(e->wedge), b = vertex_of(e[1].wedge), c = vertex_of(e[2].wedge);
    if (a == b || b == c || a == c) continue;
    e->window = kShown;
    ++triangles_;
  }
}

void Recorder::close(Entry& window) {
  if (window.window != kShown) return;
  window.window = static_cast<Index>(removed_vertices_.size() - 1);
  --triangles_;
}

// An entry has come to stand at `vertex`: the triangles around it vanish that do so already. What
// vanished once does not come back.
void Recorder::close_windows(Entry* entry, Index vertex) {
  const bool far_before = stands_at(entry[-2], vertex), before = stands_at(entry[-1], vertex),
             after = stands_at(entry[1], vertex), far_after = stands_at(entry[2], vertex);
  if (far_before || before) close(entry[-2]);
  if (before || after) close(entry[-1]);
  if (after || far_after) close(entry[0]);
}

// Gives the entry and all whose chains end at it another wedge, or the same at another vertex.
void Recorder::change_wedge(Index at, Index to, Index vertex) {
  Entry* const map = entries_.data() + kMargin;
  for_each_follower(
      at, pending_, [&](std::ptrdiff_t i, int d) { return map[i].symbol == d; },
      [&](Index i) {
        map[i].wedge = to;
        close_windows(map + i, vertex);
        return true;
      });
}

// Entry of a removed wedge: takes a symbol when the wedge that replaces it stands within two
// map offsets, the wedge itself otherwise (common edge and spiral, [Kim04 §3.4]).
//
// No cycle can arise: an entry that stands for `to` at this moment has a chain of entries that
// all do, and this one does not yet.
void Recorder::rewrite(Index at, Index to) {
  Entry* const e = &entry(at);
  e->symbol = 0;
  if (symbols_) {
    if (e[-1].wedge == to)
      e->symbol = -1;
    else if (e[1].wedge == to)
      e->symbol = 1;
    else if (e[-2].wedge == to && e[-1].wedge != kRestart)
      e->symbol = -2;
    else if (e[2].wedge == to && e[1].wedge != kRestart)
      e->symbol = 2;
  }
  if (e->symbol == 0) {
    e->next = first_entry_[to];
    first_entry_[to] = at;
  }
  change_wedge(at, to, vertex_of(to));
}

void Recorder::begin_removal(Index vertex, Index parent) {
  if (moves_kept_) {
    const ByteView stood = moved_.element(parent == kNone ? vertex : parent);
    out_.mesh.parent_position.insert(out_.mesh.parent_position.end(), stood.begin(), stood.end());
  }
  removed_vertices_.push_back(vertex);
  out_.mesh.vsplits.push_back({parent, 0, 0, 0});
  out_.levels.push_back({triangles_, 0});
}

void Recorder::remove_isolated_vertices() {
  std::vector<bool> used(mesh_.vertex_count());
  for (const Entry& e : entries_)
    if (e.wedge != kRestart) used[vertex_of(e.wedge)] = true;
  if (std::ranges::find(used, false) == used.end()) return;
  const Grouped<Index> wedges =
      group_by(mesh_.vertex_count(), mesh_.wedge_count(), [&](Index w) { return vertex_of(w); });
  for (Index v = mesh_.vertex_count(); v-- > 0;) {
    if (used[v]) continue;
    begin_removal(v, kNone);
    for (const Index wedge : wedges[v]) remove_wedge(wedge, kNone);
    end_removal();
  }
}

// Prefetches what the next moves need.
void Recorder::fetch(std::span<const WedgeMove> moves) {
  std::array<Index, kFetched> at;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    at[i] = first_entry_[moves[i].from];
    if (moves[i].to != kNone) prefetch(first_entry_[moves[i].to]);
  }
  constexpr int kSteps = 3;  // lists of entries are hardly ever longer
  for (int step = 0; step < kSteps; ++step)
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (at[i] >= kRemoved) continue;
      const Entry* const e = &entry(at[i]);
      prefetch(e[-2].wedge);
      prefetch(e[2].wedge);
      at[i] = e->next;
    }
}

void Recorder::collapse_all() {
  std::size_t move = 0, fetched = 0;
  for (std::size_t i = 0; i < sequence_.collapses.size(); ++i) {
    const Collapse& c = sequence_.collapses[i];
    if (move >= fetched) {
      fetch(std::span(sequence_.moves)
                .subspan(move, std::min(kFetched, sequence_.moves.size() - move)));
      fetched = move + kFetched;
    }
    collapse(c, std::span(sequence_.moves).subspan(move, c.moves));
    move += c.moves;
    if (moves_kept_) place(c.kept, std::span(sequence_.placements).subspan(3 * i, 3));
  }
}

void Recorder::collapse(const Collapse& collapse, std::span<const WedgeMove> moves) {
  begin_removal(collapse.removed, collapse.kept);
  for (const WedgeMove& move : moves) {
    const Index first = first_entry_[move.from];
    if (first == kRemoved) continue;
    if (move.to == kNone && first != kNone)
      reassign(move.from, collapse.kept);
    else
      remove_wedge(move.from, move.to);
  }
  end_removal();
}

// The wedge keeps its entries and stands at another vertex.
void Recorder::reassign(Index wedge, Index kept) {
  if (wedge_vertex_.empty()) {
    wedge_vertex_.resize(mesh_.wedge_count());
    std::iota(wedge_vertex_.begin(), wedge_vertex_.end(), Index{0});
  }
  wedge_vertex_[wedge] = kept;
  for (Index e = first_entry_[wedge]; e < kRemoved; e = entry(e).next) change_wedge(e, wedge, kept);
  out_.mesh.reassigned.push_back(wedge);
  ++out_.mesh.vsplits.back().reassigned;
}

// Entries of the wedge go over to its replacement; kNone for a wedge that has none.
void Recorder::remove_wedge(Index wedge, Index replacement) {
  std::vector<Index>& map_offsets = out_.mesh.map_offsets;
  const std::size_t first = map_offsets.size();
  for (Index e = first_entry_[wedge]; e < kRemoved; e = entry(e).next) map_offsets.push_back(e);
  first_entry_[wedge] = kRemoved;
  if (map_offsets.size() - first > 1)
    std::sort(map_offsets.begin() + static_cast<std::ptrdiff_t>(first), map_offsets.end());
  for (std::size_t i = first; i < map_offsets.size(); ++i) rewrite(map_offsets[i], replacement);
  const auto count = static_cast<Index>(map_offsets.size() - first);
  removed_wedges_.push_back(wedge);
  out_.mesh.wedge_offset_counts.push_back(count);
  Vsplit& vsplit = out_.mesh.vsplits.back();
  ++vsplit.wedges;
  vsplit.map_offsets += count;
}

void Recorder::place(Index vertex, std::span<const double> position) {
  for (std::size_t c = 0; c < std::min<std::size_t>(3, moved_.count); ++c)
    set_component(moved_, vertex, c, position[c]);
}

void turn_last_round(std::vector<Index>& list, Index last) {
  std::reverse(list.end() - static_cast<std::ptrdiff_t>(last), list.end());
}

// Within a record the lists are in order; see turn_lists_round().
void Recorder::end_removal() {
  ProgressiveMesh& mesh = out_.mesh;
  const Vsplit& vsplit = mesh.vsplits.back();
  turn_last_round(removed_wedges_, vsplit.wedges);
  turn_last_round(mesh.wedge_offset_counts, vsplit.wedges);
  turn_last_round(mesh.reassigned, vsplit.reassigned);
  turn_last_round(mesh.map_offsets, vsplit.map_offsets);
}

void Recorder::turn_lists_round() {
  ProgressiveMesh& mesh = out_.mesh;
  out_.levels.push_back({triangles_, 0});
  std::ranges::reverse(out_.levels);
  std::ranges::reverse(mesh.vsplits);
  for (auto* list : {&removed_vertices_, &removed_wedges_, &mesh.wedge_offset_counts,
                     &mesh.reassigned, &mesh.map_offsets})
    std::ranges::reverse(*list);
  const std::size_t bytes = moved_.element_bytes();
  Bytes& positions = mesh.parent_position;
  if (positions.empty()) return;
  for (std::size_t low = 0, high = positions.size() - bytes; low < high;
       low += bytes, high -= bytes)
    std::swap_ranges(positions.begin() + static_cast<std::ptrdiff_t>(low),
                     positions.begin() + static_cast<std::ptrdiff_t>(low + bytes),
                     positions.begin() + static_cast<std::ptrdiff_t>(high));
}

// A strip shows from the level on that has the last of its triangles to vanish.
void Recorder::count_strips() {
  std::vector<LevelCounts>& levels = out_.levels;  // first, how many strips more each level shows
  const Index vsplits = static_cast<Index>(levels.size() - 1);
  Index first_shown = kNone;
  for (const Entry& e : entries_) {
    if (e.window == kShown)
      first_shown = 0;
    else if (e.window != kNoTriangle)
      first_shown = std::min(first_shown, vsplits - e.window);
    if (e.wedge != kRestart || first_shown == kNone) continue;
    ++levels[first_shown].strips;
    first_shown = kNone;
  }
  for (std::size_t i = 1; i < levels.size(); ++i) levels[i].strips += levels[i - 1].strips;
}

// In order of appearance: the base in that of its map, then what stands nowhere in it, then what
// the records bring. Numbers parents and reassigned wedges, too.
Recorder::Numbering Recorder::number_all() {
  ProgressiveMesh& mesh = out_.mesh;
  Numbering numbers{std::vector<Index>(mesh.vertices, kNone), {}};
  if (!mesh.single_wedges) numbers.wedge_to.assign(mesh.wedges, kNone);
  out_.vertex_from.reserve(mesh.vertices);
  out_.wedge_from.reserve(mesh.single_wedges ? 0 : mesh.wedges);
  const auto number = [](Index i, std::vector<Index>& to, std::vector<Index>& from) {
    if (to[i] != kNone) return;
    to[i] = static_cast<Index>(from.size());
    from.push_back(i);
  };
  const auto number_wedge = [&](Index wedge) {
    if (!mesh.single_wedges) number(wedge, numbers.wedge_to, out_.wedge_from);
    number(vertex_of(wedge), numbers.vertex_to, out_.vertex_from);
  };
  for (const Entry& e : entries_)
    if (e.wedge != kRestart) number_wedge(e.wedge);
  for (Index w = 0; w < mesh.wedges; ++w)
    if (first_entry_[w] != kRemoved) number_wedge(w);
  mesh.base_vertices = static_cast<Index>(out_.vertex_from.size());
  mesh.base_wedges =
      mesh.single_wedges ? mesh.base_vertices : static_cast<Index>(out_.wedge_from.size());

  for (std::size_t k = 0; k < mesh.vsplits.size(); ++k) {
    Index& parent = mesh.vsplits[k].parent;
    number(removed_vertices_[k], numbers.vertex_to, out_.vertex_from);
    parent = numbers.vertex_to[parent == kNone ? removed_vertices_[k] : parent];
  }
  if (mesh.single_wedges) {
    out_.wedge_from = out_.vertex_from;
  } else {
    for (const Index w : removed_wedges_) number(w, numbers.wedge_to, out_.wedge_from);
  }
  for (Index& w : mesh.reassigned) w = numbers.wedge_to[w];
  return numbers;
}

void Recorder::write_base(const Numbering& numbers) {
  ProgressiveMesh& mesh = out_.mesh;
  const std::vector<Index>& wedge_to = mesh.single_wedges ? numbers.vertex_to : numbers.wedge_to;
  mesh.base_map.reserve(entries_.size() - 2 * kMargin);
  for (std::size_t i = kMargin; i < entries_.size() - kMargin; ++i) {
    const Entry& e = entries_[i];
    mesh.base_map.push_back(e.symbol != 0         ? symbol_of(e.symbol)
                            : e.wedge == kRestart ? kRestart
                                                  : wedge_to[e.wedge]);
  }
  if (mesh.single_wedges) return;
  mesh.base_wedge_vertex.resize(mesh.base_wedges);
  for (Index w = 0; w < mesh.base_wedges; ++w)
    mesh.base_wedge_vertex[w] = numbers.vertex_to[vertex_of(out_.wedge_from[w])];
}

Recording Recorder::finish(const StripMap& strips) && {
  ProgressiveMesh& mesh = out_.mesh;
  mesh.name = mesh_.name;
  mesh.groups = mesh_.groups;
  mesh.group_entries = strips.group_entries;
  for (const Attribute& a : mesh_.face_attributes)
    mesh.face_attribute_formats.push_back(a.format());
  mesh.vertices = mesh_.vertex_count();
  mesh.wedges = mesh_.wedge_count();
  mesh.single_wedges = mesh_.wedge_vertex.empty() && mesh.reassigned.empty();
  turn_lists_round();
  count_strips();
  mesh.triangles = out_.levels.back().triangles;
  mesh.strips = out_.levels.back().strips;
  write_base(number_all());
  entries_ = {};
  mesh.position = gather(moves_kept_ ? moved_ : mesh_.position, out_.vertex_from);
  for (const Attribute& a : mesh_.wedge_attributes)
    mesh.wedge_attributes.push_back(gather(a, out_.wedge_from));
  return std::move(out_);
}

}  // namespace

Recording record(const Mesh& mesh, const StripMap& strips, const CollapseSequence& sequence,
                 MapEncoding encoding) {
  assert(sequence.placements.empty() ||
         sequence.placements.size() == 3 * sequence.collapses.size());
  Recorder recorder(mesh, strips, sequence, encoding);
  recorder.remove_isolated_vertices();
  recorder.collapse_all();
  return std::move(recorder).finish(strips);
}

}  // namespace pstrips::inline codecs
