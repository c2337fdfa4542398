#include "core/joined_faces.h"

#include <algorithm>

#include "core/edge_pairs.h"

namespace pstrips::inline core {

// Joins all pairs between the triangles; false if there are not as many as a tree has.
bool JoinedFaces::join(std::span<const Index> triangles) {
  std::size_t joins = 0;
  for (const Index t : triangles)
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Index g = opposite_[h];
      if (g == kNone || g < h || !std::ranges::binary_search(triangles, g / 3)) continue;
      set_joined(h, true);
      ++joins;
    }
  return joins + 1 == triangles.size();
}

void JoinedFaces::part(std::span<const Index> triangles) {
  for (const Index t : triangles)
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (joined_[h]) set_joined(h, false);
}

// Around a polygon. From one half-edge to the next is a permutation, so the walk comes back.
void JoinedFaces::walk(std::span<const Index> triangles, std::span<const Index> of,
                       std::vector<Index>& corners) const {
  std::size_t i = 0;
  while (joined_[3 * triangles[i / 3] + i % 3]) ++i;
  const Index start = 3 * triangles[i / 3] + static_cast<Index>(i % 3);
  Index h = start;
  do {
    corners.push_back(of[h]);
    h = next_half_edge(h);
    while (joined_[h]) h = next_half_edge(opposite_[h]);
  } while (h != start);
}

Index JoinedFaces::join_turned(std::span<const Index> triangles, std::span<const Index> corners,
                               std::span<const Index> of) {
  const std::size_t n = corners.size();
  if (triangles.size() < 2 || n != triangles.size() + 2) return kNone;
  boundary_.clear();
  if (join(triangles)) walk(triangles, of, boundary_);
  // As many half-edges are not joined. With a cycle of joins they are not all in one walk.
  for (Index turn = 0; boundary_.size() == n && turn < std::min<std::size_t>(n, kMostTurns); ++turn)
    if (std::ranges::equal(corners.first(n - turn), std::span(boundary_).subspan(turn)) &&
        std::ranges::equal(corners.last(turn), std::span(boundary_).first(turn)))
      return turn;
  part(triangles);
  return kNone;
}

bool JoinedFaces::join_polygon(std::span<const Index> triangles, std::span<const Index> corners,
                               std::span<const Index> of) {
  const Index turn = join_turned(triangles, corners, of);
  if (turn == kNone || turn == 0) return turn == 0;
  part(triangles);
  return false;
}

FaceTable JoinedFaces::faces(std::span<const Index> of, std::span<const Index> group) const {
  FaceTable out;
  std::vector<bool> taken(opposite_.size() / 3);
  for (Index t = 0; t < taken.size(); ++t) {
    if (taken[t] || (!joined_[3 * t] && !joined_[3 * t + 1] && !joined_[3 * t + 2])) continue;
    out.first.push_back(static_cast<Index>(out.corners.size()));
    out.replaced_first.push_back(static_cast<Index>(out.replaced.size()));
    out.group.push_back(group.empty() ? 0 : group[t]);
    const std::size_t first = out.replaced.size();
    out.replaced.push_back(t);
    taken[t] = true;
    for (std::size_t i = first; i < out.replaced.size(); ++i)
      for (Index h = 3 * out.replaced[i]; h < 3 * out.replaced[i] + 3; ++h) {
        if (!joined_[h] || taken[opposite_[h] / 3]) continue;
        taken[opposite_[h] / 3] = true;
        out.replaced.push_back(opposite_[h] / 3);
      }
    const std::span<Index> triangles = std::span(out.replaced).subspan(first);
    std::ranges::sort(triangles);
    walk(triangles, of, out.corners);
  }
  if (out.first.empty()) return out;
  out.first.push_back(static_cast<Index>(out.corners.size()));
  out.replaced_first.push_back(static_cast<Index>(out.replaced.size()));
  return out;
}

}  // namespace pstrips::inline core
