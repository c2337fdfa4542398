#include "tests/support/split_stream.h"

#include <algorithm>
#include <cassert>

#include "codecs/compact/batches.h"
#include "formats/pstrip/payload/compact/split_batch.h"

namespace pstrips::test {
namespace {

/// Which triangles vanish with each collapse.
struct Removals {
  std::vector<Index> first;      ///< by inner node, and one past the end
  std::vector<Index> triangles;  ///< of the source
  std::vector<bool> removed;     ///< by triangle
};

Removals find_removals(const GridMesh& mesh, std::span<const Collapse> collapses,
                       const CollapseForest& forest) {
  const std::size_t faces = mesh.triangles.size() / 3;
  Removals out;
  out.removed.resize(faces);
  // Corners by the vertex that they are merged into, as lists that are joined.
  std::vector<Index> first(mesh.positions.size(), kNone), last(mesh.positions.size(), kNone);
  std::vector<Index> next(mesh.triangles.size(), kNone), now = mesh.triangles;
  for (Index c = 0; c < mesh.triangles.size(); ++c) {
    const Index v = mesh.triangles[c];
    if (first[v] == kNone)
      first[v] = c;
    else
      next[last[v]] = c;
    last[v] = c;
  }
  for (const Index i : forest.sequence()) {
    const Collapse pair = collapses[i];
    out.first.push_back(static_cast<Index>(out.triangles.size()));
    Index* from = &first[pair.removed];
    for (Index c = *from; c != kNone; c = next[c]) {
      const Index face = c / 3;
      if (out.removed[face]) continue;
      now[c] = pair.kept;
      if (now[StarMesh::next_in_face(c)] != pair.kept &&
          now[StarMesh::previous_in_face(c)] != pair.kept)
        continue;
      out.removed[face] = true;
      out.triangles.push_back(face);
    }
    if (*from == kNone) continue;
    if (first[pair.kept] == kNone)
      first[pair.kept] = *from;
    else
      next[last[pair.kept]] = *from;
    last[pair.kept] = last[pair.removed];
    *from = kNone;
  }
  out.first.push_back(static_cast<Index>(out.triangles.size()));
  return out;
}

/// Goes down the forest from the base, as a decoder will, and notes what each split is; positions
/// aside.
class Planner {
 public:
  Planner(const GridMesh& mesh, const CollapseForest& forest, const Removals& removals,
          Placement placement)
      : mesh_(mesh), forest_(forest), removals_(removals), state_(placement) {
    const auto leaf = [&](Index corner) { return forest_.leaf_of(mesh_.triangles[corner]); };
    for (const Index root : forest_.roots()) {
      state_.add_vertex({});
      node_.push_back(root);
    }
    for (Index f = 0; f < mesh.triangles.size() / 3; ++f) {
      if (removals.removed[f]) continue;
      state_.mesh.add_face(forest_.root_of(leaf(3 * f)), forest_.root_of(leaf(3 * f + 1)),
                           forest_.root_of(leaf(3 * f + 2)));
      note_face(f, 0);
    }
    base_ = state_.mesh;
    base_order_ = state_.order;
  }

  struct Planned {
    Index vertex;
    GridSplit split;
  };

  /// Batches by number, the coarsest last, as the decoder takes them from the back.
  void run(Index batches) {
    planned_.resize(batches);
    for (Index batch = batches; batch-- > 0;) {
      std::vector<Index> order;
      order.reserve(2 * state_.order.size());
      for (const Index vertex : state_.order) {
        order.push_back(vertex);
        if (forest_.batch(node_[vertex]) == batch) order.push_back(split(vertex, planned_[batch]));
      }
      state_.order = std::move(order);
    }
  }

  std::vector<std::vector<Planned>>& batches() { return planned_; }
  const StarMesh& base() const { return base_; }
  std::span<const Index> base_order() const { return base_order_; }
  std::span<const Index> nodes() const { return node_; }  ///< of the vertices so far
  std::span<const Index> faces() const { return face_; }  ///< of the source
  std::uint32_t without_chord() const { return without_chord_; }

