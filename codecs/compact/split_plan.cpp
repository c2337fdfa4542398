#include "codecs/compact/split_plan.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "codecs/compact/base_order.h"

namespace pstrips::inline codecs {
namespace {

// A triangle that a collapse takes away, and which corners of it the two vertices are.
struct Vanished {
  Index triangle;
  Index kept, removed;
  Index third;  // by what its third vertex is called after the batch
  // Of the new vertex's faces, when it is the removed one: (kept, third, removed).
  bool is_at_start() const { return removed == (kept + 2) % 3; }
  Index third_corner() const { return 3 - kept - removed; }
};

struct Removals {
  std::vector<Index> first{0};  // by inner node, and one past the end
  std::vector<Vanished> triangles;
  std::vector<bool> removed;  // by triangle

  std::span<const Vanished> of(Index inner) const {
    return std::span(triangles).subspan(first[inner], first[inner + 1] - first[inner]);
  }
};

// The corners at each vertex while vertices are merged.
class CornerLists {
 public:
  CornerLists(std::span<const Index> corners, Index vertices)
      : now_(corners.begin(), corners.end()),
        next_(corners.size(), kNone),
        first_(vertices, kNone),
        last_(vertices, kNone) {
    for (Index c = 0; c < now_.size(); ++c) append(now_[c], c, c);
  }

  Index vertex_of(Index corner) const { return now_[corner]; }

  // Calls visit(corner) once the corner has gone over.
  template <class Visit>
  void merge(Index removed, Index kept, Visit&& visit) {
    for (Index c = first_[removed]; c != kNone; c = next_[c]) {
      now_[c] = kept;
      visit(c);
    }
    if (first_[removed] != kNone) append(kept, first_[removed], last_[removed]);
    first_[removed] = kNone;
  }

 private:
  void append(Index vertex, Index first, Index last) {
    (first_[vertex] == kNone ? first_[vertex] : next_[last_[vertex]]) = first;
    last_[vertex] = last;
  }

  std::vector<Index> now_, next_, first_, last_;
};

// By what each vertex is called after a batch.
class Names {
 public:
  Names(std::span<const Collapse> collapses, const CollapseForest& forest)
      : kept_(forest.vertices(), kNone), batch_(forest.vertices(), kNone) {
    for (Index inner = 0; inner < forest.collapses(); ++inner) {
      const Collapse& pair = collapses[forest.sequence()[inner]];
      kept_[pair.removed] = pair.kept;
      batch_[pair.removed] = forest.batch(forest.vertices() + inner);
    }
  }
  Index after(Index batch, Index vertex) const {
    return batch_[vertex] == batch ? kept_[vertex] : vertex;
  }

 private:
  std::vector<Index> kept_, batch_;
};

Removals find_removals(std::span<const Index> triangles, std::span<const Collapse> collapses,
                       const CollapseForest& forest) {
  Removals out;
  out.removed.resize(triangles.size() / 3);
  CornerLists lists(triangles, forest.vertices());
  const Names names(collapses, forest);
  for (Index inner = 0; inner < forest.collapses(); ++inner) {
    const Collapse& pair = collapses[forest.sequence()[inner]];
    const Index batch = forest.batch(forest.vertices() + inner);
    lists.merge(pair.removed, pair.kept, [&](Index c) {
      const Index triangle = c / 3;
      if (out.removed[triangle]) return;
      const Index next = StarMesh::next_in_face(c), previous = StarMesh::previous_in_face(c);
      const bool kept_is_next = lists.vertex_of(next) == pair.kept;
      if (!kept_is_next && lists.vertex_of(previous) != pair.kept) return;
      out.removed[triangle] = true;
      const Index kept = kept_is_next ? next : previous, third = kept_is_next ? previous : next;
      out.triangles.push_back(
          {triangle, kept % 3, c % 3, names.after(batch, lists.vertex_of(third))});
    });
    out.first.push_back(static_cast<Index>(out.triangles.size()));
  }
  return out;
}

class Planner {
 public:
  Planner(std::span<const Index> triangles, std::span<const Collapse> collapses,
          const CollapseForest& forest, Placement placement)
      : triangles_(triangles),
        collapses_(collapses),
        forest_(forest),
        removals_(find_removals(triangles, collapses, forest)),
        placement_(placement),
        vertex_named_(forest.vertices(), kNone) {
    mesh_.reserve(forest.vertices(), triangles.size() / 3);
  }

  void add_base();
  void add_batch(Index batch);
  SplitPlan finish() &&;

