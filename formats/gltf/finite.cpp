#include "formats/gltf/finite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gather.h"

namespace pstrips::inline formats::gltf {
namespace {

bool is_float(const Attribute& position) {
  return position.type == ComponentType::f32 || position.type == ComponentType::f64;
}

/// One flag a vertex.
std::vector<bool> held_vertices(const Attribute& position) {
  std::vector<bool> out(position.elements(), true);
  const std::size_t components = std::min<std::size_t>(position.count, 3);
  for (std::size_t v = 0; v < out.size(); ++v)
    for (std::size_t c = 0; c < components; ++c) {
      const double x = component(position, v, c);
      if (!(std::abs(x) <= double{std::numeric_limits<float>::max()})) out[v] = false;
    }
  return out;
}

/// The kept ones, and the new number of each old one.
struct Renumbering {
  std::vector<Index> kept, number;

  template <class Keeps>
  Renumbering(Index count, Keeps&& keeps) : number(count, kNone) {
    for (Index i = 0; i < count; ++i) {
      if (!keeps(i)) continue;
      number[i] = static_cast<Index>(kept.size());
      kept.push_back(i);
    }
  }
};

}  // namespace

std::optional<Mesh> without_endless_vertices(const Mesh& mesh, Notes& notes) {
  if (!is_float(mesh.position)) return std::nullopt;
  const std::vector<bool> is_held = held_vertices(mesh.position);
  if (std::ranges::find(is_held, false) == is_held.end()) return std::nullopt;
  const Renumbering vertices(mesh.vertex_count(), [&](Index v) { return is_held[v]; });
  const Renumbering wedges(mesh.wedge_count(), [&](Index w) { return is_held[mesh.vertex_of(w)]; });
  const Renumbering faces(mesh.face_count(), [&](Index f) {
    return std::ranges::all_of(mesh.face(f), [&](Index w) { return is_held[mesh.vertex_of(w)]; });
  });

  Mesh out;
  out.name = mesh.name;
  out.groups = mesh.groups;
  out.position = gather(mesh.position, vertices.kept);
  for (const Index w : wedges.kept) out.wedge_vertex.push_back(vertices.number[mesh.vertex_of(w)]);
  for (const Attribute& a : mesh.wedge_attributes)
    out.wedge_attributes.push_back(gather(a, wedges.kept));
  for (const Attribute& a : mesh.face_attributes)
    out.face_attributes.push_back(gather(a, faces.kept));
  out.face_first.push_back(0);
  for (const Index f : faces.kept) {
    for (const Index w : mesh.face(f)) out.corners.push_back(wedges.number[w]);
    out.face_first.push_back(static_cast<Index>(out.corners.size()));
    out.face_group.push_back(mesh.group_of(f));
  }
  canonicalize(out);
  const auto left_out = [&](const char* what, std::size_t before, std::size_t after) {
    if (before > after) notes.dropped.push_back(std::to_string(before - after) + what);
  };
  left_out(" vertices at NaN, infinity or beyond the range of f32", mesh.vertex_count(),
           vertices.kept.size());
  left_out(" faces at such vertices", mesh.face_count(), faces.kept.size());
  return out;
}

}  // namespace pstrips::inline formats::gltf
