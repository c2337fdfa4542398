#include "codecs/compact/record_batches.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "codecs/compact/split_plan.h"
#include "core/gather.h"
#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

// The collapses for which there is a batch, in the order of the sequence.
struct Batched {
  std::vector<Collapse> collapses;
  std::vector<Index> batch;
  std::vector<double> placements;
  Index batches = 0;
};

// Takes the collapses of the coarsest batch out if they are few.
void leave_out_rest(std::vector<Index>& batch, Index vertices, const BatchOptions& options) {
  const auto taken = [](Index number) { return number != kNone; };
  Index last = 0;
  for (const Index number : batch)
    if (taken(number)) last = std::max(last, number);
  const auto size = static_cast<double>(std::ranges::count(batch, last));
  const auto before =
      static_cast<Index>(std::ranges::count_if(batch, [&](Index n) { return n < last; }));
  const Index left = vertices - before;
  if (size < options.least_share * options.schedule.at(left, vertices).most_of(left))
    std::ranges::replace(batch, last, kNone);
}

Batched batch_up(const CollapseSequence& sequence, Index vertices, const BatchOptions& options) {
  Batched out;
  std::vector<Index> batch = batches_of(sequence.collapses, vertices, options, kMostBatches);
  leave_out_rest(batch, vertices, options);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (batch[i] == kNone) continue;
    out.collapses.push_back(sequence.collapses[i]);
    out.batch.push_back(batch[i]);
    out.batches = std::max(out.batches, batch[i] + 1);
    for (std::size_t k = 3 * i; k < 3 * i + 3 && !sequence.placements.empty(); ++k)
      out.placements.push_back(sequence.placements[k]);
  }
  return out;
}

// Undoes the splits of a plan, the last one first, and writes down what undoes that. Lists are
// written fine to coarse, those of a record from its end, and turned round when all is done.
class Recorder {
 public:
  Recorder(const Mesh& mesh, const StripMap& map, const SplitPlan& plan, const Batched& batched,
           std::span<const Index> sequence);
  void add_isolated();
  void undo(std::size_t split);
  Recording finish() &&;

 private:
  bool has_single_wedges() const { return mesh_.wedge_vertex.empty(); }
  bool moves_kept() const { return !placements_.empty(); }
  void list_corners();
  void find_targets(std::size_t first_brought, Index vertex, Index parent);
  void meet(Index wedge, Index vertex);
  void meet_wedges(std::size_t split, std::size_t first_brought, Index vertex);
  void take_corners(Index wedge);
  void append_corner(Index wedge, Index corner);
  void remove_wedge(Index wedge, Index target);
  void reassign(Index wedge, Index parent);
  void place(std::size_t split, Index vertex, Index parent);
  void turn_lists_round();
  void number_wedges();
  void count_triangles();

  const Mesh& mesh_;
  const StripMap& map_;
  const SplitPlan& plan_;
  std::span<const double> placements_;  // by collapse of the sequence
  std::span<const Index> sequence_;     // the collapse of each inner node
  Attribute moved_;         // with optimal placement: where vertices stand, or stood when removed
  std::vector<Index> now_;  // the wedge that each corner shows, of the triangles that are left
  // Corners of each wedge; those of triangles that are gone stay until the wedge is looked at.
  std::vector<Index> first_corner_, next_corner_;
  // Unless wedges are single: the vertex of each wedge, and the wedges of each vertex, by number.
  std::vector<Index> wedge_vertex_, first_wedge_, next_wedge_;
  std::vector<Index> target_;  // of wedges that a triangle ties to one of the parent's
  std::vector<Index> met_;     // by wedge: the vertex with whose record it was met
  std::vector<Index> new_wedges_, corners_;  // scratch, of one record and of one wedge
  std::vector<Index> removed_wedges_;
  Recording out_;
};

