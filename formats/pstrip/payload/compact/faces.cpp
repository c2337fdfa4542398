#include "formats/pstrip/payload/compact/faces.h"

#include <vector>

#include "core/edge_pairs.h"
#include "formats/pstrip/payload/compact/face_code.h"

namespace pstrips::inline formats {
namespace {

/// The map of triangles at full resolution.
std::vector<Index> full_map(const ProgressiveMesh& mesh) {
  std::vector<Index> map = mesh.base_map;
  map.insert(map.end(), mesh.new_corners.begin(), mesh.new_corners.end());
  auto offset = mesh.map_offsets.begin();
  Index wedge = mesh.base_wedges;
  for (const Index count : mesh.wedge_offset_counts) {
    for (Index i = 0; i < count; ++i) map[*offset++] = wedge;
    ++wedge;
  }
  return map;
}

std::span<const Index> part_of(const std::vector<Index>& list, const std::vector<Index>& first,
                               Index f) {
  return std::span(list).subspan(first[f], first[f + 1] - first[f]);
}

/// Joins the polygons at the front of the table that come back as they are, in this order.
Index join_front(const FaceTable& table, std::span<const Index> map, std::span<const Index> group,
                 JoinedFaces& joined) {
  Index f = 0;
  Index least = 0;  // that the first triangle of the next one may be
  for (; f < table.count(); ++f) {
    const auto triangles = part_of(table.replaced, table.replaced_first, f);
    const bool is_in_order = triangles.size() > 1 && triangles.front() >= least &&
                             std::ranges::is_sorted(triangles) &&
                             3 * std::size_t{triangles.back()} < map.size() &&
                             table.group[f] == (group.empty() ? 0 : group[triangles.front()]);
    if (!is_in_order ||
        !joined.join_polygon(triangles, part_of(table.corners, table.first, f), map))
      break;
    least = triangles.front() + 1;
  }
  return f;
}

}  // namespace

CodedFaces code_faces(const ProgressiveMesh& mesh) {
  const std::vector<Index> map = full_map(mesh);
  const std::vector<Index> opposite = pair_half_edges(map, mesh.triangle_group, mesh.wedges);
  JoinedFaces joined(opposite);
  FaceTable table = mesh.faces;
  const Index front = join_front(table, map, mesh.triangle_group, joined);
  CodedFaces out;
  out.listed = table.count() - front;
  RansWriter coder;
  JoinCode<RansWriter>(coder, opposite, joined).run();
  FaceListCode<RansWriter> list(coder, static_cast<Index>(mesh.groups.size()));
  static_cast<void>(list.run(table, front, out.listed));  // only a reader refuses
  out.run = coder.finish();
  return out;
}

Result<void> read_faces(ByteView run, Index listed, ProgressiveMesh& mesh) {
  const std::vector<Index> map = full_map(mesh);
  const std::vector<Index> opposite = pair_half_edges(map, mesh.triangle_group, mesh.wedges);
  JoinedFaces joined(opposite);
  RansReader coder(run);
  JoinCode<RansReader>(coder, opposite, joined).run();
  FaceTable table = joined.faces(map, mesh.triangle_group);
  const Index front = table.count();
  if (table.first.empty() && listed > 0) table.first = table.replaced_first = {0};
  FaceListCode<RansReader> list(coder, static_cast<Index>(mesh.groups.size()));
  if (auto ok = list.run(table, front, listed); !ok) return ok;
  if (!coder.complete()) return broken(Fault::compact_run);
  table.attributes = std::move(mesh.faces.attributes);
  mesh.faces = std::move(table);
  return {};
}

}  // namespace pstrips::inline formats
