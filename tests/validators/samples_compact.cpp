#include <cmath>

#include "codecs/compact/record_batches.h"
#include "formats/pstrip/payload/compact/octahedron.h"
#include "tests/validators/samples.h"

namespace pstrips::test {
namespace {

constexpr Index kSide = 6;

/// A square of squares over which the height waves, with a seam in its middle.
Mesh waving_square() {
  Mesh mesh;
  std::vector<float> positions, uvs;
  const auto add_wedge = [&](Index vertex, float u) {
    mesh.wedge_vertex.push_back(vertex);
    uvs.insert(uvs.end(), {u, static_cast<float>(vertex / kSide) / 3.f});
  };
  for (Index v = 0; v < kSide * kSide; ++v) {
    const auto x = static_cast<float>(v % kSide), y = static_cast<float>(v / kSide);
    positions.insert(positions.end(), {x / 3.f, y / 3.f, static_cast<float>((v * v) % 7) / 37.f});
    add_wedge(v, x / 3.f);
  }
  std::vector<Index> beyond(kSide * kSide);  // the wedge on the right side of the seam
  for (Index v = 3; v < kSide * kSide; v += kSide) {
    beyond[v] = static_cast<Index>(mesh.wedge_vertex.size());
    add_wedge(v, 0.1f);
  }
  for (Index y = 0; y + 1 < kSide; ++y)
    for (Index x = 0; x + 1 < kSide; ++x) {
      const auto wedge = [&](Index dx, Index dy) {
        const Index v = (y + dy) * kSide + x + dx;
        return x >= 3 && beyond[v] != 0 ? beyond[v] : v;
      };
      for (const Index w :
           {wedge(0, 0), wedge(1, 0), wedge(1, 1), wedge(0, 0), wedge(1, 1), wedge(0, 1)})
        mesh.corners.push_back(w);
    }
  const auto bytes = [](std::span<const float> values) {
    const ByteView view = std::as_bytes(values);
    return Bytes(view.begin(), view.end());
  };
  mesh.position.data = bytes(positions);
  mesh.wedge_attributes.push_back({.semantic = "TEXCOORD_0",
                                   .type = ComponentType::f32,
                                   .count = 2,
                                   .normalized = false,
                                   .data = bytes(uvs)});
  mesh.groups.push_back({.name = "square"});
  return mesh;
}

/// Every vertex in an odd column goes to the left, then in odd rows up.
CollapseSequence collapses() {
  CollapseSequence out;
  const auto add = [&](Index removed, Index kept) {
    out.collapses.push_back({.removed = removed, .kept = kept, .error = 0, .moves = 0});
  };
  for (Index v = 0; v < kSide * kSide; ++v)
    if (v % 2 == 1 && v % kSide != 3 && v % kSide != kSide - 1) add(v, v - 1);
  for (Index v = kSide; v < kSide * kSide - kSide; ++v)
    if (v / kSide % 2 == 1 && (v % 2 == 0 || v % kSide == 3)) add(v, v - kSide);
  return out;
}

/// A direction for each wedge; nearly all turn slowly, and some lie on the rim of the square.
void add_directions(Mesh& mesh, const char* semantic, std::uint8_t count, unsigned bits) {
  const Octahedron octahedron(bits);
  Attribute a{semantic, ComponentType::f32, count, false, {}};
  a.data.resize(a.element_bytes() * mesh.wedge_count());
  for (Index w = 0; w < mesh.wedge_count(); ++w) {
    const auto x = static_cast<std::int64_t>(w % kSide), y = static_cast<std::int64_t>(w / kSide);
    Octahedron::Point at = octahedron.near({4 * x - 10, 3 * y - 8, w % 11 == 0 ? -20 : 5});
    if (w % 7 == 0) at = octahedron.placed(octahedron.reach(), x);
    const Octahedron::Vector unit = octahedron.unit(at);
    for (unsigned k = 0; k < 3; ++k)
      set_component(a, w, k, std::ldexp(static_cast<double>(unit[k]), -24));
    if (count == 4) set_component(a, w, 3, x < 3 ? -1 : 1);
  }
  mesh.wedge_attributes.push_back(std::move(a));
}

ProgressiveStrips in_batches(const Mesh& mesh) {
  BatchRecording made = record_batches(mesh, triangulate(mesh), collapses());
  ProgressiveStrips strips;
  strips.profile = Profile::compact;
  strips.meshes.push_back(std::move(made.recording.mesh));
  ProgressiveMesh& to = strips.meshes[0];
  to.grid = {.step = 1.f / 256, .origin = {0, 0, 0}, .exact = false};
  const auto level = [&](Index first, Index vsplits) {
    const LevelCounts& counts = made.recording.levels[first + vsplits];
    const auto left = static_cast<float>(to.vsplits.size() - first - vsplits);
    return Packet{.mesh = 0,
                  .first_vsplit = first,
                  .vsplits = vsplits,
                  .vertices = to.base_vertices + first + vsplits,
                  .triangles = counts.triangles,
                  .strips = counts.strips,
                  .error = left,
                  .one_sided_error = left};
  };
  strips.bases = {level(0, 0)};
  Index first = 0;
  for (const Index vsplits : made.batches) {
    strips.packets.push_back(level(first, vsplits));
    first += vsplits;
  }
  return strips;
}

}  // namespace

ProgressiveStrips batches() { return in_batches(waving_square()); }

ProgressiveStrips directions() {
  Mesh mesh = waving_square();
  add_directions(mesh, "NORMAL", 3, 8);
  add_directions(mesh, "TANGENT", 4, 5);
  return in_batches(mesh);
}

ProgressiveStrips small() {
  ProgressiveStrips strips = batches();
  strips.meshes[0].effort = Effort::small;
  return strips;
}

}  // namespace pstrips::test