Recorder::Recorder(const Mesh& mesh, const StripMap& map, const SplitPlan& plan,
                   const Batched& batched, std::span<const Index> sequence)
    : mesh_(mesh),
      map_(map),
      plan_(plan),
      placements_(batched.placements),
      sequence_(sequence),
      now_(map.entries) {
  out_.vertex_from = plan.vertex_from;
  std::vector<bool> planned(mesh.vertex_count());
  for (const Index v : plan.vertex_from) planned[v] = true;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!planned[v]) out_.vertex_from.push_back(v);
  if (moves_kept()) {
    moved_ = mesh.position;
    const std::size_t records = mesh.vertex_count() - plan.base_vertices;
    out_.mesh.parent_position.resize(records * moved_.element_bytes());
  }
  list_corners();
  if (has_single_wedges()) return;
  const Grouped<Index> wedges =
      group_by(mesh.vertex_count(), mesh.wedge_count(), [&](Index w) { return mesh.vertex_of(w); });
  wedge_vertex_.resize(mesh.wedge_count());
  next_wedge_.resize(mesh.wedge_count());
  target_.assign(mesh.wedge_count(), kNone);
  met_.assign(mesh.wedge_count(), kNone);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    first_wedge_.push_back(kNone);
    const std::span<const Index> own = wedges[out_.vertex_from[v]];
    for (auto w = own.rbegin(); w != own.rend(); ++w) {
      wedge_vertex_[*w] = v;
      next_wedge_[*w] = std::exchange(first_wedge_[v], *w);
    }
  }
}

void Recorder::list_corners() {
  first_corner_.assign(mesh_.wedge_count(), kNone);
  next_corner_.resize(now_.size());
  for (Index c = 0; c < now_.size(); ++c) append_corner(now_[c], c);
}

void Recorder::append_corner(Index wedge, Index corner) {
  now_[corner] = wedge;
  next_corner_[corner] = std::exchange(first_corner_[wedge], corner);
}

// The corners of the wedge that are left, ascending; it has none any more.
void Recorder::take_corners(Index wedge) {
  corners_.clear();
  for (Index c = std::exchange(first_corner_[wedge], kNone); c != kNone; c = next_corner_[c])
    if (c < now_.size()) corners_.push_back(c);
  std::ranges::sort(corners_);
}

void Recorder::add_isolated() {
  for (Index v = mesh_.vertex_count(); v-- > plan_.base_vertices + plan_.splits.size();) {
    out_.mesh.vsplits.push_back({v, 0, 0, 0});
    if (moves_kept()) place(v - plan_.base_vertices, v, v);
    if (has_single_wedges()) {
      remove_wedge(out_.vertex_from[v], kNone);
      continue;
    }
    new_wedges_.clear();
    for (Index w = first_wedge_[v]; w != kNone; w = next_wedge_[w]) new_wedges_.push_back(w);
    for (auto w = new_wedges_.rbegin(); w != new_wedges_.rend(); ++w) remove_wedge(*w, kNone);
  }
}

void Recorder::undo(std::size_t split) {
  const SplitPlan::Split& planned = plan_.splits[split];
  const Index vertex = plan_.base_vertices + static_cast<Index>(split), parent = planned.vertex;
  const std::size_t first_brought = now_.size() - std::size_t{3} * planned.triangles;
  out_.mesh.vsplits.push_back({parent, 0, 0, 0, planned.triangles});
  out_.mesh.new_corners.insert(out_.mesh.new_corners.end(), now_.rbegin(),
                               now_.rend() - static_cast<std::ptrdiff_t>(first_brought));
  if (moves_kept()) place(split, vertex, parent);
  if (has_single_wedges()) {
    now_.resize(first_brought);
    remove_wedge(out_.vertex_from[vertex], out_.vertex_from[parent]);
    return;
  }
  find_targets(first_brought, vertex, parent);
  meet_wedges(split, first_brought, vertex);
  now_.resize(first_brought);
  for (auto w = new_wedges_.rbegin(); w != new_wedges_.rend(); ++w) {
    const Index target = target_[*w];
    take_corners(*w);
    if (target == kNone && !corners_.empty())
      reassign(*w, parent);
    else
      remove_wedge(*w, target);
  }
}

// The first triangle on the edge decides.
void Recorder::find_targets(std::size_t first_brought, Index vertex, Index parent) {
  for (std::size_t t = first_brought; t < now_.size(); t += 3) {
    Index from = kNone, to = kNone;
    for (const Index wedge : std::span(now_).subspan(t, 3)) {
      if (wedge_vertex_[wedge] == vertex) from = wedge;
      if (wedge_vertex_[wedge] == parent) to = wedge;
    }
    if (target_[from] == kNone) target_[from] = to;
  }
}

void Recorder::meet(Index wedge, Index vertex) {
  if (wedge_vertex_[wedge] != vertex || met_[wedge] == vertex) return;
  met_[wedge] = vertex;
  new_wedges_.push_back(wedge);
}

