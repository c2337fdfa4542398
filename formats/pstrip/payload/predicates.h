#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progressive_strips.h"

namespace pstrips::inline formats {

// What lists of a model must satisfy, one place a demand: a reader stops at the first element that
// breaks it, a validator visits them all. `visit(i)` gets the number of such an element and returns
// whether to go on; the functions return whether no element was visited.

/// Keeps every sum of array sizes within 64 bits. [spec/model.md M-006]
inline constexpr std::size_t kMaxAttributes = 1024;

/// Whether a file needs a sCNE chunk, or a scene element.
inline bool has_scene_fields(const ProgressiveStrips& strips) {
  return !strips.generator.empty() || !strips.scene.nodes.empty() ||
         strips.scene.texture_origin != TextureOrigin::upper_left;
}
/// Whether it needs a mTRL chunk, or a materials element.
inline bool has_materials(const Scene& scene) {
  return !scene.materials.empty() || !scene.images.empty();
}

/// Elements that are `end` or more.
template <class Visit>
bool all_below(std::span<const Index> list, std::uint64_t end, Visit&& visit) {
  bool holds = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] < end) continue;
    holds = false;
    if (!visit(i)) break;
  }
  return holds;
}

/// How much a welding says that there is of it.
struct WeldingSizes {
  std::uint64_t vertices, wedges, welded, corners, numbered, moved;
};

/// Whether a mesh can have so much welded; each decoded wedge stands for itself or has a corner.
inline bool is_possible(const WeldingSizes& sizes, Index wedges, Index triangles,
                        const FaceTable& faces) {
  const std::uint64_t corners = std::uint64_t{3} * triangles + faces.corners.size();
  return sizes.wedges > 0 && sizes.wedges <= std::min<std::uint64_t>(wedges + corners, kMaxCount) &&
         sizes.vertices <= sizes.wedges && sizes.welded <= wedges && sizes.corners <= corners &&
         sizes.numbered <= sizes.wedges && sizes.moved <= sizes.vertices;
}

/// The same of a welding in memory; also when there is none.
inline bool has_possible_welding(const ProgressiveMesh& mesh) {
  const Welding& w = mesh.welding;
  const WeldingSizes sizes{w.vertices,      w.wedges,        w.skip.size(),
                           w.corner.size(), w.vertex.size(), w.moved.size()};
  return w.empty() || is_possible(sizes, mesh.wedges, mesh.triangles, mesh.faces);
}

/// Elements that are out of place in bounds of runs over `size` items: from 0, never falling, to
/// `size`. No bounds at all are the bounds of no items.
template <class Visit>
bool are_bounds(std::span<const Index> first, std::size_t size, Visit&& visit) {
  if (first.empty() && size != 0) {
    visit(std::size_t{0});
    return false;
  }
  bool holds = true;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool starts = i > 0 || first[0] == 0;
    const bool ends = i + 1 < first.size() || first[i] == size;
    if (starts && ends && (i == 0 || first[i] >= first[i - 1])) continue;
    holds = false;
    if (!visit(i)) break;
  }
  return holds;
}

/// Elements that are past the end or stand a second time. Precondition: list.size() == size.
template <class Visit>
bool is_permutation(std::span<const Index> list, std::size_t size, Visit&& visit) {
  std::vector<bool> named(size);
  bool holds = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] < size && !named[list[i]]) {
      named[list[i]] = true;
      continue;
    }
    holds = false;
    if (!visit(i)) break;
  }
  return holds;
}

/// Elements below `end` that stand a second time.
template <class Visit>
bool all_differ(std::span<const Index> list, std::size_t end, Visit&& visit) {
  std::vector<bool> named(list.empty() ? 0 : end);
  bool holds = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] >= end) continue;
    if (!named[list[i]]) {
      named[list[i]] = true;
      continue;
    }
    holds = false;
    if (!visit(i)) break;
  }
  return holds;
}

/// Corners of a face of the decoded mesh: triangles of the map first, then explicit faces.
/// Precondition: the bounds of the table hold.
inline Index corners_of_face(const FaceTable& faces, std::size_t triangles, std::size_t face) {
  if (face < triangles || face - triangles >= faces.count()) return 3;
  return faces.first[face - triangles + 1] - faces.first[face - triangles];
}

/// Whether a rotation names a corner; a face without corners has rotation 0.
constexpr bool is_rotation(std::uint8_t rotation, Index corners) {
  return rotation < std::max<Index>(corners, 1);
}

/// Length of the index map at full resolution.
inline std::uint64_t full_map_entries(const ProgressiveMesh& mesh) {
  return mesh.encoding == MapEncoding::triangles ? std::uint64_t{3} * mesh.triangles
                                                 : mesh.base_map.size();
}

/// Whether a list says which group each triangle of the map is in.
inline bool has_triangle_groups(const ProgressiveMesh& mesh) {
  return mesh.encoding == MapEncoding::triangles && mesh.groups.size() > 1;
}

/// Length of the index map as the groups have it.
inline std::uint64_t sum_of_group_entries(const ProgressiveMesh& mesh) {
  std::uint64_t sum = 0;
  for (const Index n : mesh.group_entries) sum += n;
  return sum;
}

}  // namespace pstrips::inline formats