 private:
  bool belongs(Index vertex, Index leaf) const { return forest_.holds(node_[vertex], leaf); }

  /// The face that was just added is the source's f, from its corner `turn` on.
  void note_face(Index f, unsigned turn) {
    face_.push_back(f);
    for (unsigned k = 0; k < 3; ++k)
      leaf_.push_back(forest_.leaf_of(mesh_.triangles[3 * f + (turn + k) % 3]));
  }

  Index split(Index vertex, std::vector<Planned>& out) {
    const Index node = node_[vertex];
    const Index inner = node - forest_.vertices();
    VertexRing ring;
    state_.mesh.ring_of(vertex, ring);
    Index kept = forest_.kept(node), removed = forest_.removed(node);
    const std::span<const Index> faces =
        std::span(removals_.triangles)
            .subspan(removals_.first[inner], removals_.first[inner + 1] - removals_.first[inner]);
    GridSplit made;
    made.chord = find_chord(ring, kept, removed, faces, made);
    Index added = kNone;
    if (made.chord) {
      if (must_swap(ring, made)) {
        std::swap(made.from, made.to);
        std::swap(kept, removed);
      }
      added = state_.mesh.split(vertex, ring, made.from, made.to);
    } else {
      ++without_chord_;
      std::vector<Index> corners;
      state_.mesh.corners_of(vertex, corners);
      for (const Index corner : corners)
        made.moves.push_back(forest_.holds(removed, leaf_[corner]));
      added = state_.mesh.split_any(vertex, corners, made.moves);
    }
    state_.extend({});
    node_[vertex] = kept;
    node_.push_back(removed);
    add_faces(vertex, added, faces, ring, made);
    out.push_back({vertex, std::move(made)});
    return added;
  }

  /// With optimal placement the two ends are alike: the rule of code_chord() says which is which.
  bool must_swap(const VertexRing& ring, const GridSplit& split) const {
    if (state_.placement != Placement::optimal) return false;
    const unsigned faces = (split.to + ring.size - split.from) % ring.size;
    if (2 * faces != ring.size) return 2 * faces > ring.size;
    return ring.vertex[split.from] > ring.vertex[split.to];
  }

  /// The neighbour of the ring to which a corner of the source belongs, or its size.
  unsigned neighbour_of(const VertexRing& ring, Index leaf) const {
    unsigned i = 0;
    while (i < ring.size && (ring.vertex[i] == kNone || !belongs(ring.vertex[i], leaf))) ++i;
    return i;
  }

  struct Side {
    bool found = false;
    bool at_start;  ///< of the removed vertex's faces: (kept, third, removed)
    Index third;    ///< leaf
  };
  Side side_of(Index face, Index kept, Index removed) const {
    for (unsigned k = 0; k < 3; ++k) {
      const auto leaf = [&](unsigned i) {
        return forest_.leaf_of(mesh_.triangles[3 * face + (k + i) % 3]);
      };
      if (!forest_.holds(kept, leaf(0))) continue;
      if (forest_.holds(removed, leaf(2))) return {true, true, leaf(1)};
      if (forest_.holds(removed, leaf(1))) return {true, false, leaf(2)};
    }
    return {};
  }