void Recorder::meet_wedges(std::size_t split, std::size_t first_brought, Index vertex) {
  new_wedges_.clear();
  const std::size_t end =
      split + 1 < plan_.splits.size() ? plan_.splits[split + 1].first_moved : plan_.moved.size();
  for (std::size_t i = plan_.splits[split].first_moved; i < end; ++i)
    meet(now_[plan_.moved[i]], vertex);
  for (std::size_t c = first_brought; c < now_.size(); ++c) meet(now_[c], vertex);
  for (Index w = first_wedge_[vertex]; w != kNone; w = next_wedge_[w]) meet(w, vertex);
}

// Its corners, which have been taken, go over to the target; kNone for one that has none.
void Recorder::remove_wedge(Index wedge, Index target) {
  if (has_single_wedges()) take_corners(wedge);
  for (auto c = corners_.rbegin(); c != corners_.rend(); ++c) {
    out_.mesh.map_offsets.push_back(*c);
    append_corner(target, *c);
  }
  const auto count = static_cast<Index>(corners_.size());
  removed_wedges_.push_back(wedge);
  out_.mesh.wedge_offset_counts.push_back(count);
  Vsplit& vsplit = out_.mesh.vsplits.back();
  ++vsplit.wedges;
  vsplit.map_offsets += count;
}

// The wedge keeps its corners, which have been taken, and stands at another vertex.
void Recorder::reassign(Index wedge, Index parent) {
  for (auto c = corners_.rbegin(); c != corners_.rend(); ++c) append_corner(wedge, *c);
  wedge_vertex_[wedge] = parent;
  next_wedge_[wedge] = std::exchange(first_wedge_[parent], wedge);
  out_.mesh.reassigned.push_back(wedge);
  ++out_.mesh.vsplits.back().reassigned;
}

// Notes where the parent stands after the record and moves it to where it stood before.
void Recorder::place(std::size_t split, Index vertex, Index parent) {
  const Index from = out_.vertex_from[parent];
  const ByteView stands = moved_.element(from);
  std::ranges::copy(stands, out_.mesh.parent_position.begin() +
                                static_cast<std::ptrdiff_t>(split * stands.size()));
  if (parent == vertex) return;
  const std::size_t collapse = sequence_[plan_.splits[split].inner];
  for (std::size_t c = 0; c < std::min<std::size_t>(3, moved_.count); ++c)
    set_component(moved_, from, c, placements_[3 * collapse + c]);
}

void Recorder::turn_lists_round() {
  ProgressiveMesh& mesh = out_.mesh;
  std::ranges::reverse(mesh.vsplits);
  for (auto* list : {&removed_wedges_, &mesh.wedge_offset_counts, &mesh.map_offsets,
                     &mesh.reassigned, &mesh.new_corners})
    std::ranges::reverse(*list);
}

void Recorder::number_wedges() {
  ProgressiveMesh& mesh = out_.mesh;
  std::vector<Index> number(mesh.wedges, kNone);
  const auto add = [&](Index wedge) {
    if (number[wedge] != kNone) return;
    number[wedge] = static_cast<Index>(out_.wedge_from.size());
    out_.wedge_from.push_back(wedge);
  };
  if (has_single_wedges()) {
    for (const Index v : out_.vertex_from) add(v);
    mesh.base_wedges = mesh.base_vertices;
  } else {
    for (const Index wedge : now_) add(wedge);
    for (Index v = 0; v < mesh.base_vertices; ++v)
      for (Index w = first_wedge_[v]; w != kNone; w = next_wedge_[w]) add(w);
    mesh.base_wedges = static_cast<Index>(out_.wedge_from.size());
    for (const Index wedge : out_.wedge_from)
      mesh.base_wedge_vertex.push_back(wedge_vertex_[wedge]);
    for (const Index wedge : removed_wedges_) add(wedge);
  }
  for (auto* list : {&now_, &mesh.reassigned, &mesh.new_corners})
    for (Index& wedge : *list) wedge = number[wedge];
  mesh.base_map = std::move(now_);
}

void Recorder::count_triangles() {
  Index triangles = plan_.base_triangles;
  out_.levels.push_back({triangles, triangles});
  for (const Vsplit& split : out_.mesh.vsplits) {
    triangles += split.triangles;
    out_.levels.push_back({triangles, triangles});
  }
}

