#include <algorithm>
#include <optional>

#include "codecs/vsplit/level.h"
#include "codecs/weld/unweld.h"
#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/digest.h"
#include "formats/pstrip/payload/predicates.h"
#include "validators/checks.h"

namespace pstrips::inline validators::checks {
namespace {

template <class Visit>
void for_each_mesh(const Document& doc, Visit&& visit) {
  if (doc.ended_early) return;
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) visit(m, doc.strips.meshes[m]);
}

template <class Visit>
void for_each_table(const Document& doc, Visit&& visit) {
  for (Index m = 0; m < doc.strips.meshes.size(); ++m)
    if (!doc.strips.meshes[m].faces.empty()) visit(m, doc.strips.meshes[m]);
}

void below(std::span<const Index> list, std::uint64_t end, Where where, Findings& out) {
  all_below(list, end, [&](std::size_t i) {
    where.element = i;
    out.add(where, std::to_string(list[i]));
    return !out.full();
  });
}

/// first partitions `size` items into runs.
void partition(std::span<const Index> first, std::size_t size, Where where, Findings& out) {
  are_bounds(first, size, [&](std::size_t i) {
    where.element = i;
    out.add(where, first.empty() ? "has no runs" : std::to_string(first[i]));
    return !out.full();
  });
}

void permutation(std::span<const Index> list, std::size_t size, Where where, Findings& out) {
  if (list.size() != size) {
    out.add(where, std::to_string(list.size()) + " entries for " + std::to_string(size));
    return;
  }
  is_permutation(list, size, [&](std::size_t i) {
    where.element = i;
    out.add(where, std::to_string(list[i]) + (list[i] < size ? " again" : ""));
    return !out.full();
  });
}

bool has_order(const ProgressiveMesh& mesh) { return mesh.order != OriginalOrder{}; }

/// The group in which each triangle stands.
std::vector<Index> groups_of_triangles(const ProgressiveMesh& mesh, const Replay& replay) {
  std::vector<Index> out;
  if (has_triangle_groups(mesh)) return mesh.triangle_group;
  std::size_t first = 0;
  for (std::size_t g = 0; g < mesh.group_entries.size(); ++g) {
    for_each_triangle(
        std::span(replay.map).subspan(first, mesh.group_entries[g]),
        [&](Index w) { return mesh.single_wedges ? w : replay.wedge_vertex[w]; },
        [&](Index, Index, Index) { out.push_back(static_cast<Index>(g)); });
    first += mesh.group_entries[g];
  }
  return out;
}

/// The table can be followed: what decoding the mesh stands on.
bool is_sound(const ProgressiveStrips& strips, Index mesh) {
  FirstFault ignored;
  return strips.meshes[mesh].faces.empty() || check_faces(strips, mesh, ignored);
}

/// The last level with the face table; nothing where that is another rule's.
std::optional<Mesh> full_level(const Document& doc, Index m) {
  const ProgressiveMesh& mesh = doc.strips.meshes[m];
  if (!doc.replays[m].finished || !is_sound(doc.strips, m)) return std::nullopt;
  if (mesh.triangles != doc.replays[m].levels.back().triangles) return std::nullopt;
  Level level(mesh);
  level.refine_fully();
  Result<Mesh> shown = mesh_of(level);
  if (!shown || !find_inconsistency(*shown).empty()) return std::nullopt;
  return std::move(shown).value();
}

}  // namespace

void full_counts_reached(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    // Records that are not there could still change what is shown.
    if (!doc.replays[m].finished || mesh.vsplits.size() != doc.declared[m].vsplits) return;
    const Shown& is = doc.replays[m].levels.back();
    const auto compare = [&](const char* name, Index declared, Index reached, std::uint64_t count) {
      if (declared != reached)
        out.add({.field = Field::counts, .mesh = m, .element = count},
                name + (" says " + std::to_string(declared)) + ", is " + std::to_string(reached));
    };
    compare("triangles", mesh.triangles, is.triangles, 2);
    compare("strips", mesh.strips, is.strips, 3);
  });
}

void triangle_groups_exist(const Document& doc, Findings& out) {
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = doc.strips.meshes[m];
    below(mesh.triangle_group, mesh.groups.size(), {.field = Field::triangle_group, .mesh = m},
          out);
  }
}

void triangles_of_groups_counted(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    // The other cases are those of M-016, M-018 and M-019.
    if (!has_triangle_groups(mesh) || mesh.triangle_group.size() != mesh.triangles ||
        sum_of_group_entries(mesh) != full_map_entries(mesh))
      return;
    std::vector<std::uint64_t> entries(mesh.groups.size());
    for (const Index group : mesh.triangle_group) {
      if (group >= entries.size()) return;
      entries[group] += 3;
    }
    for (std::size_t g = 0; g < entries.size(); ++g)
      if (mesh.group_entries[g] != entries[g])
        out.add(
            {.field = Field::group, .mesh = m, .element = g},
            "says " + std::to_string(mesh.group_entries[g]) + ", is " + std::to_string(entries[g]));
  });
}

// ---- Faces ----

void face_bounds(const Document& doc, Findings& out) {
  for_each_table(doc, [&](Index m, const ProgressiveMesh& mesh) {
    partition(mesh.faces.first, mesh.faces.corners.size(), {.field = Field::face_first, .mesh = m},
              out);
  });
}

void face_corners_exist(const Document& doc, Findings& out) {
  for_each_table(doc, [&](Index m, const ProgressiveMesh& mesh) {
    below(mesh.faces.corners, mesh.wedges, {.field = Field::face_corner, .mesh = m}, out);
  });
}