  bool find_chord(const VertexRing& ring, Index kept, Index removed, std::span<const Index> faces,
                  GridSplit& split) const {
    if (ring.size < 2 || faces.empty() || faces.size() > 2) return false;
    unsigned absent = ring.size;
    for (unsigned i = 0; i < ring.size; ++i)
      if (ring.vertex[i] == kNone) absent = i;
    unsigned from = ring.size, to = ring.size;
    for (const Index face : faces) {
      const Side side = side_of(face, kept, removed);
      if (!side.found) return false;
      unsigned& end = side.at_start ? from : to;
      if (end != ring.size) return false;
      end = neighbour_of(ring, side.third);
      if (end == ring.size) return false;
    }
    if (from == ring.size) from = absent;
    if (to == ring.size) to = absent;
    if (from == ring.size || to == ring.size || from == to) return false;
    for (unsigned i = from; i != to; i = ring.next(i))
      if (ring.corner[i] != kNone && !forest_.holds(removed, leaf_[ring.corner[i]])) return false;
    for (unsigned i = to; i != from; i = ring.next(i))
      if (ring.corner[i] != kNone && forest_.holds(removed, leaf_[ring.corner[i]])) return false;
    const unsigned side = (to + ring.size - from) % ring.size;
    const unsigned coded =
        state_.placement == Placement::optimal ? std::min(side, ring.size - side) : side;
    if (coded >= SymbolModel::kSymbols) return false;  // the last symbol stands for no chord
    split.from = from;
    split.to = to;
    return true;
  }

  void add_faces(Index vertex, Index added, std::span<const Index> faces, const VertexRing& ring,
                 GridSplit& split) {
    const Index kept = node_[vertex], removed = node_[added];
    if (split.chord) {
      // The mesh has them already, the one at the start first.
      for (const bool at_start : {true, false})
        for (const Index face : faces)
          if (const Side side = side_of(face, kept, removed); side.at_start == at_start)
            note_face(face, turn_to(face, kept));
      return;
    }
    for (const Index face : faces) {
      const Side side = side_of(face, kept, removed);
      assert(side.found);
      const Index third = vertex_of(side.third, ring, vertex);
      split.third.push_back(third);
      split.new_first.push_back(!side.at_start);
      if (side.at_start)
        state_.mesh.add_face(vertex, third, added);
      else
        state_.mesh.add_face(vertex, added, third);
      note_face(face, turn_to(face, kept));
    }
  }

  /// The corner of a source's face that belongs to a node.
  unsigned turn_to(Index face, Index node) const {
    unsigned k = 0;
    while (!forest_.holds(node, forest_.leaf_of(mesh_.triangles[3 * face + k]))) ++k;
    return k;
  }

  /// The vertex that a leaf belongs to now: a neighbour nearly always.
  Index vertex_of(Index leaf, const VertexRing& ring, Index vertex) {
    const unsigned i = neighbour_of(ring, leaf);
    if (i < ring.size) return ring.vertex[i];
    std::vector<Index> corners;
    for (const Index v : {vertex, static_cast<Index>(node_.size() - 1)}) {
      state_.mesh.corners_of(v, corners);
      for (const Index corner : corners)
        for (const Index c : {StarMesh::next_in_face(corner), StarMesh::previous_in_face(corner)})
          if (const Index neighbour = state_.mesh.vertex_of(c); belongs(neighbour, leaf))
            return neighbour;
    }
    Index far = 0;
    while (!belongs(far, leaf)) ++far;
    return far;
  }

