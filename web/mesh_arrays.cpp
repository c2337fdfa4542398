#include "web/mesh_arrays.h"

#include <algorithm>
#include <cstring>

#include "core/mesh.h"

namespace pstrips::inline web {
namespace {

/// Equal elements between changed ones that cost less to send again than a range of their own.
constexpr std::size_t kGap = 64;

/// Appends the ranges of elements, three entries each, in which `now` differs from `before`.
template <class T>
void append_changes(std::span<const T> before, std::span<const T> now, std::vector<Index>& out) {
  const std::size_t common = std::min(before.size(), now.size()) / 3, end = now.size() / 3;
  const std::size_t ranges = out.size();
  const auto add = [&](std::size_t first, std::size_t last) {
    if (out.size() > ranges && first < out.back() + kGap)
      out.back() = static_cast<Index>(last);
    else
      out.insert(out.end(), {static_cast<Index>(first), static_cast<Index>(last)});
  };
  for (std::size_t i = 0; i < common; ++i)
    if (std::memcmp(&before[3 * i], &now[3 * i], 3 * sizeof(T)) != 0) add(i, i + 1);
  if (end > common) add(common, end);
}

}  // namespace

void MeshArrays::update(const DisplayLevel& shown, bool keeps_strips) {
  const Level& level = shown.level();
  std::swap(positions_, old_positions_);
  std::swap(triangles_, old_triangles_);
  take_positions(level);
  take_triangles(level);
  if (keeps_strips) take_strips(shown);

  changed_.clear();
  append_changes<float>(old_positions_, positions_, changed_);
  const std::size_t of_wedges = changed_.size();
  append_changes<Index>(old_triangles_, triangles_, changed_);
  mesh_ = {.vertices = level.vertex_count(),
           .wedges = level.wedge_count(),
           .triangles = static_cast<Index>(triangles_.size() / 3),
           .groups = static_cast<Index>(level.mesh().groups.size()),
           .strip_entries = static_cast<Index>(strips_.size()),
           .positions = positions_.data(),
           .triangle_list = triangles_.data(),
           .group_first = group_first_.data(),
           .strips = strips_.data(),
           .changed = changed_.data(),
           .changed_wedges = static_cast<Index>(of_wedges / 2),
           .changed_triangles = static_cast<Index>((changed_.size() - of_wedges) / 2)};
}

void MeshArrays::take_positions(const Level& level) {
  const ByteView bytes = level.positions();
  const Attribute& format = level.mesh().position;
  const std::size_t components = std::min<std::size_t>(format.count, 3);
  std::vector<float> of_vertices(std::size_t{3} * level.vertex_count());
  if (format.type == ComponentType::f32 && format.count == 3) {
    std::memcpy(of_vertices.data(), bytes.data(), of_vertices.size() * sizeof(float));
  } else {
    Attribute all = format.format();
    all.data.assign(bytes.begin(), bytes.end());
    for (std::size_t i = 0; i < level.vertex_count(); ++i)
      for (std::size_t c = 0; c < components; ++c)
        of_vertices[3 * i + c] = static_cast<float>(component(all, i, c));
  }
  if (level.wedge_vertices().empty()) {
    positions_ = std::move(of_vertices);
    return;
  }
  positions_.resize(std::size_t{3} * level.wedge_count());
  for (std::size_t i = 0; i < level.wedge_count(); ++i)
    std::copy_n(&of_vertices[std::size_t{3} * level.vertex_of(static_cast<Index>(i))], 3,
                &positions_[3 * i]);
}

void MeshArrays::take_triangles(const Level& level) {
  const std::size_t groups = level.mesh().groups.size();
  group_first_.assign(groups + 1, 0);
  for_each_triangle(level.view(),
                    [&](Index, Index, Index, Index group) { ++group_first_[group + 1]; });
  for (std::size_t i = 0; i < groups; ++i) group_first_[i + 1] += group_first_[i];
  triangles_.resize(std::size_t{3} * group_first_.back());
  std::vector<Index> next(group_first_.begin(), group_first_.end() - 1);
  for_each_triangle(level.view(), [&](Index a, Index b, Index c, Index group) {
    const std::size_t at = std::size_t{3} * next[group]++;
    triangles_[at] = a;
    triangles_[at + 1] = b;
    triangles_[at + 2] = c;
  });
}

void MeshArrays::take_strips(const DisplayLevel& shown) {
  strips_.clear();
  shown.append_display(strips_);
}

}  // namespace pstrips::inline web
