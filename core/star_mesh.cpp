#include "core/star_mesh.h"

#include <cassert>

namespace pstrips::inline core {

void StarMesh::reserve(std::size_t vertices, std::size_t faces) {
  vertex_.reserve(3 * faces);
  next_.reserve(3 * faces);
  first_.reserve(vertices);
  faces_.reserve(vertices);
  slot_.reserve(vertices);
}

Index StarMesh::add_vertex() {
  first_.push_back(kNone);
  faces_.push_back(0);
  slot_.push_back(0);
  return static_cast<Index>(first_.size() - 1);
}

Index StarMesh::add_face(Index a, Index b, Index c) {
  const auto corner = static_cast<Index>(vertex_.size());
  vertex_.resize(vertex_.size() + 3);
  next_.resize(next_.size() + 3);
  link(corner, a);
  link(corner + 1, b);
  link(corner + 2, c);
  return corner / 3;
}

void StarMesh::link(Index corner, Index vertex) {
  assert(vertex < first_.size());
  vertex_[corner] = vertex;
  next_[corner] = first_[vertex];
  first_[vertex] = corner;
  ++faces_[vertex];
}

void StarMesh::corners_of(Index vertex, std::vector<Index>& out) const {
  out.clear();
  for (Index corner = first_[vertex]; corner != kNone; corner = next_[corner])
    out.push_back(corner);
}

void StarMesh::ring_of(Index vertex, VertexRing& ring) const {
  ring.size = 0;
  ring.open = false;
  const Index n = faces_[vertex];
  if (n == 0 || n > VertexRing::kMaxSize - 2) return;
  // Each face as an arrow from one neighbour to the next.
  std::array<Index, VertexRing::kMaxSize> from, to, corner;
  Index count = 0;
  for (Index c = first_[vertex]; c != kNone; c = next_[c], ++count) {
    corner[count] = c;
    from[count] = vertex_[next_in_face(c)];
    to[count] = vertex_[previous_in_face(c)];
    const Index seen = slot_[from[count]];
    if (seen < count && from[seen] == from[count]) return;  // two faces leave one neighbour
    slot_[from[count]] = count;
  }
  const auto leaving = [&](Index neighbour) {
    const Index i = slot_[neighbour];
    return i < n && from[i] == neighbour ? i : kNone;
  };
  std::uint64_t entered = 0;
  unsigned ends = 0;
  for (Index i = 0; i < n; ++i) {
    const Index after = leaving(to[i]);
    if (after == kNone) {
      if (++ends > 1) return;  // several fans
    } else {
      if (entered >> after & 1) return;  // two faces reach one neighbour
      entered |= std::uint64_t{1} << after;
    }
  }
  Index at = 0;
  if (ends == 1)
    while (entered >> at & 1) ++at;
  unsigned size = 0;
  for (const Index start = at; at != kNone && (size == 0 || at != start); at = leaving(to[at])) {
    ring.vertex[size] = from[at];
    ring.corner[size++] = corner[at];
    if (leaving(to[at]) != kNone) continue;
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
  first_[vertex] = kNone;
  faces_[vertex] = 0;
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
  first_[vertex] = kNone;
  faces_[vertex] = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) link(corners[i], moves[i] ? added : vertex);
  return added;
}

}  // namespace pstrips::inline core
