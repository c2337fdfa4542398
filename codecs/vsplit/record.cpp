// Strip-edge collapses on an index map, recorded as vsplits.
//
// [Kim04] Kim, Park, Yang, Neelamkavil, "A Rendering-Efficient Progressive Transmission of 3D
// Meshes", §3.

#include "codecs/vsplit/record.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace pstrip {
namespace {

// What one collapse (or one lone vertex) took away, fine to coarse.
struct Removal {
  Index vertex;
  Index parent;  // kNone: on its own
  Index wedges, carried, places;
};

void append_element(const Attribute& from, Index i, Bytes& to) {
  const ByteView element = from.element(i);
  to.insert(to.end(), element.begin(), element.end());
}

class Recorder {
 public:
  Recorder(const Mesh& mesh, const StripMap& strips, MapEncoding encoding, Placement placement)
      : mesh_(mesh),
        position_(mesh.position),
        placement_(placement),
        resolved_(strips.entries),
        map_(strips.entries),
        symbols_(encoding == MapEncoding::offset_difference) {
    wedge_vertex_.resize(mesh.wedge_count());
    for (Index w = 0; w < mesh.wedge_count(); ++w) wedge_vertex_[w] = mesh.vertex_of(w);
    wedge_alive_.assign(mesh.wedge_count(), 1);
    find_strips();
    if (symbols_) encode_repetitions();
    list_entries();
    count_triangles();
  }

  void remove_lone_vertices();
  void collapse(const Collapse& collapse, std::span<const WedgeMove> moves);
  /// The kept vertex of the last collapse goes there.
  void place(Index vertex, std::span<const double> position);
  Recording finish(const StripMap& strips, MapEncoding encoding) &&;

 private:
  void find_strips();
  void encode_repetitions();
  void list_entries();
  void count_triangles();
  bool is_triangle(std::size_t window) const;
  void revisit_windows(std::size_t entry);
  void rewrite(Index entry, Index to);
  void change_resolved(Index entry, Index to);
  void visit_entries_of(Index wedge);
  void push(Index vertex, Index parent, Index wedges, Index carried, Index places, float error);
  void note_removed_wedge(Index wedge, std::vector<Index>& places);

  const Mesh& mesh_;
  Attribute position_;  // where vertices stand, or stood when they were removed
  Placement placement_;
  std::vector<Index> resolved_;  // wedge at every entry
  std::vector<Index> map_;       // the same with symbols
  bool symbols_;
  std::vector<Index> wedge_vertex_;
  std::vector<std::uint8_t> wedge_alive_;
  std::vector<Index> strip_of_;         // per entry; kNone at restarts
  std::vector<std::uint8_t> triangle_;  // per window (by first entry)
  std::vector<Index> strip_triangles_;
  std::vector<Index> head_, next_;  // entries that hold each wedge itself, as lists
  Index triangles_ = 0, strips_ = 0;
  std::vector<std::uint8_t> vertex_alive_;
  std::vector<Index> pending_;

