#include "codecs/vsplit/level.h"

#include <algorithm>
#include <cassert>

namespace pstrips::inline codecs {
namespace {

Attribute prefix_of(const Attribute& all, Index elements) {
  Attribute out = all.format();
  const std::size_t bytes = out.element_bytes() * elements;
  out.data.assign(all.data.begin(), all.data.begin() + static_cast<std::ptrdiff_t>(bytes));
  return out;
}

struct Triangles {
  std::vector<Index> corners;
  std::vector<Index> group;
};

Triangles triangles_of(const LevelView& level) {
  Triangles out;
  const bool grouped = level.mesh->groups.size() > 1;
  if (level.vertices == level.mesh->vertices)
    out.corners.reserve(std::min<std::size_t>(level.mesh->triangles, level.resolved.size()) * 3);
  for_each_triangle(level, [&](Index a, Index b, Index c, Index group) {
    out.corners.insert(out.corners.end(), {a, b, c});
    if (grouped) out.group.push_back(group);
  });
  return out;
}

// Puts the faces of the table behind the triangles that they do not replace.
void apply_face_table(const FaceTable& table, Mesh& mesh) {
  const std::size_t triangles = mesh.corners.size() / 3;
  std::vector<bool> replaced(triangles);
  for (const Index t : table.replaced) replaced[t] = true;
  std::vector<Index> corners, group, first;
  const auto add = [&](std::span<const Index> face, Index g) {
    first.push_back(static_cast<Index>(corners.size()));
    corners.insert(corners.end(), face.begin(), face.end());
    group.push_back(g);
  };
  for (Index t = 0; t < triangles; ++t)
    if (!replaced[t]) add(mesh.face(t), mesh.group_of(t));
  for (Index f = 0; f < table.count(); ++f)
    add(std::span(table.corners).subspan(table.first[f], table.first[f + 1] - table.first[f]),
        table.group[f]);
  first.push_back(static_cast<Index>(corners.size()));
  mesh.corners = std::move(corners);
  mesh.face_group = std::move(group);
  mesh.face_first = std::move(first);
}

void permute(Attribute& attribute, std::span<const Index> to) {
  const std::size_t size = attribute.element_bytes();
  Bytes out(attribute.data.size());
  for (std::size_t i = 0; i < to.size(); ++i)
    std::copy_n(attribute.data.begin() + static_cast<std::ptrdiff_t>(i * size), size,
                out.begin() + static_cast<std::ptrdiff_t>(to[i] * size));
  attribute.data = std::move(out);
}

}  // namespace

Level::Level(const ProgressiveMesh& mesh) : mesh_(&mesh), state_(mesh) { place_base(); }

void Level::place_base() {
  if (mesh_->placement != Placement::optimal) return;
  const std::size_t bytes = mesh_->position.element_bytes() * mesh_->base_vertices;
  const ByteView base = ByteView(mesh_->position.data).first(bytes);
  moved_positions_.assign(base.begin(), base.end());
}

void Level::reload_positions() {
  place_base();
  if (mesh_->placement != Placement::optimal) return;
  for (std::size_t i = 0; i < vsplits_done(); ++i) place(i);
}

void Level::refine(Index vsplits) {
  const bool moves = mesh_->placement == Placement::optimal;
  const std::size_t available = mesh_->vsplits.size() - next_.vsplit;
  for (std::size_t n = std::min<std::size_t>(vsplits, available); n > 0; --n) {
    const Vsplit& split = mesh_->vsplits[next_.vsplit];
    if (moves) place(next_.vsplit);
    state_.grant_work(std::uint64_t{split.map_offsets} + split.reassigned);
    VsplitRecord record = record_at(*mesh_, next_);
    if (tracks_reassigned_ && !record.reassigned.empty()) reassign(record);
    state_.apply(record, kUnobserved, kUnobserved);
    next_.skip(split);
  }
  if (!state_.is_exhausted()) return;
  state_.resolve_again();
  if (!lists_uses_) return;
  reassigned_entries_.clear();  // not all were reported
  for (Index i = 0; i < resolved().size(); ++i)
    if (resolved()[i] != kRestart) reassigned_entries_.push_back(i);
}

// Takes the first step of the record and notes which entries it changes.
void Level::reassign(VsplitRecord& record) {
  if (!lists_uses_) state_.list_uses();
  lists_uses_ = true;
  for (const Index wedge : std::exchange(record.reassigned, {}))
    state_.reassign(wedge, record.vertex,
                    [this](Index entry) { reassigned_entries_.push_back(entry); });
}

// Where the record's vertices stand after it.
void Level::place(std::size_t vsplit) {
  const Vsplit& split = mesh_->vsplits[vsplit];
  const std::size_t vertex = mesh_->base_vertices + vsplit;
  const std::size_t bytes = mesh_->position.element_bytes();
  const ByteView born = mesh_->position.element(vertex);
  moved_positions_.insert(moved_positions_.end(), born.begin(), born.end());
  if (split.parent == vertex) return;
  const ByteView parent = ByteView(mesh_->parent_position).subspan(vsplit * bytes, bytes);
  std::ranges::copy(parent,
                    moved_positions_.begin() + static_cast<std::ptrdiff_t>(split.parent * bytes));
}

ByteView Level::positions() const {
  const Bytes& all =
      mesh_->placement == Placement::optimal ? moved_positions_ : mesh_->position.data;
  return ByteView(all).first(mesh_->position.element_bytes() * vertex_count());
}

LevelView Level::view() const {
  return {mesh_, vertex_count(), wedge_count(), resolved(), wedge_vertices(), positions()};
}

Result<Mesh> mesh_of(const LevelView& level) {
  const ProgressiveMesh& from = *level.mesh;
  Mesh mesh;
  mesh.name = from.name;
  mesh.groups = from.groups;
  mesh.position = prefix_of(from.position, 0);
  mesh.position.data.assign(level.positions.begin(), level.positions.end());
  if (!from.single_wedges) {
    mesh.wedge_vertex.assign(level.wedge_vertices.begin(), level.wedge_vertices.end());
    std::vector<bool> has_wedge(level.vertices, false);
    for (const Index v : level.wedge_vertices) has_wedge[v] = true;
    if (std::ranges::find(has_wedge, false) != has_wedge.end())
      return fail(ErrorCode::corrupt, "a vertex has no wedge");
  }
  for (const Attribute& a : from.wedge_attributes)
    mesh.wedge_attributes.push_back(prefix_of(a, level.wedges));
  Triangles triangles = triangles_of(level);
  mesh.corners = std::move(triangles.corners);
  mesh.face_group = std::move(triangles.group);
  if (level.vertices == from.vertices) {
    if (mesh.corners.size() / 3 != from.triangles)
      return fail(ErrorCode::corrupt, "shows another number of triangles than it says");
    if (!from.faces.first.empty()) apply_face_table(from.faces, mesh);
    mesh.face_attributes = from.faces.attributes;
  }
  canonicalize(mesh);
  return mesh;
}

Mesh restore_order(const Mesh& decoded, const OriginalOrder& order) {
  Mesh mesh = decoded;
  permute(mesh.position, order.vertex);
  std::vector<Index> wedge_to = order.wedge.empty() ? order.vertex : order.wedge;
  for (Attribute& a : mesh.wedge_attributes) permute(a, wedge_to);
  mesh.wedge_vertex.assign(decoded.wedge_count(), 0);
  for (Index w = 0; w < decoded.wedge_count(); ++w)
    mesh.wedge_vertex[wedge_to[w]] = order.vertex[decoded.vertex_of(w)];

  const Index faces = decoded.face_count();
  mesh.face_group.assign(faces, 0);
  mesh.face_first.assign(std::size_t{faces} + 1, 0);
  for (Index f = 0; f < faces; ++f) {
    mesh.face_group[order.face[f]] = decoded.group_of(f);
    mesh.face_first[order.face[f] + 1] = static_cast<Index>(decoded.face(f).size());
  }
  for (Index f = 0; f < faces; ++f) mesh.face_first[f + 1] += mesh.face_first[f];
  for (Index f = 0; f < faces; ++f) {
    const std::span<const Index> face = decoded.face(f);
    Index* out = mesh.corners.data() + mesh.face_first[order.face[f]];
    for (std::size_t k = 0; k < face.size(); ++k)
      out[k] = wedge_to[face[(k + order.rotation[f]) % face.size()]];
  }
  for (Attribute& a : mesh.face_attributes) permute(a, order.face);
  canonicalize(mesh);
  return mesh;
}

std::vector<StripRange> strip_ranges(std::span<const Index> map) {
  std::vector<StripRange> out;
  for (std::size_t i = 0; i < map.size();) {
    const std::size_t end = static_cast<std::size_t>(
        std::find(map.begin() + static_cast<std::ptrdiff_t>(i), map.end(), kRestart) - map.begin());
    if (end > i) out.push_back({static_cast<Index>(i), static_cast<Index>(end)});
    i = end + 1;
  }
  return out;
}

}  // namespace pstrips::inline codecs
