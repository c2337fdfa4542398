#include "codecs/vsplit/faces.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "codecs/vsplit/level.h"
#include "core/gather.h"
#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

using Triple = std::array<Index, 3>;

// Finds the source triangle of each triangle of the strips. Equal triangles of one group are
// handed out in source order.
class TriangleFinder {
 public:
  TriangleFinder(const Mesh& source, const Triangulation& triangles)
      : handed_out_(triangles.face.size(), 0) {
    std::vector<Key> unsorted(triangles.face.size());
    for (Index t = 0; t < unsorted.size(); ++t) {
      const Index* c = triangles.corners.data() + std::size_t{3} * t;
      unsorted[t] = key({c[0], c[1], c[2]}, source.group_of(triangles.face[t]));
      unsorted[t].triangle = t;
    }
    keys_ = group_each<Key>(source.wedge_count(), [&](auto&& visit) {
      for (const Key& k : unsorted) visit(k.wedges[0], [&] { return k; });
    });
    for (std::size_t w = 0; w < keys_.keys(); ++w) std::ranges::sort(keys_[w]);
  }

  Index take(const Triple& wedges, Index group) {
    const Key wanted = key(wedges, group);
    const std::span<const Key> keys = keys_[wanted.wedges[0]];
    const auto run = std::ranges::lower_bound(keys, wanted);
    assert(run != keys.end() && run->wedges == wanted.wedges && run->group == group);
    const auto place = keys_.first[wanted.wedges[0]] + (run - keys.begin());
    return run[handed_out_[static_cast<std::size_t>(place)]++].triangle;
  }

 private:
  struct Key {
    Triple wedges;  // turned so that the least comes first
    Index group;
    Index triangle;
    auto operator<=>(const Key&) const = default;
  };
  static Key key(Triple t, Index group) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return {t, group, 0};
  }

  Grouped<Key> keys_;              // by least wedge
  std::vector<Index> handed_out_;  // of the run of equal triangles that starts there
};

std::vector<Index> inverse(std::span<const Index> permutation) {
  std::vector<Index> out(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i) out[permutation[i]] = static_cast<Index>(i);
  return out;
}

// Calls visit(wedges, group), in the order of the map, which is in wedges of the source.
template <class Visit>
void for_each_source_triangle(const Mesh& source, const StripMap& map, const ProgressiveMesh& mesh,
                              Visit&& visit) {
  const std::span<const Index> entries = map.entries;
  if (mesh.encoding == MapEncoding::triangles) {
    for (std::size_t i = 0; i < entries.size(); i += 3)
      visit(Triple{entries[i], entries[i + 1], entries[i + 2]},
            mesh.triangle_group.empty() ? 0 : mesh.triangle_group[i / 3]);
    return;
  }
  std::size_t first = 0;
  for (Index group = 0; group < map.group_entries.size(); ++group) {
    core::for_each_triangle(
        entries.subspan(first, map.group_entries[group]),
        [&](Index wedge) { return source.vertex_of(wedge); },
        [&](Index a, Index b, Index c) {
          visit(Triple{a, b, c}, group);
        });
    first += map.group_entries[group];
  }
}

}  // namespace

FaceRecord record_faces(const Mesh& source, const Triangulation& triangles, const StripMap& strips,
                        const Recording& recording, bool with_order) {
  // A face is plain when the strips hold it as it is: a triangle with three different vertices.
  const Index faces = source.face_count();
  const bool all_plain = source.face_first.empty() && triangles.face.size() == faces;
  if (all_plain && source.face_attributes.empty() && !with_order) return {};
  std::vector<Index> pieces(faces, 0);
  for (const Index f : triangles.face) ++pieces[f];
  const auto is_plain = [&](Index f) { return pieces[f] == 1 && source.face(f).size() == 3; };

  // The map's triangles in its order.
  FaceRecord out;
  TriangleFinder finder(source, triangles);
  std::vector<Index> map_triangle(triangles.face.size());  // of each source triangle, in map order
  Index t = 0;
  for_each_source_triangle(source, strips, recording.mesh, [&](const Triple& corners, Index group) {
    const Index from = finder.take(corners, group);
    map_triangle[from] = t++;
    const Index f = triangles.face[from];
    if (!is_plain(f)) return;
    out.order.face.push_back(f);
    const Index start = source.face(f)[0];
    out.order.rotation.push_back(
        static_cast<std::uint8_t>(std::ranges::find(corners, start) - corners.begin()));
  });

  // Everything else, in source order.
  const std::vector<Index> wedge_to = inverse(recording.wedge_from);
  FaceTable& table = out.faces;
  Index piece = 0;
  for (Index f = 0; f < faces; ++f) {
    const Index end = piece + pieces[f];
    if (!is_plain(f)) {
      table.first.push_back(static_cast<Index>(table.corners.size()));
      table.replaced_first.push_back(static_cast<Index>(table.replaced.size()));
      for (const Index w : source.face(f)) table.corners.push_back(wedge_to[w]);
      table.group.push_back(source.group_of(f));
      for (Index p = piece; p < end; ++p) table.replaced.push_back(map_triangle[p]);
      out.order.face.push_back(f);
      out.order.rotation.push_back(0);
    }
    piece = end;
  }
  if (!table.first.empty()) {
    table.first.push_back(static_cast<Index>(table.corners.size()));
    table.replaced_first.push_back(static_cast<Index>(table.replaced.size()));
  }

  for (const Attribute& a : source.face_attributes)
    table.attributes.push_back(gather(a, out.order.face));
  if (!with_order) {
    out.order = {};
    return out;
  }
  out.order.vertex = recording.vertex_from;
  if (!recording.mesh.single_wedges) out.order.wedge = recording.wedge_from;
  return out;
}

Mesh mesh_to_decode(const Mesh& source, const StripMap& strips, const Recording& recording) {
  const ProgressiveMesh& mesh = recording.mesh;
  const std::vector<Index> wedge_to = inverse(recording.wedge_from);
  std::vector<Index> map;
  map.reserve(strips.entries.size());
  for (const Index w : strips.entries) map.push_back(w == kRestart ? kRestart : wedge_to[w]);
  std::vector<Index> wedge_vertex;
  if (!mesh.single_wedges) {
    const std::vector<Index> vertex_to = inverse(recording.vertex_from);
    wedge_vertex.reserve(mesh.wedges);
    for (const Index w : recording.wedge_from)
      wedge_vertex.push_back(vertex_to[source.vertex_of(w)]);
  }
  Bytes moved;
  if (mesh.placement == Placement::optimal)
    moved = gather(source.position, recording.vertex_from).data;
  return mesh_of(LevelView{&mesh, mesh.vertices, mesh.wedges, map, wedge_vertex,
                           moved.empty() ? mesh.position.data : moved})
      .value();
}

}  // namespace pstrips::inline codecs