  std::vector<Removal> removals_;
  std::vector<LevelCounts> counts_;                      // before each removal, fine to coarse
  std::vector<Index> removed_wedges_, removed_carried_;  // per removal, in record order
  std::vector<Index> wedge_places_, places_;             // per removed wedge
  Bytes parent_positions_;  // before each removal, fine to coarse; with free placement
  float error_ = 0;
};

void Recorder::find_strips() {
  strip_of_.assign(map_.size(), kNone);
  Index strip = 0;
  for (std::size_t i = 0; i < map_.size(); ++i) {
    if (map_[i] == kRestart)
      ++strip;
    else
      strip_of_[i] = strip;
  }
  strip_triangles_.assign(std::size_t{strip} + 1, 0);
}

// "All swap operations can be encoded with symbol R-2" [Kim04 §3.4]; a doubled start with R-1.
void Recorder::encode_repetitions() {
  for (std::size_t i = 1; i < map_.size(); ++i) {
    if (map_[i] == kRestart) continue;
    if (i >= 2 && strip_of_[i - 2] == strip_of_[i] && resolved_[i - 2] == resolved_[i])
      map_[i] = kSameAsMinus2;
    else if (strip_of_[i - 1] == strip_of_[i] && resolved_[i - 1] == resolved_[i])
      map_[i] = kSameAsMinus1;
  }
}

void Recorder::list_entries() {
  head_.assign(mesh_.wedge_count(), kNone);
  next_.assign(map_.size(), kNone);
  for (std::size_t i = map_.size(); i-- > 0;) {
    if (!is_wedge(map_[i])) continue;
    next_[i] = head_[map_[i]];
    head_[map_[i]] = static_cast<Index>(i);
  }
}

bool Recorder::is_triangle(std::size_t window) const {
  const Index a = wedge_vertex_[resolved_[window]], b = wedge_vertex_[resolved_[window + 1]],
              c = wedge_vertex_[resolved_[window + 2]];
  return a != b && b != c && a != c;
}

void Recorder::count_triangles() {
  triangle_.assign(map_.size(), 0);
  for (std::size_t i = 0; i + 2 < map_.size(); ++i) {
    if (strip_of_[i] == kNone || strip_of_[i + 2] != strip_of_[i] || !is_triangle(i)) continue;
    triangle_[i] = 1;
    ++triangles_;
    if (strip_triangles_[strip_of_[i]]++ == 0) ++strips_;
  }
}

// A collapse only ever makes triangles degenerate, so a window that is not one need not be looked
// at.
void Recorder::revisit_windows(std::size_t entry) {
  for (std::size_t i = entry >= 2 ? entry - 2 : 0; i <= entry; ++i) {
    if (triangle_[i] == 0 || is_triangle(i)) continue;
    triangle_[i] = 0;
    --triangles_;
    if (--strip_triangles_[strip_of_[i]] == 0) --strips_;
  }
}

// Gives the entry and all whose chains end at it another wedge.
void Recorder::change_resolved(Index entry, Index to) {
  pending_.assign(1, entry);
  resolved_[entry] = to;
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    const Index at = pending_[k];
    if (symbols_)
      for (const int d : {-2, -1, 1, 2}) {
        const std::size_t from = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) - d);
        if (from >= map_.size() || map_[from] != symbol_of(d)) continue;
        resolved_[from] = to;
        pending_.push_back(static_cast<Index>(from));
      }
  }
  for (const Index at : pending_) revisit_windows(at);
}

void Recorder::visit_entries_of(Index wedge) {
  for (Index e = head_[wedge]; e != kNone; e = next_[e]) change_resolved(e, wedge);
}

// Entry of a removed wedge: takes a symbol when the wedge that replaces it stands within two
// places, the wedge itself otherwise (common edge and spiral, [Kim04 §3.4]).
//
// No cycle can arise: an entry that resolves to `to` at this moment has a chain of entries that
// all do, and this one does not yet.
void Recorder::rewrite(Index entry, Index to) {
  map_[entry] = to;
  if (symbols_)
    for (const int d : {-1, 1, -2, 2}) {
      const std::size_t at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(entry) + d);
      if (at >= map_.size() || strip_of_[at] != strip_of_[entry] || resolved_[at] != to) continue;
      map_[entry] = symbol_of(d);
      break;
    }
  if (map_[entry] == to) {
    next_[entry] = head_[to];
    head_[to] = entry;
  }
  change_resolved(entry, to);
}

void Recorder::note_removed_wedge(Index wedge, std::vector<Index>& places) {
  wedge_alive_[wedge] = 0;
  removed_wedges_.push_back(wedge);
  std::ranges::sort(places);
  wedge_places_.push_back(static_cast<Index>(places.size()));
  places_.insert(places_.end(), places.begin(), places.end());
}

void Recorder::push(Index vertex, Index parent, Index wedges, Index carried, Index places,
                    float error) {
  if (placement_ == Placement::free)
    append_element(position_, parent == kNone ? vertex : parent, parent_positions_);
  removals_.push_back({vertex, parent, wedges, carried, places});
  counts_.push_back({triangles_, strips_, error_});
  error_ = std::max(error_, error);
}