Recording Recorder::finish() && {
  ProgressiveMesh& mesh = out_.mesh;
  mesh.name = mesh_.name;
  mesh.encoding = MapEncoding::triangles;
  mesh.placement = moves_kept() ? Placement::optimal : Placement::subset;
  mesh.single_wedges = has_single_wedges();
  mesh.groups = mesh_.groups;
  mesh.group_entries = map_.group_entries;
  for (const Attribute& a : mesh_.face_attributes)
    mesh.face_attribute_formats.push_back(a.format());
  mesh.base_vertices = plan_.base_vertices;
  mesh.vertices = mesh_.vertex_count();
  mesh.wedges = mesh_.wedge_count();
  mesh.triangles = mesh.strips = static_cast<Index>(plan_.triangles.size());
  turn_lists_round();
  count_triangles();
  number_wedges();
  mesh.position = gather(moves_kept() ? moved_ : mesh_.position, out_.vertex_from);
  for (const Attribute& a : mesh_.wedge_attributes)
    mesh.wedge_attributes.push_back(gather(a, out_.wedge_from));
  return std::move(out_);
}

std::vector<Index> corner_vertices(const Mesh& mesh, const Triangulation& triangles) {
  std::vector<Index> out;
  out.reserve(triangles.corners.size());
  for (const Index wedge : triangles.corners) out.push_back(mesh.vertex_of(wedge));
  return out;
}

// Wedges of the plan's triangles, and the group of each if there are several.
StripMap full_map(const Mesh& mesh, const Triangulation& triangles, const SplitPlan& plan,
                  std::vector<Index>& group) {
  StripMap out;
  out.entries.reserve(3 * plan.triangles.size());
  out.group_entries.assign(mesh.groups.size(), 0);
  for (const SplitPlan::Triangle& t : plan.triangles) {
    for (unsigned k = 0; k < 3; ++k)
      out.entries.push_back(triangles.corners[std::size_t{3} * t.from + (t.turn + k) % 3]);
    const Index g = mesh.group_of(triangles.face[t.from]);
    out.group_entries[g] += 3;
    if (mesh.groups.size() > 1) group.push_back(g);
  }
  return out;
}

// As bounds of levels want it; errors do not fall.
CollapseSequence in_order_of(const SplitPlan& plan, const CollapseForest& forest,
                             const Batched& batched) {
  CollapseSequence out;
  out.triangles_left = plan.base_triangles;
  float error = 0;
  for (auto split = plan.splits.rbegin(); split != plan.splits.rend(); ++split) {
    const Index i = forest.sequence()[split->inner];
    const Collapse& c = batched.collapses[i];
    error = std::max(error, c.error);
    out.collapses.push_back({.removed = c.removed, .kept = c.kept, .error = error, .moves = 0});
    for (std::size_t k = 3 * std::size_t{i}; k < 3 * std::size_t{i} + 3; ++k)
      if (!batched.placements.empty()) out.placements.push_back(batched.placements[k]);
  }
  return out;
}

}  // namespace

BatchRecording record_batches(const Mesh& mesh, const Triangulation& triangles,
                              const CollapseSequence& sequence, const BatchOptions& options) {
  assert(sequence.placements.empty() ||
         sequence.placements.size() == 3 * sequence.collapses.size());
  const Batched batched = batch_up(sequence, mesh.vertex_count(), options);
  const CollapseForest forest(batched.collapses, batched.batch, mesh.vertex_count());
  const std::vector<Index> corners = corner_vertices(mesh, triangles);
  const SplitPlan plan =
      plan_splits(corners, batched.collapses, forest, batched.batches,
                  batched.placements.empty() ? Placement::subset : Placement::optimal);
  BatchRecording out;
  std::vector<Index> group;
  out.map = full_map(mesh, triangles, plan, group);
  Recorder recorder(mesh, out.map, plan, batched, forest.sequence());
  recorder.add_isolated();
  for (std::size_t split = plan.splits.size(); split-- > 0;) recorder.undo(split);
  out.recording = std::move(recorder).finish();
  out.recording.mesh.triangle_group = std::move(group);
  out.batches = plan.batches;
  out.collapses = in_order_of(plan, forest, batched);
  return out;
}

}  // namespace pstrips::inline codecs
