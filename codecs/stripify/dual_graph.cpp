#include "codecs/stripify/dual_graph.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <tuple>
#include <utility>

#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

// A half-edge in the list of its lower wedge.
struct ListedHalfEdge {
  Index high;  // its higher wedge
  Index half_edge;
  friend auto operator<=>(const ListedHalfEdge&, const ListedHalfEdge&) = default;
};

// What pairing needs of a mesh, half-edge by half-edge.
struct TriangleEdges {
  const StripInput& input;
  Index count() const { return static_cast<Index>(input.triangles.size()); }
  Index wedge_count() const { return input.wedge_count; }
  Index origin(Index h) const { return input.triangles[h]; }
  Index target(Index h) const { return input.triangles[next_in_triangle(h)]; }
  Index group(Index h) const { return input.group.empty() ? 0 : input.group[triangle_of(h)]; }
};

class PolygonEdges {
 public:
  explicit PolygonEdges(const PolygonInput& input) : input_(input), face_(input.corners.size()) {
    for (std::size_t f = 0; f + 1 < input.face_first.size(); ++f)
      std::fill(face_.begin() + input.face_first[f], face_.begin() + input.face_first[f + 1],
                static_cast<Index>(f));
  }
  Index count() const { return static_cast<Index>(input_.corners.size()); }
  Index wedge_count() const { return input_.wedge_count; }
  Index origin(Index h) const { return input_.corners[h]; }
  Index target(Index h) const {
    const Index first = input_.face_first[face_[h]], end = input_.face_first[face_[h] + 1];
    return input_.corners[h + 1 == end ? first : h + 1];
  }
  Index group(Index h) const { return input_.group.empty() ? 0 : input_.group[face_[h]]; }

 private:
  const PolygonInput& input_;
  std::vector<Index> face_;
};

template <class Edges>
class Pairing {
 public:
  explicit Pairing(Edges edges) : edges_(std::move(edges)), opposite_(edges_.count(), kNone) {}

  std::vector<Index> run() {
    Grouped<ListedHalfEdge> by_wedge = list_by_lower_wedge();
    for (std::size_t w = 0; w < by_wedge.keys(); ++w) pair_edges_of_wedge(by_wedge[w]);
    return std::move(opposite_);
  }

 private:
  Index origin(Index h) const { return edges_.origin(h); }
  Index target(Index h) const { return edges_.target(h); }
  bool ascends(Index h) const { return origin(h) < target(h); }
  Index group(Index h) const { return edges_.group(h); }

  Grouped<ListedHalfEdge> list_by_lower_wedge() const {
    return group_each<ListedHalfEdge>(edges_.wedge_count(), [&](auto&& visit) {
      for (Index h = 0; h < edges_.count(); ++h) {
        const Index from = origin(h), to = target(h);
        assert(from < edges_.wedge_count() && from != to);
        visit(std::min(from, to), [&] { return ListedHalfEdge{std::max(from, to), h}; });
      }
    });
  }

  void pair_edges_of_wedge(std::span<ListedHalfEdge> edges) {
    std::ranges::sort(edges);
    while (!edges.empty()) {
      std::size_t n = 1;
      while (n < edges.size() && edges[n].high == edges[0].high) ++n;
      if (n == 2)
        pair_two(edges[0].half_edge, edges[1].half_edge);
      else if (n > 2)
        pair_many(edges.first(n));
      edges = edges.subspan(n);
    }
  }

  void pair_two(Index a, Index b) {
    if (ascends(a) == ascends(b) || group(a) != group(b)) return;
    opposite_[a] = b;
    opposite_[b] = a;
  }

  void pair_many(std::span<ListedHalfEdge> edges) {
    const auto key = [&](const ListedHalfEdge& e) {
      return std::tuple(group(e.half_edge), ascends(e.half_edge), e.half_edge);
    };
    std::ranges::sort(edges, {}, key);
    for (std::size_t begin = 0, stop; begin < edges.size(); begin = stop) {
      const Index g = group(edges[begin].half_edge);
      std::size_t up = begin;
      while (up < edges.size() && group(edges[up].half_edge) == g && !ascends(edges[up].half_edge))
        ++up;
      stop = up;
      while (stop < edges.size() && group(edges[stop].half_edge) == g) ++stop;
      for (std::size_t down = begin, rise = up; down < up && rise < stop; ++down, ++rise)
        pair_two(edges[down].half_edge, edges[rise].half_edge);
    }
  }

  Edges edges_;
  std::vector<Index> opposite_;
};

}  // namespace

DualGraph make_dual_graph(const StripInput& input) {
  assert(input.triangles.size() % 3 == 0 && input.triangles.size() <= kMaxCount);
  assert(input.group.empty() || input.group.size() == input.triangles.size() / 3);
  return {Pairing(TriangleEdges{input}).run()};
}

std::vector<Index> opposite_half_edges(const PolygonInput& input) {
  assert(input.corners.size() <= kMaxCount);
  assert(input.group.empty() || input.group.size() + 1 == input.face_first.size());
  return Pairing(PolygonEdges(input)).run();
}

}  // namespace pstrips::inline codecs
