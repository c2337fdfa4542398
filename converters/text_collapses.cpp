#include "converters/text_collapses.h"

#include <algorithm>

namespace pstrips::inline converters {
namespace {

// The triangles while they collapse. Dead corners stay in the lists: they do no harm, since a
// triangle with two corners at one vertex decides nothing new.
class Replay {
 public:
  explicit Replay(const Mesh& mesh)
      : wedge_at_(mesh.corners),
        vertex_of_(mesh.wedge_count()),
        corners_of_(mesh.vertex_count()),
        wedges_of_(mesh.vertex_count()),
        target_(mesh.wedge_count(), kNone) {
    for (Index w = 0; w < mesh.wedge_count(); ++w) {
      vertex_of_[w] = mesh.vertex_of(w);
      wedges_of_[vertex_of_[w]].push_back(w);
    }
    for (Index c = 0; c < wedge_at_.size(); ++c) corners_of_[vertex_of_[wedge_at_[c]]].push_back(c);
  }

  void collapse(Index removed, Index kept, CollapseSequence& out) {
    find_targets(removed, kept);
    for (const Index wedge : wedges_of_[removed]) {
      out.moves.push_back({wedge, target_[wedge]});
      if (target_[wedge] != kNone) continue;
      vertex_of_[wedge] = kept;
      wedges_of_[kept].push_back(wedge);
    }
    out.collapses.push_back({removed, kept, 0, static_cast<Index>(wedges_of_[removed].size())});
    for (const Index corner : corners_of_[removed])
      if (const Index to = target_[wedge_at_[corner]]; to != kNone) wedge_at_[corner] = to;
    for (const Index wedge : wedges_of_[removed]) target_[wedge] = kNone;
    join(corners_of_[removed], corners_of_[kept]);
    wedges_of_[removed] = {};
  }

 private:
  // The lowest triangle on the edge decides for a wedge.
  void find_targets(Index removed, Index kept) {
    std::ranges::sort(corners_of_[removed]);
    for (const Index corner : corners_of_[removed]) {
      Index& target = target_[wedge_at_[corner]];
      const Index first = corner / 3 * 3;
      for (Index c = first; c < first + 3 && target == kNone; ++c)
        if (vertex_of_[wedge_at_[c]] == kept) target = wedge_at_[c];
    }
  }
  static void join(std::vector<Index>& from, std::vector<Index>& into) {
    if (from.size() > into.size()) from.swap(into);
    into.insert(into.end(), from.begin(), from.end());
    from = {};
  }

  std::vector<Index> wedge_at_;                 // each corner's wedge now
  std::vector<Index> vertex_of_;                // each wedge's vertex now
  std::vector<std::vector<Index>> corners_of_;  // each vertex's corners
  std::vector<std::vector<Index>> wedges_of_;   // each vertex's wedges
  std::vector<Index> target_;                   // of the wedges of one collapse
};

/// Whether each vertex stands in a triangle that strips can show.
std::vector<bool> drawn_vertices(const Mesh& mesh) {
  std::vector<bool> out(mesh.vertex_count(), false);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    const Index a = mesh.vertex_of(face[0]), b = mesh.vertex_of(face[1]),
                c = mesh.vertex_of(face[2]);
    if (a != b && b != c && a != c) out[a] = out[b] = out[c] = true;
  }
  return out;
}

}  // namespace

CollapseSequence collapses_of(const TextProgressive& text) {
  CollapseSequence out;
  const std::vector<bool> drawn = drawn_vertices(text.mesh);
  Replay replay(text.mesh);
  Attribute positions = text.mesh.position;
  positions.data = text.kept_position;
  for (std::size_t i = 0; i < text.collapses.size(); ++i) {
    const TextCollapse& c = text.collapses[i];
    if (c.kept == kNone || !drawn[c.removed] || !drawn[c.kept]) continue;
    replay.collapse(c.removed, c.kept, out);
    for (std::size_t k = 0; k < 3 && !positions.data.empty(); ++k)
      out.placements.push_back(component(positions, i, k));
  }
  return out;
}

}  // namespace pstrips::inline converters
