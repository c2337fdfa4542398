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

Triangles triangles_of(const Level& level) {
  Triangles out;
  const ProgressiveMesh& mesh = level.mesh();
  const std::span<const Index> map = level.resolved();
  const auto vertex_of = [&](Index w) { return level.vertex_of(w); };
  const bool grouped = mesh.groups.size() > 1;
  if (level.vertex_count() == mesh.vertices)
    out.corners.reserve(std::min<std::size_t>(mesh.triangles, map.size()) * 3);
  std::size_t first = 0;
  for (std::size_t g = 0; g < mesh.group_entries.size(); ++g) {
    for_each_triangle(map.subspan(first, mesh.group_entries[g]), vertex_of,
                      [&](Index a, Index b, Index c) {
                        out.corners.insert(out.corners.end(), {a, b, c});
                        if (grouped) out.group.push_back(static_cast<Index>(g));
                      });
    first += mesh.group_entries[g];
  }
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

Level::Level(const ProgressiveMesh& mesh)
    : mesh_(&mesh), wedge_count_(mesh.base_wedges), wedge_vertex_(mesh.base_wedge_vertex) {
  auto resolved = resolve(mesh.base_map);
  assert(resolved);
  resolved_ = std::move(resolved).value();
  if (mesh.encoding == MapEncoding::offset) map_ = mesh.base_map;
  if (mesh.placement == Placement::optimal)
    moved_positions_.assign(
        mesh.position.data.begin(),
        mesh.position.data.begin() +
            static_cast<std::ptrdiff_t>(mesh.position.element_bytes() * mesh.base_vertices));
}

Level Level::full(const ProgressiveMesh& mesh, std::vector<Index> resolved,
                  std::vector<Index> wedge_vertex, Bytes positions) {
  assert(wedge_vertex.empty() == mesh.single_wedges || mesh.wedges == 0);
  assert(resolved.size() == mesh.base_map.size());
  Level out;
  out.mesh_ = &mesh;
  out.next_ = static_cast<Index>(mesh.vsplits.size());
  out.wedge_count_ = mesh.wedges;
  out.new_wedge_ = mesh.wedge_offset_counts.size();
  out.map_offset_ = mesh.map_offsets.size();
  out.reassigned_ = mesh.reassigned.size();
  out.resolved_ = std::move(resolved);
  out.wedge_vertex_ = std::move(wedge_vertex);
  out.moved_positions_ = std::move(positions);
  return out;
}

void Level::refine(Index vsplits) {
  const ProgressiveMesh& mesh = *mesh_;
  const Index available = static_cast<Index>(mesh.vsplits.size()) - next_;
  const std::size_t position_bytes = mesh.position.element_bytes();
  for (Index n = std::min(vsplits, available); n > 0; --n, ++next_) {
    const Vsplit& split = mesh.vsplits[next_];
    const Index vertex = vertex_count();
    if (mesh.single_wedges) {
      for (Index i = 0; i < split.map_offsets; ++i) write(mesh.map_offsets[map_offset_++], vertex);
      ++wedge_count_;
    } else {
      for (Index i = 0; i < split.reassigned; ++i)
        wedge_vertex_[mesh.reassigned[reassigned_++]] = vertex;
      for (Index i = 0; i < split.wedges; ++i) {
        wedge_vertex_.push_back(vertex);
        for (Index k = mesh.wedge_offset_counts[new_wedge_++]; k > 0; --k)
          write(mesh.map_offsets[map_offset_++], wedge_count_);
        ++wedge_count_;
      }
    }
    if (mesh.placement != Placement::optimal) continue;
    const auto born =
        mesh.position.data.begin() + static_cast<std::ptrdiff_t>(vertex * position_bytes);
    moved_positions_.insert(moved_positions_.end(), born,
                            born + static_cast<std::ptrdiff_t>(position_bytes));
    if (split.parent != vertex)
      std::copy_n(
          mesh.parent_position.begin() + static_cast<std::ptrdiff_t>(next_ * position_bytes),
          position_bytes,
          moved_positions_.begin() + static_cast<std::ptrdiff_t>(split.parent * position_bytes));
  }
  if (!map_.empty() && !follows_chains()) {
    auto resolved = resolve(map_);  // records write wedges only, so that chains still end
    assert(resolved);
    resolved_ = std::move(resolved).value();
  }
}

void Level::write(Index offset, Index wedge) {
  resolved_[offset] = wedge;
  if (map_.empty()) return;
  map_[offset] = wedge;
  if (follows_chains()) follow_chains(offset, wedge);
}

// An honest file rewrites a few entries a place; one that asks for more than this is resolved as a
// whole after each refine(). [spec/vsplit.md §3]
bool Level::follows_chains() const {
  constexpr std::uint64_t kEntriesAPlace = 64;
  return followed_ <= kEntriesAPlace * (map_.size() + map_offset_);
}

void Level::follow_chains(Index offset, Index wedge) {
  // Entries whose chains end here now stand for the new wedge too. Chains have no cycles, so each
  // is reached once.
  pending_.assign(1, offset);
  while (!pending_.empty()) {
    const Index at = pending_.back();
    pending_.pop_back();
    for (const int d : {-2, -1, 1, 2}) {
      const std::size_t from = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) - d);
      if (from >= map_.size() || map_[from] != symbol_of(d)) continue;
      resolved_[from] = wedge;
      pending_.push_back(static_cast<Index>(from));
      ++followed_;
    }
  }
}

ByteView Level::positions() const {
  const Bytes& all =
      mesh_->placement == Placement::optimal ? moved_positions_ : mesh_->position.data;
  return ByteView(all).first(mesh_->position.element_bytes() * vertex_count());
}

Result<Mesh> mesh_of(const Level& level) {
  const ProgressiveMesh& from = level.mesh();
  Mesh mesh;
  mesh.name = from.name;
  mesh.groups = from.groups;
  mesh.position = prefix_of(from.position, 0);
  const ByteView positions = level.positions();
  mesh.position.data.assign(positions.begin(), positions.end());
  if (!from.single_wedges) {
    const std::span<const Index> vertices = level.wedge_vertices();
    mesh.wedge_vertex.assign(vertices.begin(), vertices.end());
    std::vector<bool> has_wedge(level.vertex_count(), false);
    for (const Index v : vertices) has_wedge[v] = true;
    if (std::ranges::find(has_wedge, false) != has_wedge.end())
      return fail(ErrorCode::corrupt, "a vertex has no wedge");
  }
  for (const Attribute& a : from.wedge_attributes)
    mesh.wedge_attributes.push_back(prefix_of(a, level.wedge_count()));
  Triangles triangles = triangles_of(level);
  mesh.corners = std::move(triangles.corners);
  mesh.face_group = std::move(triangles.group);
  if (level.vertex_count() == from.vertices) {
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