  const GridMesh& mesh_;
  const CollapseForest& forest_;
  const Removals& removals_;
  SplitState state_;
  StarMesh base_;
  std::vector<Index> base_order_;
  std::vector<Index> node_;  // of each vertex
  std::vector<Index> leaf_;  // of each corner
  std::vector<Index> face_;  // of the source, for each face
  std::vector<std::vector<Planned>> planned_;
  std::uint32_t without_chord_ = 0;
};

/// Fills in the steps from the finest level up; returns the positions of the base.
std::vector<GridPoint> place(const GridMesh& mesh, Planner& plan, Placement placement) {
  const std::span<const Index> nodes = plan.nodes();
  std::vector<GridPoint> at(nodes.size());
  for (std::size_t v = 0; v < at.size(); ++v) at[v] = mesh.positions[nodes[v]];
  std::size_t added = at.size();
  for (std::vector<Planner::Planned>& batch : plan.batches())
    for (auto record = batch.rbegin(); record != batch.rend(); ++record) {
      --added;
      GridPoint& kept = at[record->vertex];
      record->split.step = at[added] - kept;
      if (placement == Placement::optimal) kept = kept + halved(record->split.step);
    }
  at.resize(added);
  return at;
}

SplitState state_of(Placement placement, const GridMesh& base) {
  SplitState state(placement);
  for (const GridPoint at : base.positions) state.add_vertex(at);
  for (std::size_t c = 0; c < base.triangles.size(); c += 3)
    state.mesh.add_face(base.triangles[c], base.triangles[c + 1], base.triangles[c + 2]);
  return state;
}

}  // namespace

SplitStream encode_splits(const GridMesh& mesh, std::span<const Collapse> collapses,
                          const BatchOptions& options, SplitStreamMap* map) {
  const auto vertices = static_cast<Index>(mesh.positions.size());
  const auto faces = static_cast<Index>(mesh.triangles.size() / 3);
  const std::vector<Index> batch = batches_of(collapses, vertices, options);
  const CollapseForest forest(collapses, batch, vertices);
  const Removals removals = find_removals(mesh, collapses, forest);
  Planner plan(mesh, forest, removals, options.placement);
  plan.run(batch.empty() ? 0 : 1 + *std::ranges::max_element(batch));

  SplitStream out{options.placement, {}, {}, vertices, faces};
  out.base.positions = place(mesh, plan, options.placement);
  out.base.triangles.assign(plan.base().corners().begin(), plan.base().corners().end());
  SplitState state = state_of(options.placement, out.base);
  RansWriter writer;
  for (auto records = plan.batches().rbegin(); records != plan.batches().rend(); ++records) {
    auto next = records->begin();
    const auto coded = code_batch(writer, state, BatchLimits{vertices, faces}, [&](Index vertex) {
      return next != records->end() && next->vertex == vertex ? &(next++)->split : nullptr;
    });
    assert(coded && next == records->end());
    static_cast<void>(coded);
    out.batches.push_back(writer.finish());
  }
  if (map != nullptr) {
    map->vertex.assign(plan.nodes().begin(), plan.nodes().end());
    map->triangle.assign(plan.faces().begin(), plan.faces().end());
    map->without_chord = plan.without_chord();
  }
  return out;
}

Result<SplitDecoder> SplitDecoder::start(Placement placement, const GridMesh& base,
                                         std::uint32_t vertices, std::uint32_t triangles) {
  if (base.positions.size() > vertices || base.triangles.size() / 3 > triangles)
    return fail(ErrorCode::corrupt, "base is larger than the mesh");
  if (!std::ranges::all_of(base.positions, is_on_grid))
    return fail(ErrorCode::corrupt, "vertex of the base is off the grid");
  if (base.triangles.size() % 3 != 0) return fail(ErrorCode::corrupt, "triangle lacks a vertex");
  for (std::size_t c = 0; c < base.triangles.size(); c += 3) {
    const Index x = base.triangles[c], y = base.triangles[c + 1], z = base.triangles[c + 2];
    if (std::max({x, y, z}) >= base.positions.size())
      return fail(ErrorCode::corrupt, "triangle of the base names a vertex past the end");
    if (x == y || y == z || z == x)
      return fail(ErrorCode::corrupt, "triangle of the base names a vertex twice");
  }
  SplitDecoder out(placement, vertices, triangles);
  out.state_ = state_of(placement, base);
  return out;
}

Result<void> SplitDecoder::add(ByteView batch) {
  if (broken_) return fail(ErrorCode::corrupt, "a batch before was corrupt");
  RansReader reader(batch);
  Result<void> ok = code_batch(reader, state_, BatchLimits{vertices_, triangles_},
                               [](Index) -> const GridSplit* { return nullptr; });
  if (ok && !reader.complete())
    ok = fail(ErrorCode::corrupt, "batch is longer or shorter than its bytes");
  broken_ = !ok;
  return ok;
}

GridMesh SplitDecoder::mesh() const {
  const std::span<const Index> corners = state_.mesh.corners();
  return {state_.position, {corners.begin(), corners.end()}};
}

}  // namespace pstrips::test