 private:
  // The new vertex gets the faces between these neighbours of a ring.
  struct Chord {
    unsigned from, to;
  };
  // The two vertices that a node becomes.
  struct Pair {
    Index kept, removed;
  };

  Index name_of(Index node) const {
    if (forest_.is_leaf(node)) return node;
    return collapses_[forest_.sequence()[node - forest_.vertices()]].kept;
  }
  Index leaf_at(Index triangle, unsigned corner) const {
    return forest_.leaf_of(triangles_[std::size_t{3} * triangle + corner]);
  }
  // A vertex may have been split already in the batch: its triangles are at either of the two then.
  Index third_of(const Vanished& v) const {
    const Index vertex = vertex_named_[v.third];
    const bool holds = forest_.holds(node_[vertex], leaf_at(v.triangle, v.third_corner()));
    return holds ? vertex : partner_[vertex];
  }
  Index split(Index vertex);
  std::optional<Chord> find_chord(const Pair& pair) const;
  bool parts_faces(const Chord& chord, Index removed) const;
  bool must_swap(const Chord& chord) const;
  void move_around(Index vertex, const Chord& chord);
  void move_any(Index vertex, const Pair& pair);
  void note_triangle(Index from, Index turn);

  std::span<const Index> triangles_;
  std::span<const Collapse> collapses_;
  const CollapseForest& forest_;
  Removals removals_;
  Placement placement_;
  StarMesh mesh_;
  std::vector<Index> order_;
  std::vector<Index> node_;          // of each vertex
  std::vector<Index> leaf_;          // of each corner
  std::vector<Index> partner_;       // of each vertex in its last split
  std::vector<Index> vertex_named_;  // by the source's vertex that its node is called by
  VertexRing ring_;                  // scratch, as are those below
  std::vector<Vanished> brought_;
  std::vector<Index> corners_;
  std::vector<bool> moves_;
  SplitPlan out_;
};

void Planner::note_triangle(Index from, Index turn) {
  out_.triangles.push_back({from, static_cast<std::uint8_t>(turn)});
  for (unsigned k = 0; k < 3; ++k) leaf_.push_back(leaf_at(from, (turn + k) % 3));
}

// Vertices of no triangle that nothing was merged into are left out.
void Planner::add_base() {
  const std::span<const Index> roots = forest_.roots();
  std::vector<Index> corners, from;
  std::vector<bool> used(roots.size());
  for (Index r = 0; r < roots.size(); ++r) used[r] = !forest_.is_leaf(roots[r]);
  for (Index t = 0; t < removals_.removed.size(); ++t) {
    if (removals_.removed[t]) continue;
    from.push_back(t);
    for (unsigned k = 0; k < 3; ++k) corners.push_back(forest_.root_of(leaf_at(t, k)));
  }
  for (const Vanished& v : removals_.triangles)
    for (unsigned k = 0; k < 3; ++k) used[forest_.root_of(leaf_at(v.triangle, k))] = true;
  for (const Index r : corners) used[r] = true;
  const BaseOrder order = base_order(corners, static_cast<Index>(roots.size()));
  std::vector<Index> number(roots.size(), kNone);
  for (const Index r : order.vertex) {
    if (!used[r]) continue;
    number[r] = mesh_.add_vertex();
    node_.push_back(roots[r]);
    partner_.push_back(kNone);
    order_.push_back(number[r]);
    vertex_named_[name_of(roots[r])] = number[r];
  }
  for (std::size_t t = 0; t < order.triangle.size(); ++t) {
    const Index* const c = corners.data() + std::size_t{3} * order.triangle[t];
    const unsigned turn = order.turn[t];
    mesh_.add_face(number[c[turn]], number[c[(turn + 1) % 3]], number[c[(turn + 2) % 3]]);
    note_triangle(from[order.triangle[t]], turn);
  }
  out_.base_vertices = mesh_.vertex_count();
  out_.base_triangles = mesh_.face_count();
}

void Planner::add_batch(Index batch) {
  std::vector<Index> order;
  order.reserve(2 * order_.size());
  const std::size_t before = out_.splits.size();
  for (const Index vertex : order_) {
    order.push_back(vertex);
    if (forest_.batch(node_[vertex]) == batch) order.push_back(split(vertex));
  }
  order_ = std::move(order);
  out_.batches.push_back(static_cast<Index>(out_.splits.size() - before));
}

Index Planner::split(Index vertex) {
  const Index inner = node_[vertex] - forest_.vertices();
  Pair pair{forest_.kept(node_[vertex]), forest_.removed(node_[vertex])};
  const std::span<const Vanished> vanished = removals_.of(inner);
  brought_.assign(vanished.begin(), vanished.end());
  mesh_.ring_of(vertex, ring_);
  std::optional<Chord> chord = find_chord(pair);
  if (chord && must_swap(*chord)) {
    std::swap(chord->from, chord->to);
    std::swap(pair.kept, pair.removed);
    for (Vanished& v : brought_) std::swap(v.kept, v.removed);
  }
  std::ranges::stable_partition(brought_, &Vanished::is_at_start);
  out_.splits.push_back(
      {vertex, inner, static_cast<Index>(brought_.size()), static_cast<Index>(out_.moved.size())});
  const Index added = mesh_.vertex_count();
  vertex_named_[name_of(pair.kept)] = vertex;
  vertex_named_[name_of(pair.removed)] = added;
  if (chord)
    move_around(vertex, *chord);
  else
    move_any(vertex, pair);
  node_[vertex] = pair.kept;
  node_.push_back(pair.removed);
  partner_[vertex] = added;
  partner_.push_back(vertex);
  for (const Vanished& v : brought_) note_triangle(v.triangle, v.kept);
  return added;
}

std::optional<Planner::Chord> Planner::find_chord(const Pair& pair) const {
  if (ring_.size < 2 || brought_.empty() || brought_.size() > 2) return {};
  const auto place_of = [&](Index vertex) {
    unsigned i = 0;
    while (i < ring_.size && ring_.vertex[i] != vertex) ++i;
    return i;
  };
  constexpr unsigned kOpen = kNone;
  Chord chord{kOpen, kOpen};
  for (const Vanished& v : brought_) {
    unsigned& end = v.is_at_start() ? chord.from : chord.to;
    if (end != kOpen) return {};
    end = place_of(third_of(v));
  }
  for (unsigned* end : {&chord.from, &chord.to})
    if (*end == kOpen) *end = place_of(kNone);
  if (chord.from == ring_.size || chord.to == ring_.size || chord.from == chord.to) return {};
  if (!parts_faces(chord, pair.removed)) return {};
  return chord;
}

bool Planner::parts_faces(const Chord& chord, Index removed) const {
  const auto holds = [&](unsigned first, unsigned end, bool wanted) {
    for (unsigned i = first; i != end; i = ring_.next(i))
      if (ring_.corner[i] != kNone && forest_.holds(removed, leaf_[ring_.corner[i]]) != wanted)
        return false;
    return true;
  };
  return holds(chord.from, chord.to, true) && holds(chord.to, chord.from, false);
}

bool Planner::must_swap(const Chord& chord) const {
  if (placement_ != Placement::optimal) return false;
  const unsigned side = (chord.to + ring_.size - chord.from) % ring_.size;
  if (2 * side != ring_.size) return 2 * side > ring_.size;
  return ring_.vertex[chord.from] > ring_.vertex[chord.to];
}

void Planner::move_around(Index vertex, const Chord& chord) {
  for (unsigned i = chord.from; i != chord.to; i = ring_.next(i))
    if (ring_.corner[i] != kNone) out_.moved.push_back(ring_.corner[i]);
  mesh_.split(vertex, ring_, chord.from, chord.to);
}

void Planner::move_any(Index vertex, const Pair& pair) {
  mesh_.corners_of(vertex, corners_);
  moves_.assign(corners_.size(), false);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    moves_[i] = forest_.holds(pair.removed, leaf_[corners_[i]]);
    if (moves_[i]) out_.moved.push_back(corners_[i]);
  }
  const Index added = mesh_.split_any(vertex, corners_, moves_);
  for (const Vanished& v : brought_) {
    const Index third = third_of(v);
    if (v.is_at_start())
      mesh_.add_face(vertex, third, added);
    else
      mesh_.add_face(vertex, added, third);
  }
}

SplitPlan Planner::finish() && {
  assert(out_.triangles.size() == triangles_.size() / 3);
  assert(std::ranges::all_of(node_, [&](Index n) { return forest_.is_leaf(n); }));
  out_.vertex_from = std::move(node_);
  return std::move(out_);
}

}  // namespace

SplitPlan plan_splits(std::span<const Index> triangles, std::span<const Collapse> collapses,
                      const CollapseForest& forest, Index batches, Placement placement) {
  Planner planner(triangles, collapses, forest, placement);
  planner.add_base();
  for (Index batch = batches; batch-- > 0;) planner.add_batch(batch);
  return std::move(planner).finish();
}

}  // namespace pstrips::inline codecs