void face_groups_exist(const Document& doc, Findings& out) {
  for_each_table(doc, [&](Index m, const ProgressiveMesh& mesh) {
    below(mesh.faces.group, mesh.groups.size(), {.field = Field::face_group, .mesh = m}, out);
  });
}

void replaced_bounds(const Document& doc, Findings& out) {
  for_each_table(doc, [&](Index m, const ProgressiveMesh& mesh) {
    partition(mesh.faces.replaced_first, mesh.faces.replaced.size(),
              {.field = Field::replaced_first, .mesh = m}, out);
  });
}

void replaced_exist(const Document& doc, Findings& out) {
  for_each_table(doc, [&](Index m, const ProgressiveMesh& mesh) {
    below(mesh.faces.replaced, mesh.triangles, {.field = Field::replaced, .mesh = m}, out);
  });
}

void replaced_once(const Document& doc, Findings& out) {
  for_each_table(doc, [&](Index m, const ProgressiveMesh& mesh) {
    all_differ(mesh.faces.replaced, mesh.triangles, [&](std::size_t i) {
      out.add({.field = Field::replaced, .mesh = m, .element = i},
              std::to_string(mesh.faces.replaced[i]));
      return false;
    });
  });
}

void replaced_in_group(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.faces.empty() || !doc.replays[m].finished || !is_sound(doc.strips, m)) return;
    const std::vector<Index> group = groups_of_triangles(mesh, doc.replays[m]);
    for (Index f = 0; f < mesh.faces.count(); ++f)
      for (Index i = mesh.faces.replaced_first[f]; i < mesh.faces.replaced_first[f + 1]; ++i) {
        const Index triangle = mesh.faces.replaced[i];
        if (triangle < group.size() && group[triangle] != mesh.faces.group[f])
          out.add({.field = Field::replaced, .mesh = m, .element = i},
                  "triangle of group " + std::to_string(group[triangle]) + ", face of group " +
                      std::to_string(mesh.faces.group[f]));
      }
  });
}

void faces_counted(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    const std::uint64_t faces =
        std::uint64_t{mesh.triangles} + mesh.faces.count() - mesh.faces.replaced.size();
    if (faces != doc.declared[m].faces)
      out.add({.field = Field::counts, .mesh = m, .element = 6},
              "says " + std::to_string(doc.declared[m].faces) + ", is " + std::to_string(faces));
  });
}

void faces_needed(const Document& doc, Findings& out) {
  noticed<Fault::faces_empty>(doc, out);
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    const bool there =
        doc.xml ? !mesh.faces.empty() : doc.mesh_chunks[m].find(kFacesChunk) != kNone;
    if (!there && !mesh.face_attribute_formats.empty())
      out.add({.field = Field::mesh, .mesh = m}, "the mesh has face attributes");
  });
}

// ---- Order, digest ----

void order_vertices(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (has_order(mesh))
      permutation(mesh.order.vertex, mesh.decoded_vertices(),
                  {.field = Field::order_vertex, .mesh = m}, out);
  });
}

void order_wedges(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (has_order(mesh))
      permutation(mesh.order.wedge, mesh.orders_wedges() ? mesh.decoded_wedges() : 0,
                  {.field = Field::order_wedge, .mesh = m}, out);
  });
}

void order_faces(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (has_order(mesh))
      permutation(mesh.order.face, doc.declared[m].faces, {.field = Field::order_face, .mesh = m},
                  out);
  });
}

void rotations(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (!has_order(mesh) || !is_sound(doc.strips, m)) return;
    if (mesh.order.rotation.size() != doc.declared[m].faces)
      out.add({.field = Field::order, .mesh = m},
              std::to_string(mesh.order.rotation.size()) + " rotations");
    const std::size_t triangles = face_count(mesh) - mesh.faces.count();
    for (std::size_t f = 0; f < mesh.order.rotation.size() && !out.full(); ++f) {
      const Index corners = corners_of_face(mesh.faces, triangles, f);
      if (!is_rotation(mesh.order.rotation[f], corners))
        out.add({.field = Field::rotation, .mesh = m, .element = f},
                std::to_string(mesh.order.rotation[f]) + " of " + std::to_string(corners));
    }
  });
}

void welding_counts(const Document& doc, Findings& out) {
  noticed<Fault::welding_counts>(doc, out);
  for (Index m = 0; m < doc.strips.meshes.size(); ++m)
    if (!has_possible_welding(doc.strips.meshes[m])) out.add({.field = Field::welding, .mesh = m});
}

void welding_fits(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.welding.empty() || !has_possible_welding(mesh)) return;
    const std::optional<Mesh> shown = full_level(doc, m);
    if (shown && !unweld(*shown, mesh.welding)) out.add({.field = Field::welding, .mesh = m});
  });
}

void digest_matches(const Document& doc, Findings& out) {
  for_each_mesh(doc, [&](Index m, const ProgressiveMesh& mesh) {
    if (mesh.digest.empty()) return;
    const std::optional<Mesh> shown = full_level(doc, m);
    if (!shown) return;
    const Result<Mesh> decoded =
        mesh.welding.empty() ? Result<Mesh>(*shown) : unweld(*shown, mesh.welding);
    if (decoded && !std::ranges::equal(digest(*decoded), mesh.digest))
      out.add({.field = Field::digest, .mesh = m});
  });
}

}  // namespace pstrips::inline validators::checks