void Recorder::remove_lone_vertices() {
  std::vector<std::uint8_t> used(mesh_.vertex_count(), 0);
  for (const Index w : resolved_)
    if (w != kRestart) used[wedge_vertex_[w]] = 1;
  std::vector<Index> first(std::size_t{mesh_.vertex_count()} + 1, 0), wedges(mesh_.wedge_count());
  for (const Index v : wedge_vertex_) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Index> at(first.begin(), first.end() - 1);
  for (Index w = 0; w < mesh_.wedge_count(); ++w) wedges[at[wedge_vertex_[w]]++] = w;
  std::vector<Index> no_places;
  vertex_alive_.assign(mesh_.vertex_count(), 1);
  for (Index v = mesh_.vertex_count(); v-- > 0;) {
    if (used[v]) continue;
    vertex_alive_[v] = 0;
    push(v, kNone, first[v + 1] - first[v], 0, 0, 0);
    for (Index k = first[v]; k < first[v + 1]; ++k) note_removed_wedge(wedges[k], no_places);
  }
}

void Recorder::collapse(const Collapse& collapse, std::span<const WedgeMove> moves) {
  assert(vertex_alive_[collapse.removed] && vertex_alive_[collapse.kept]);
  vertex_alive_[collapse.removed] = 0;
  const std::size_t record = removals_.size();
  push(collapse.removed, collapse.kept, 0, 0, 0, collapse.error);
  std::vector<Index> places;
  for (const WedgeMove& move : moves) {
    if (!wedge_alive_[move.from]) continue;
    const bool carried = move.to == kNone && head_[move.from] != kNone;
    if (carried) {
      wedge_vertex_[move.from] = collapse.kept;
      visit_entries_of(move.from);
      removed_carried_.push_back(move.from);
      ++removals_[record].carried;
      continue;
    }
    places.clear();
    for (Index e = head_[move.from]; e != kNone; e = next_[e]) places.push_back(e);
    note_removed_wedge(move.from, places);
    for (const Index e : places) rewrite(e, move.to);
    ++removals_[record].wedges;
    removals_[record].places += static_cast<Index>(places.size());
  }
}

void Recorder::place(Index vertex, std::span<const double> position) {
  for (std::size_t c = 0; c < std::min<std::size_t>(3, position_.count); ++c)
    set_component(position_, vertex, c, position[c]);
}

Attribute in_order(const Attribute& from, std::span<const Index> order) {
  Attribute out{from.semantic, from.type, from.count, from.normalized, {}};
  out.data.reserve(from.data.size());
  for (const Index i : order) append_element(from, i, out.data);
  return out;
}

