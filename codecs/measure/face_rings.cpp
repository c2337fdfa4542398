#include "codecs/measure/face_rings.h"

#include <algorithm>
#include <utility>

namespace pstrips::inline codecs {
namespace {

// Up to so many triangles around a vertex looking through them is quicker than a list by vertex.
constexpr Index kSmallRing = 24;

}  // namespace

void FaceRings::add(Index f, std::span<const Index> vertices, bool is_alive) {
  RingFace& face = faces_[f];
  std::ranges::copy(vertices, face.vertex);
  if (!is_alive) {
    face.vertex[0] = kNone;
    return;
  }
  for (Index k = 0; k < 3; ++k) {
    const Index corner = 3 * f + k;
    Index& any = corner_at_[vertices[k]];
    Index& after = any == kNone ? any : faces_[any / 3].next[any % 3];
    face.next[k] = any == kNone ? corner : after;
    after = corner;
  }
}

bool FaceRings::has_vertex(Index f, Index vertex) const {
  return std::ranges::find(faces_[f].vertex, vertex) != std::end(faces_[f].vertex);
}

void FaceRings::gather(Index vertex, Ring& ring) {
  ring.vertex = vertex;
  ring.kind = Ring::Kind::irregular;
  ring.faces.clear();
  ring.neighbours.clear();
  corners_.clear();
  const Index first = corner_at_[vertex];
  if (first == kNone) return;
  Index corner = first;
  do {
    if (!is_dead(corner / 3)) corners_.push_back(corner);
    corner = faces_[corner / 3].next[corner % 3];
  } while (corner != first);
  corner_at_[vertex] = corners_.empty() ? kNone : corners_[0];
  for (std::size_t i = 0; i < corners_.size(); ++i)
    faces_[corners_[i] / 3].next[corners_[i] % 3] = corners_[(i + 1) % corners_.size()];
  for (const Index c : corners_) ring.faces.push_back(c / 3);
  if (!corners_.empty()) order(ring);
}

void FaceRings::order(Ring& ring) {
  const Index n = static_cast<Index>(corners_.size());
  firsts_.clear();
  seconds_.clear();
  for (const Index c : corners_) {
    const RingFace& face = faces_[c / 3];
    firsts_.push_back(face.vertex[(c + 1) % 3]);
    seconds_.push_back(face.vertex[(c + 2) % 3]);
  }
  const bool is_small = n <= kSmallRing;
  for (Index i = 0; i < n && !is_small; ++i) slot_[firsts_[i]] = i;
  const auto starting_with = [&](Index neighbour) -> Index {
    if (!is_small) {
      const Index i = slot_[neighbour];
      return i < n && firsts_[i] == neighbour ? i : kNone;
    }
    for (Index i = 0; i < n; ++i)
      if (firsts_[i] == neighbour) return i;
    return kNone;
  };
  follows_.assign(n, 0);
  for (Index i = 0; i < n; ++i) {
    if (starting_with(firsts_[i]) != i) return;  // two start with it
    const Index next = starting_with(seconds_[i]);
    if (next != kNone) follows_[next] = 1;
  }
  const auto first = std::ranges::find(follows_, 0);
  const Index start = first == follows_.end() ? 0 : static_cast<Index>(first - follows_.begin());
  in_order_.clear();
  Index at = start;
  do {
    in_order_.push_back(corners_[at] / 3);
    ring.neighbours.push_back(firsts_[at]);
    const Index second = seconds_[at];
    at = starting_with(second);
    if (at == kNone) ring.neighbours.push_back(second);
  } while (at != kNone && at != start && in_order_.size() < n);
  if (in_order_.size() < n || (at != kNone && at != start)) return;
  ring.kind = at == start ? Ring::Kind::closed : Ring::Kind::open;
  std::ranges::copy(in_order_, ring.faces.begin());
}

void FaceRings::merge(const Ring& ring, Index kept, std::vector<Lost>& lost) {
  lost.clear();
  for (const Index f : ring.faces) {
    RingFace& face = faces_[f];
    if (!has_vertex(f, kept)) {
      std::ranges::replace(face.vertex, ring.vertex, kept);
      continue;
    }
    for (const Index v : face.vertex)
      if (v != kept && v != ring.vertex) lost.push_back({v, f});
    face.vertex[0] = kNone;
  }
  const Index from = std::exchange(corner_at_[ring.vertex], kNone);
  if (from == kNone) return;
  Index& any = corner_at_[kept];
  if (any == kNone)
    any = from;
  else
    std::swap(faces_[any / 3].next[any % 3], faces_[from / 3].next[from % 3]);
}

}  // namespace pstrips::inline codecs
