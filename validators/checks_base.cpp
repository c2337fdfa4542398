#include <algorithm>

#include "formats/pstrip/payload/predicates.h"
#include "validators/checks.h"

namespace pstrips::inline validators::checks {
namespace {

/// Visits the meshes whose base is there.
template <class Visit>
void for_each_base(const Document& doc, Visit&& visit) {
  for (Index m = 0; m < doc.strips.bases.size(); ++m) visit(m, doc.strips.meshes[m]);
}

Where in_map(Index mesh, std::size_t entry) {
  return {.field = Field::base_map, .mesh = mesh, .element = entry};
}

}  // namespace

void wedge_vertices_exist(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    all_below(mesh.base_wedge_vertex, mesh.base_vertices, [&](std::size_t w) {
      out.add({.field = Field::base_wedge_vertex, .mesh = m, .element = w},
              std::to_string(mesh.base_wedge_vertex[w]));
      return !out.full();
    });
  });
}

void vertices_have_wedges(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.single_wedges) return;
    std::vector<bool> has(mesh.base_vertices);
    for (const Index v : mesh.base_wedge_vertex)
      if (v < has.size()) has[v] = true;
    for (std::size_t v = 0; v < has.size() && !out.full(); ++v)
      if (!has[v]) out.add({.field = Field::base, .mesh = m}, "vertex " + std::to_string(v));
  });
}

void map_wedges_exist(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    for (std::size_t i = 0; i < mesh.base_map.size() && !out.full(); ++i)
      if (is_wedge(mesh.base_map[i]) && mesh.base_map[i] >= mesh.base_wedges)
        out.add(in_map(m, i), std::to_string(mesh.base_map[i]));
  });
}

void symbols_allowed(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.encoding == MapEncoding::offset) return;
    const auto found = std::ranges::find_if(mesh.base_map, is_symbol);
    if (found != mesh.base_map.end())
      out.add(in_map(m, static_cast<std::size_t>(found - mesh.base_map.begin())));
  });
}

void symbols_resolve(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    const auto resolved = resolve(mesh.base_map);
    if (!resolved) out.add(in_map(m, resolved.error().offset), resolved.error().message);
  });
}

void triangles_whole(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.encoding != MapEncoding::triangles) return;
    for (std::size_t i = 0; i < mesh.base_map.size() && !out.full(); ++i)
      if (mesh.base_map[i] == kRestart) out.add(in_map(m, i), "a restart");
    if (mesh.base_map.size() % 3 != 0)
      out.add({.field = Field::base, .mesh = m}, std::to_string(mesh.base_map.size()) + " entries");
  });
}

void groups_end_strips(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.encoding == MapEncoding::triangles) return;
    std::uint64_t end = 0;
    for (const Index entries : mesh.group_entries) {
      end += entries;
      if (entries == 0 || end >= mesh.base_map.size()) continue;
      // The strip that reaches the border must not go on behind it.
      if (mesh.base_map[end - 1] != kRestart) out.add(in_map(m, end - 1));
    }
  });
}

void only_polygons_have_strips(const Document& doc, Findings& out) {
  for_each_base(doc, [&](Index m, const ProgressiveMesh& mesh) {
    for (std::size_t g = 0; g < mesh.group_entries.size() && g < mesh.groups.size(); ++g)
      if (mesh.groups[g].kind != FaceKind::polygons && mesh.group_entries[g] > 0)
        out.add({.field = Field::group, .mesh = m, .element = g});
  });
}

}  // namespace pstrips::inline validators::checks