Recording Recorder::finish(const StripMap& strips, MapEncoding encoding) && {
  Recording out;
  ProgressiveMesh& mesh = out.mesh;
  mesh.name = mesh_.name;
  mesh.encoding = encoding;
  mesh.placement = placement_;
  mesh.groups = mesh_.groups;
  mesh.group_entries = strips.group_entries;
  for (const Attribute& a : mesh_.face_attributes)
    mesh.face_attribute_formats.push_back({a.semantic, a.type, a.count, a.normalized, {}});
  mesh.vertices = mesh_.vertex_count();
  mesh.wedges = mesh_.wedge_count();
  mesh.single_wedges = mesh_.wedge_vertex.empty() && removed_carried_.empty();
  mesh.triangles = counts_.empty() ? triangles_ : counts_.front().triangles;
  mesh.strips = counts_.empty() ? strips_ : counts_.front().strips;

  // The base: what is left, in order of appearance in the map, then what stands nowhere in it.
  std::vector<Index> vertex_to(mesh.vertices, kNone), wedge_to(mesh.wedges, kNone);
  const auto number_vertex = [&](Index v) {
    if (vertex_to[v] != kNone) return;
    vertex_to[v] = static_cast<Index>(out.vertex_from.size());
    out.vertex_from.push_back(v);
  };
  const auto number_wedge = [&](Index w) {
    if (wedge_to[w] != kNone) return;
    wedge_to[w] = static_cast<Index>(out.wedge_from.size());
    out.wedge_from.push_back(w);
    number_vertex(wedge_vertex_[w]);
  };
  for (const Index w : resolved_)
    if (w != kRestart) number_wedge(w);
  for (Index w = 0; w < mesh.wedges; ++w)
    if (wedge_alive_[w]) number_wedge(w);
  mesh.base_vertices = static_cast<Index>(out.vertex_from.size());
  mesh.base_wedges = static_cast<Index>(out.wedge_from.size());

  // The records, coarse to fine. Their lists were pushed fine to coarse, a removal's in order.
  std::size_t wedge = removed_wedges_.size(), carried = removed_carried_.size(),
              place = places_.size();
  const std::size_t position_bytes = position_.element_bytes();
  mesh.vsplits.reserve(removals_.size());
  mesh.parent_position.reserve(parent_positions_.size());
  mesh.places.reserve(places_.size());
  out.levels.push_back({triangles_, strips_, error_});
  for (std::size_t k = removals_.size(); k-- > 0;) {
    const Removal& r = removals_[k];
    number_vertex(r.vertex);
    const Index parent = r.parent == kNone ? vertex_to[r.vertex] : vertex_to[r.parent];
    wedge -= r.wedges, carried -= r.carried, place -= r.places;
    for (std::size_t i = wedge; i < wedge + r.wedges; ++i) number_wedge(removed_wedges_[i]);
    mesh.vsplits.push_back({parent, r.wedges, r.carried, r.places});
    if (placement_ == Placement::free) {
      const auto stood =
          parent_positions_.begin() + static_cast<std::ptrdiff_t>(k * position_bytes);
      mesh.parent_position.insert(mesh.parent_position.end(), stood,
                                  stood + static_cast<std::ptrdiff_t>(position_bytes));
    }
    mesh.places.insert(mesh.places.end(), places_.begin() + static_cast<std::ptrdiff_t>(place),
                       places_.begin() + static_cast<std::ptrdiff_t>(place + r.places));
    mesh.wedge_places.insert(mesh.wedge_places.end(),
                             wedge_places_.begin() + static_cast<std::ptrdiff_t>(wedge),
                             wedge_places_.begin() + static_cast<std::ptrdiff_t>(wedge + r.wedges));
    for (std::size_t i = carried; i < carried + r.carried; ++i)
      mesh.carried.push_back(removed_carried_[i]);
    out.levels.push_back(counts_[k]);
  }
  for (Index& w : mesh.carried) w = wedge_to[w];

  mesh.base_map = std::move(map_);
  for (Index& entry : mesh.base_map)
    if (is_wedge(entry)) entry = wedge_to[entry];
  if (!mesh.single_wedges) {
    mesh.base_wedge_vertex.resize(mesh.base_wedges);
    for (Index w = 0; w < mesh.base_wedges; ++w)
      mesh.base_wedge_vertex[w] = vertex_to[wedge_vertex_[out.wedge_from[w]]];
  }
  mesh.position = in_order(position_, out.vertex_from);
  for (const Attribute& a : mesh_.wedge_attributes)
    mesh.wedge_attributes.push_back(in_order(a, out.wedge_from));
  return out;
}

}  // namespace

Recording record(const Mesh& mesh, const StripMap& strips, const CollapseSequence& sequence,
                 MapEncoding encoding) {
  assert(sequence.placements.empty() ||
         sequence.placements.size() == 3 * sequence.collapses.size());
  const bool moves_kept = !sequence.placements.empty();
  Recorder recorder(mesh, strips, encoding, moves_kept ? Placement::free : Placement::subset);
  recorder.remove_lone_vertices();
  std::size_t move = 0;
  for (std::size_t i = 0; i < sequence.collapses.size(); ++i) {
    const Collapse& collapse = sequence.collapses[i];
    recorder.collapse(collapse, std::span(sequence.moves).subspan(move, collapse.moves));
    move += collapse.moves;
    if (moves_kept) recorder.place(collapse.kept, std::span(sequence.placements).subspan(3 * i, 3));
  }
  return std::move(recorder).finish(strips, encoding);
}

}  // namespace pstrip
