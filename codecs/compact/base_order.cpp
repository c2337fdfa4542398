#include "codecs/compact/base_order.h"

#include <algorithm>
#include <utility>

#include "core/star_mesh.h"

namespace pstrips::inline codecs {
namespace {

// The corners at which the edges between two vertices start.
class Edges {
 public:
  explicit Edges(std::span<const Index> triangles) : triangles_(triangles) {
    for (Index c = 0; c < triangles.size(); ++c) edges_.push_back({ends_of(c), c});
    std::ranges::sort(edges_);
    crossed_.resize(edges_.size());
  }

  // Calls visit(corner) for all with the edge that starts at `corner`; only once for each edge.
  template <class Visit>
  void cross(Index corner, Visit&& visit) {
    const Ends ends = ends_of(corner);
    auto e = std::ranges::lower_bound(edges_, std::pair(ends, Index{0}));
    const auto first = static_cast<std::size_t>(e - edges_.begin());
    if (crossed_[first]) return;
    crossed_[first] = true;
    for (; e != edges_.end() && e->first == ends; ++e) visit(e->second);
  }

 private:
  using Ends = std::pair<Index, Index>;
  Ends ends_of(Index corner) const {
    return std::minmax({triangles_[corner], triangles_[StarMesh::next_in_face(corner)]});
  }

  std::span<const Index> triangles_;
  std::vector<std::pair<Ends, Index>> edges_;
  std::vector<bool> crossed_;  // by the first of each edge
};

}  // namespace

BaseOrder base_order(std::span<const Index> triangles, Index vertices) {
  Edges edges(triangles);
  BaseOrder out;
  std::vector<bool> reached(triangles.size() / 3), numbered(vertices);
  const auto number = [&](Index vertex) {
    if (!numbered[vertex]) out.vertex.push_back(vertex);
    numbered[vertex] = true;
  };
  const auto reach = [&](Index corner) {
    const Index triangle = corner / 3, turn = corner % 3;
    if (reached[triangle]) return;
    reached[triangle] = true;
    out.triangle.push_back(triangle);
    out.turn.push_back(static_cast<std::uint8_t>(turn));
    for (unsigned k = 0; k < 3; ++k) number(triangles[3 * triangle + (turn + k) % 3]);
  };
  std::size_t next = 0;
  for (Index seed = 0; seed < reached.size(); ++seed) {
    reach(3 * seed);
    for (; next < out.triangle.size(); ++next)
      for (const unsigned k : {1u, 2u, 0u})
        edges.cross(3 * out.triangle[next] + (out.turn[next] + k) % 3, reach);
  }
  for (Index v = 0; v < vertices; ++v) number(v);
  return out;
}

}  // namespace pstrips::inline codecs
