#include "core/star_mesh.h"

#include <cassert>

namespace pstrips::inline core {

void StarMesh::reserve(std::size_t vertices, std::size_t faces) {
  vertex_.reserve(3 * faces);
  next_.reserve(3 * faces);
  stars_.reserve(vertices);
}

Index StarMesh::add_vertex() {
  stars_.push_back({kNone, 0, 0});
  return static_cast<Index>(stars_.size() - 1);
}

Index StarMesh::add_face(Index a, Index b, Index c) {
  for (const Index vertex : {a, b, c}) {
    assert(vertex < stars_.size());
    Star& star = stars_[vertex];
    vertex_.push_back(vertex);
    next_.push_back(star.first);
    star.first = static_cast<Index>(vertex_.size() - 1);
    ++star.faces;
  }
  return static_cast<Index>(vertex_.size() / 3 - 1);
}

void StarMesh::link(Index corner, Index vertex) {
  Star& star = stars_[vertex];
  vertex_[corner] = vertex;
  next_[corner] = star.first;
  star.first = corner;
  ++star.faces;
}

void StarMesh::corners_of(Index vertex, std::vector<Index>& out) const {
  out.clear();
  for (Index corner = stars_[vertex].first; corner != kNone; corner = next_[corner])
    out.push_back(corner);
}

void StarMesh::ring_of(Index vertex, VertexRing& ring) const {
  constexpr std::uint8_t kNoFace = 255;
  ring.size = 0;
  ring.open = false;
  const Index n = stars_[vertex].faces;
  if (n == 0 || n > VertexRing::kMaxSize - 2) return;
  // Each face as an arrow from one neighbour to the next.
  std::array<Index, VertexRing::kMaxSize> from, to, corner;
  std::array<std::uint8_t, VertexRing::kMaxSize> after;
  Index count = 0;
  for (Index c = stars_[vertex].first; c != kNone; c = next_[c], ++count) {
    corner[count] = c;
    from[count] = vertex_of(next_in_face(c));
    to[count] = vertex_of(previous_in_face(c));
    Index& slot = stars_[from[count]].slot;
    if (slot < count && from[slot] == from[count]) return;  // two faces leave one neighbour
    slot = count;
  }
  std::uint64_t entered = 0;
  unsigned ends = 0;
  for (Index i = 0; i < n; ++i) {
    const Index slot = stars_[to[i]].slot;
    if (slot >= n || from[slot] != to[i]) {
      if (++ends > 1) return;  // several fans
      after[i] = kNoFace;
    } else {
      if (entered >> slot & 1) return;  // two faces reach one neighbour
      entered |= std::uint64_t{1} << slot;
      after[i] = static_cast<std::uint8_t>(slot);
    }
  }
  unsigned at = 0;
  if (ends == 1)
    while (entered >> at & 1) ++at;
  unsigned size = 0;
  for (const unsigned start = at; at != kNoFace && (size == 0 || at != start); at = after[at]) {
    ring.vertex[size] = from[at];
    ring.corner[size++] = corner[at];
    if (after[at] != kNoFace) continue;
    ring.vertex[size] = to[at];
    ring.corner[size++] = kNone;
    ring.vertex[size] = kNone;
    ring.corner[size++] = kNone;
  }
  if (size != n + 2 * ends) return;  // a fan and a closed ring
  ring.size = size;
  ring.open = ends == 1;
}

Index StarMesh::split(Index vertex, const VertexRing& ring, unsigned from, unsigned to) {
  const Index added = add_vertex();
  stars_[vertex].first = kNone;
  stars_[vertex].faces = 0;
  for (unsigned i = from; i != to; i = ring.next(i))
    if (ring.corner[i] != kNone) link(ring.corner[i], added);
  for (unsigned i = to; i != from; i = ring.next(i))
    if (ring.corner[i] != kNone) link(ring.corner[i], vertex);
  if (ring.vertex[from] != kNone) add_face(vertex, ring.vertex[from], added);
  if (ring.vertex[to] != kNone) add_face(vertex, added, ring.vertex[to]);
  return added;
}

Index StarMesh::split_any(Index vertex, std::span<const Index> corners,
                          const std::vector<bool>& moves) {
  const Index added = add_vertex();
  stars_[vertex].first = kNone;
  stars_[vertex].faces = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) link(corners[i], moves[i] ? added : vertex);
  return added;
}

}  // namespace pstrips::inline core
