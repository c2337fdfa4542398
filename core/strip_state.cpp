#include "core/strip_state.h"

#include <algorithm>
#include <cassert>

namespace pstrips::inline core {
namespace {

constexpr std::uint64_t kWorkToStart = 1024;  // small meshes are never a matter of time

}  // namespace

VsplitRecord record_at(const ProgressiveMesh& mesh, const RecordStart& start) {
  const Vsplit& split = mesh.vsplits[start.vsplit];
  return {mesh.base_vertices + static_cast<Index>(start.vsplit),
          split.parent,
          std::span(mesh.reassigned).subspan(start.reassigned, split.reassigned),
          std::span(mesh.wedge_offset_counts).subspan(start.offset_count, split.wedges),
          std::span(mesh.map_offsets).subspan(start.map_offset, split.map_offsets),
          std::span(mesh.new_corners).subspan(start.new_corner, std::size_t{3} * split.triangles)};
}

StripState::StripState(const ProgressiveMesh& mesh)
    : wedge_vertex_(mesh.base_wedge_vertex),
      wedge_count_(mesh.base_wedges),
      single_wedges_(mesh.single_wedges),
      work_left_(kWorkToStart + kMaxWorkPerItem * mesh.base_map.size()) {
  auto resolved = resolve(mesh.base_map);
  assert(resolved);
  resolved_ = std::move(resolved).value();
  resolved_.reserve(mesh.base_map.size() + mesh.new_corners.size());
  if (mesh.encoding != MapEncoding::offset) return;
  stored_.reserve(mesh.base_map.size() + 2 * kMargin);
  stored_.assign(kMargin, kRestart);
  stored_.insert(stored_.end(), mesh.base_map.begin(), mesh.base_map.end());
  stored_.insert(stored_.end(), kMargin, kRestart);
}

void StripState::list_uses() {
  lists_uses_ = true;
  first_use_.assign(wedge_count_, kNone);
  uses_.assign(resolved_.size(), {});
  for (Index at = 0; at < resolved_.size(); ++at)
    if (resolved_[at] != kRestart) link(at);
}

void StripState::resolve_again() {
  exhausted_ = false;
  if (stored_.empty()) return;
  // Steps leave no chain without an end.
  auto resolved = resolve(std::span(stored_).subspan(kMargin, resolved_.size()));
  assert(resolved);
  resolved_ = std::move(resolved).value();
  if (lists_uses_) list_uses();
}

void StripState::release_symbols() {
  lists_uses_ = false;
  stored_ = {};
  first_use_ = {};
  uses_ = {};
  pending_ = {};
}

StripChange StripState::add_wedge(Index vertex) {
  if (!single_wedges_) wedge_vertex_.push_back(vertex);
  if (lists_uses_) first_use_.push_back(kNone);
  return {StripChange::Kind::wedge, wedge_count_++, kNone};
}

void StripState::remove_wedge() {
  --wedge_count_;
  if (!single_wedges_) wedge_vertex_.pop_back();
  if (lists_uses_) first_use_.pop_back();
}

void StripState::remove_triangle() {
  for (unsigned k = 0; k < 3; ++k) {
    if (lists_uses_) {
      unlink(static_cast<Index>(resolved_.size() - 1));
      uses_.pop_back();
    }
    resolved_.pop_back();
  }
}

}  // namespace pstrips::inline core
