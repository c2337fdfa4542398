#include "codecs/stripify/dual_graph.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

namespace pstrips::inline codecs {
namespace {

// A half-edge filed under its lower wedge.
struct Filed {
  Index high;  // its higher wedge
  Index half_edge;
  friend auto operator<=>(const Filed&, const Filed&) = default;
};

// What pairing asks of a mesh, half-edge by half-edge.
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
    file_by_lower_wedge();
    Index begin = 0;
    for (const Index end : end_) {
      pair_edges_of_wedge(begin, end);
      begin = end;
    }
    return std::move(opposite_);
  }

 private:
  Index origin(Index h) const { return edges_.origin(h); }
  Index target(Index h) const { return edges_.target(h); }
  bool ascends(Index h) const { return origin(h) < target(h); }
  Index group(Index h) const { return edges_.group(h); }

  void file_by_lower_wedge() {
    const Index n = edges_.count();
    end_.resize(edges_.wedge_count());
    for (Index h = 0; h < n; ++h) {
      assert(origin(h) < edges_.wedge_count() && origin(h) != target(h));
      ++end_[std::min(origin(h), target(h))];
    }
    Index sum = 0;
    for (Index& count : end_) {  // counts become starts; filing moves them to the ends
      const Index start = sum;
      sum += count;
      count = start;
    }
    filed_.resize(n);
    for (Index h = 0; h < n; ++h)
      filed_[end_[std::min(origin(h), target(h))]++] = {std::max(origin(h), target(h)), h};
  }

  void pair_edges_of_wedge(Index begin, Index end) {
    const auto at = [&](Index i) { return filed_.begin() + i; };
    std::sort(at(begin), at(end));
    while (begin < end) {
      Index stop = begin + 1;
      while (stop < end && filed_[stop].high == filed_[begin].high) ++stop;
      if (stop - begin == 2)
        pair_two(filed_[begin].half_edge, filed_[begin + 1].half_edge);
      else if (stop - begin > 2)
        pair_many(begin, stop);
      begin = stop;
    }
  }

  void pair_two(Index a, Index b) {
    if (ascends(a) == ascends(b) || group(a) != group(b)) return;
    opposite_[a] = b;
    opposite_[b] = a;
  }

  void pair_many(Index begin, Index end) {
    const auto key = [&](const Filed& f) {
      return std::tuple(group(f.half_edge), ascends(f.half_edge), f.half_edge);
    };
    std::sort(filed_.begin() + begin, filed_.begin() + end,
              [&](const Filed& a, const Filed& b) { return key(a) < key(b); });
    while (begin < end) {
      const Index g = group(filed_[begin].half_edge);
      Index up = begin;
      while (up < end && group(filed_[up].half_edge) == g && !ascends(filed_[up].half_edge)) ++up;
      Index stop = up;
      while (stop < end && group(filed_[stop].half_edge) == g) ++stop;
      for (Index down = begin, rise = up; down < up && rise < stop; ++down, ++rise)
        pair_two(filed_[down].half_edge, filed_[rise].half_edge);
      begin = stop;
    }
  }

  Edges edges_;
  std::vector<Index> opposite_;
  std::vector<Index> end_;  // per wedge: one past its last in filed_
  std::vector<Filed> filed_;
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
