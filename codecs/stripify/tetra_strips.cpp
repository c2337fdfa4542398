#include "codecs/stripify/tetra_strips.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <compare>
#include <span>

#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

// The corners of the face across from each corner, counter-clockwise from outside.
constexpr std::array<std::array<Index, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A face in the list of its lowest vertex.
struct ListedFace {
  Index middle, high;  // its other vertices
  bool is_odd;         // counter-clockwise it is (lowest, high, middle)
  Index face;
  friend auto operator<=>(const ListedFace&, const ListedFace&) = default;
  bool same_vertices(const ListedFace& other) const {
    return middle == other.middle && high == other.high;
  }
};

class FacePairing {
 public:
  FacePairing(std::span<const Index> tetrahedra, Index vertex_count)
      : tetrahedra_(tetrahedra),
        vertex_count_(vertex_count),
        graph_{std::vector<Index>(tetrahedra.size(), kNone)} {}

  TetraGraph run() {
    Grouped<ListedFace> by_vertex = list_by_lowest_vertex();
    for (std::size_t v = 0; v < by_vertex.keys(); ++v) pair_faces_of_vertex(by_vertex[v]);
    return std::move(graph_);
  }

 private:
  std::array<Index, 3> face(Index f) const {
    std::array<Index, 3> out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = tetrahedra_[f / 4 * 4 + kFaces[f % 4][i]];
    std::rotate(out.begin(), std::ranges::min_element(out), out.end());
    return out;
  }
  bool has_a_vertex_twice(Index t) const {
    std::array<Index, 4> v;
    std::copy_n(tetrahedra_.begin() + 4 * std::ptrdiff_t{t}, 4, v.begin());
    std::ranges::sort(v);
    return std::ranges::adjacent_find(v) != v.end();
  }

  template <class Visit>
  void for_each_face(Visit&& visit) const {
    for (Index t = 0; t < graph_.tetra_count(); ++t)
      if (!has_a_vertex_twice(t))
        for (Index f = 4 * t; f < 4 * t + 4; ++f) visit(f, face(f));
  }

  Grouped<ListedFace> list_by_lowest_vertex() const {
    return group_each<ListedFace>(vertex_count_, [&](auto&& visit) {
      for_each_face([&](Index f, const auto& v) {
        visit(v[0], [&] {
          return ListedFace{std::min(v[1], v[2]), std::max(v[1], v[2]), v[1] > v[2], f};
        });
      });
    });
  }

  void pair_faces_of_vertex(std::span<ListedFace> faces) {
    std::ranges::sort(faces);
    for (std::size_t begin = 0, stop; begin < faces.size(); begin = stop) {
      const auto is_same = [&](std::size_t i) {
        return i < faces.size() && faces[i].same_vertices(faces[begin]);
      };
      std::size_t odd = begin;
      while (is_same(odd) && !faces[odd].is_odd) ++odd;
      stop = odd;
      while (is_same(stop)) ++stop;
      for (std::size_t i = begin, j = odd; i < odd && j < stop; ++i, ++j) {
        graph_.opposite[faces[i].face] = faces[j].face;
        graph_.opposite[faces[j].face] = faces[i].face;
      }
    }
  }

  std::span<const Index> tetrahedra_;
  Index vertex_count_;
  TetraGraph graph_;
};

/// Sorted vertices and whether an odd permutation sorts them; even of those with a vertex twice.
struct Oriented {
  Tetra vertices;
  bool is_odd;
  friend auto operator<=>(const Oriented&, const Oriented&) = default;
};

Oriented oriented(const Tetra& tetra) {
  Oriented out{tetra, false};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j + 1 < 4 - i; ++j)
      if (out.vertices[j] > out.vertices[j + 1]) {
        std::swap(out.vertices[j], out.vertices[j + 1]);
        out.is_odd = !out.is_odd;
      }
  if (std::ranges::adjacent_find(out.vertices) != out.vertices.end()) out.is_odd = false;
  return out;
}

