#include "codecs/vsplit/faces.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "codecs/vsplit/level.h"
#include "core/edge_pairs.h"
#include "core/gather.h"
#include "core/group_by.h"
#include "core/joined_faces.h"

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

// The map's triangles in its order, in wedges of the source.
struct MapTriangles {
  std::vector<Index> corners, group;
  std::vector<Index> from;  // which triangle of the source each is
  std::vector<Index> of;    // where each triangle of the source went
};

MapTriangles map_triangles(const Mesh& source, const Triangulation& triangles,
                           const StripMap& strips, const ProgressiveMesh& mesh) {
  MapTriangles out;
  out.of.resize(triangles.face.size());
  TriangleFinder finder(source, triangles);
  for_each_source_triangle(source, strips, mesh, [&](const Triple& corners, Index group) {
    const Index from = finder.take(corners, group);
    out.of[from] = static_cast<Index>(out.from.size());
    out.from.push_back(from);
    out.corners.insert(out.corners.end(), corners.begin(), corners.end());
    out.group.push_back(group);
  });
  return out;
}

// The pieces of each face: from first[f] on to first[f + 1] among the source's triangles.
std::vector<Index> first_pieces(const Triangulation& triangles, Index faces) {
  std::vector<Index> first(faces + std::size_t{1}, 0);
  for (const Index f : triangles.face) ++first[f + 1];
  for (Index f = 0; f < faces; ++f) first[f + 1] += first[f];
  return first;
}

// Puts the faces of a source into a table and notes their order.
class FaceRecorder {
 public:
  FaceRecorder(const Mesh& source, const Triangulation& triangles, const MapTriangles& map,
               FaceRecord& out)
      : source_(source),
        triangles_(triangles),
        map_(map),
        first_piece_(first_pieces(triangles, source.face_count())),
        done_(source.face_count()),
        out_(out) {}

  // A face is plain when the strips hold it as it is: a triangle with three different vertices.
  void take_plain() {
    for (Index t = 0; t < map_.from.size(); ++t) {
      const Index f = triangles_.face[map_.from[t]];
      if (pieces(f) != 1 || source_.face(f).size() != 3) continue;
      const auto corners = std::span(map_.corners).subspan(std::size_t{3} * t, 3);
      const auto start = std::ranges::find(corners, source_.face(f)[0]);
      note(f, static_cast<std::size_t>(start - corners.begin()));
    }
  }

  // Polygons that are triangles joined over their edges: a file can say them by the joins.
  void take_joined() {
    const std::vector<Index> opposite =
        pair_half_edges(map_.corners, map_.group, source_.wedge_count());
    JoinedFaces joined(opposite);
    std::vector<Index> turn(source_.face_count(), kNone), list;
    for (Index f = 0; f < source_.face_count(); ++f) {
      list.clear();
      for (Index p = first_piece_[f]; p < first_piece_[f + 1]; ++p) list.push_back(map_.of[p]);
      std::ranges::sort(list);
      turn[f] = joined.join_turned(list, source_.face(f), map_.corners);
    }
    table() = joined.faces(map_.corners, map_.group);
    for (Index i = 0; i < table().count(); ++i) {
      const Index f = triangles_.face[map_.from[table().replaced[table().replaced_first[i]]]];
      note(f, turn[f]);
    }
  }

  // In source order.
  void take_others() {
    FaceTable& t = table();
    for (std::vector<Index>* first : {&t.first, &t.replaced_first})
      if (!first->empty()) first->pop_back();
    for (Index f = 0; f < source_.face_count(); ++f) {
      if (done_[f]) continue;
      t.first.push_back(static_cast<Index>(t.corners.size()));
      t.replaced_first.push_back(static_cast<Index>(t.replaced.size()));
      const std::span<const Index> corners = source_.face(f);
      t.corners.insert(t.corners.end(), corners.begin(), corners.end());
      t.group.push_back(source_.group_of(f));
      for (Index p = first_piece_[f]; p < first_piece_[f + 1]; ++p)
        t.replaced.push_back(map_.of[p]);
      note(f, 0);
    }
    if (t.first.empty()) return;
    t.first.push_back(static_cast<Index>(t.corners.size()));
    t.replaced_first.push_back(static_cast<Index>(t.replaced.size()));
  }

 private:
  FaceTable& table() { return out_.faces; }
  Index pieces(Index face) const { return first_piece_[face + 1] - first_piece_[face]; }
  void note(Index face, std::size_t turn) {
    done_[face] = true;
    out_.order.face.push_back(face);
    out_.order.rotation.push_back(static_cast<std::uint8_t>(turn));
  }

  const Mesh& source_;
  const Triangulation& triangles_;
  const MapTriangles& map_;
  std::vector<Index> first_piece_;
  std::vector<bool> done_;
  FaceRecord& out_;
};

}  // namespace

FaceRecord record_faces(const Mesh& source, const Triangulation& triangles, const StripMap& strips,
                        const Recording& recording, bool with_order) {
  const bool all_plain = source.face_first.empty() && triangles.face.size() == source.face_count();
  if (all_plain && source.face_attributes.empty() && !with_order) return {};
  FaceRecord out;
  const MapTriangles map = map_triangles(source, triangles, strips, recording.mesh);
  FaceRecorder recorder(source, triangles, map, out);
  recorder.take_plain();
  if (!all_plain) {
    recorder.take_joined();
    recorder.take_others();
  }
  const std::vector<Index> wedge_to = inverse(recording.wedge_from);
  for (Index& wedge : out.faces.corners) wedge = wedge_to[wedge];
  for (const Attribute& a : source.face_attributes)
    out.faces.attributes.push_back(gather(a, out.order.face));
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