bool are_whole(const TetraStrips& strips) {
  if (strips.vertices.size() != strips.replaced.size()) return false;
  for (std::size_t i = 0; i < strips.replaced.size(); ++i) {
    if (strips.replaced[i] > 4) return false;
    if (strips.replaced[i] != 0) {
      if (i == 0) return false;
      continue;
    }
    for (const std::size_t stop = i + 3; i < stop; ++i)
      if (i + 1 >= strips.replaced.size() || strips.replaced[i + 1] != 0) return false;
  }
  return true;
}

}  // namespace

TetraGraph make_tetra_graph(std::span<const Index> tetrahedra, Index vertex_count) {
  assert(tetrahedra.size() % 4 == 0 && tetrahedra.size() <= kMaxCount);
  return FacePairing(tetrahedra, vertex_count).run();
}

TetraStrips emit_tetra_strips(std::span<const Index> tetrahedra, const TetraGraph& graph,
                              std::span<const std::uint8_t> links) {
  TetraStrips out;
  std::vector<std::uint8_t> done(graph.tetra_count());
  const auto exit_of = [&](Index t, Index entry) {
    for (Index f = 4 * t; f < 4 * t + 4; ++f)
      if (links[f] && f != entry) return f;
    return kNone;
  };
  const auto send = [&](Index vertex, std::size_t slot) {
    out.vertices.push_back(vertex);
    out.replaced.push_back(static_cast<std::uint8_t>(slot));
  };
  for (Index start = 0; start < graph.tetra_count(); ++start) {
    const auto degree = std::ranges::count(links.subspan(std::size_t{4} * start, 4), 1);
    if (done[start] || degree > 1) continue;
    Tetra window;
    std::copy_n(tetrahedra.begin() + 4 * std::ptrdiff_t{start}, 4, window.begin());
    for (const Index v : window) send(v, 0);
    Index last = start;
    for (Index exit = exit_of(start, kNone); exit != kNone;) {
      const Index entry = graph.opposite[exit];
      auto* const gone = std::ranges::find(window, tetrahedra[exit]);
      const auto slot = static_cast<std::size_t>(gone - window.begin()) + 1;
      std::copy(gone + 1, window.end(), gone);
      window[3] = tetrahedra[entry];
      send(window[3], slot);
      last = entry / 4;
      exit = exit_of(last, entry);
    }
    done[last] = true;
  }
  return out;
}

std::string find_tetra_strip_fault(std::span<const Index> tetrahedra, const TetraStrips& strips) {
  if (!are_whole(strips)) return "a strip is cut short or a place is none of four";
  std::vector<Oriented> expected, found;
  for (std::size_t i = 0; i < tetrahedra.size(); i += 4)
    expected.push_back(
        oriented({tetrahedra[i], tetrahedra[i + 1], tetrahedra[i + 2], tetrahedra[i + 3]}));
  for_each_tetra(strips, [&](const Tetra& tetra, bool) { found.push_back(oriented(tetra)); });
  std::ranges::sort(expected);
  std::ranges::sort(found);
  if (expected == found) return {};
  const auto vertices_of = [](const Oriented& o) { return o.vertices; };
  if (std::ranges::equal(expected, found, {}, vertices_of, vertices_of))
    return "a tetrahedron is turned over";
  if (std::ranges::includes(found, expected)) return "a tetrahedron is there too often";
  return "a tetrahedron is missing";
}

TetraStripStats tetra_strip_stats(const TetraStrips& strips) {
  TetraStripStats out;
  std::uint64_t length = 0;
  const auto count_strip = [&] {
    out.singletons += length == 1;
    out.longest = std::max(out.longest, length);
  };
  for_each_tetra(strips, [&](const Tetra&, bool is_first) {
    if (is_first) {
      count_strip();
      length = 0;
      ++out.strips;
    }
    ++length;
    ++out.tetrahedra;
  });
  count_strip();
  out.entries = strips.vertices.size();
  out.in_sequence = static_cast<std::uint64_t>(std::ranges::count(strips.replaced, 1));
  return out;
}

}  // namespace pstrips::inline codecs
