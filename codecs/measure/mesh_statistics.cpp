#include "codecs/measure/mesh_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/group_by.h"
#include "core/parallel.h"

namespace pstrips::inline codecs {
namespace {

constexpr MeshStatisticKind kKinds[] = {
    {&MeshStatistics::non_manifold_edges, "non-manifold edges", "kept; simplified like borders"},
    {&MeshStatistics::non_manifold_vertices, "non-manifold vertices", "kept"},
    {&MeshStatistics::duplicate_faces, "duplicate faces", "kept, each of them"},
    {&MeshStatistics::degenerate_faces, "degenerate faces", "kept, in the full model only"},
    {&MeshStatistics::isolated_vertices, "isolated vertices", "kept, not collapsed"},
    {&MeshStatistics::non_finite_vertices, "non-finite vertices",
     "kept bit for bit, not collapsed"},
    {&MeshStatistics::other_faces, "other faces than triangles",
     "kept, triangulated in the levels"},
    {&MeshStatistics::components, "components", "simplified together"},
};

// Disjoint sets of numbers; the least number stands for its set.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

// The finalizer of splitmix64 [Steele14]: sums of such numbers hardly ever agree by chance.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

class StatisticsCounter {
 public:
  explicit StatisticsCounter(const Mesh& mesh) : mesh_(mesh) {}

  MeshStatistics run(unsigned threads) {
    look_at_faces();
    list_corners();
    constexpr std::size_t kGrain = 1 << 14;
    std::vector<MeshStatistics> parts((mesh_.vertex_count() + kGrain - 1) / kGrain);
    parallel_for(threads, mesh_.vertex_count(), kGrain, [&](std::size_t begin, std::size_t end) {
      VertexCounter vertices(*this);
      for (std::size_t v = begin; v < end; ++v) vertices.look_at(static_cast<Index>(v));
      parts[begin / kGrain] = vertices.found;
    });
    for (const MeshStatistics& part : parts) out_ += part;
    return out_;
  }

 private:
  Index vertex_at(Index corner) const { return mesh_.vertex_of(mesh_.corners[corner]); }
  Index first_corner(Index face) const {
    return static_cast<Index>(mesh_.face(face).data() - mesh_.corners.data());
  }
  Index face_of(Index corner) const {
    return corner_face_.empty() ? corner / 3 : corner_face_[corner];
  }
  bool is_polygon(Index face) const {
    return mesh_.groups[mesh_.group_of(face)].kind == FaceKind::polygons &&
           mesh_.face(face).size() >= 3;
  }
  std::span<const Index> polygons_at(Index vertex) const { return corners_by_vertex_[vertex]; }

  bool names_a_vertex_twice(Index face) {
    const Index first = first_corner(face), n = static_cast<Index>(mesh_.face(face).size());
    if (n == 3) {
      const Index a = vertex_at(first), b = vertex_at(first + 1), c = vertex_at(first + 2);
      return a == b || b == c || a == c;
    }
    sorted_.clear();
    for (Index c = first; c < first + n; ++c) sorted_.push_back(vertex_at(c));
    std::ranges::sort(sorted_);
    return std::ranges::adjacent_find(sorted_) != sorted_.end();
  }

  void look_at_faces() {
    Sets connected(mesh_.vertex_count());
    std::vector<bool> is_used(mesh_.vertex_count());
    is_degenerate_.resize(mesh_.face_count());
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Index first = first_corner(f), n = static_cast<Index>(mesh_.face(f).size());
      for (Index c = first; c < first + n; ++c) {
        connected.join(vertex_at(first), vertex_at(c));
        is_used[vertex_at(c)] = true;
      }
      if (!is_polygon(f) || n != 3) ++out_.other_faces;
      if (!is_polygon(f) || !names_a_vertex_twice(f)) continue;
      is_degenerate_[f] = true;
      ++out_.degenerate_faces;
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (!is_used[v]) ++out_.isolated_vertices;
      if (is_used[v] && connected.find(v) == v) ++out_.components;
    }
  }

  // Of every vertex the corners of polygons; of a degenerate polygon one corner alone.
  void list_corners() {
    if (!mesh_.face_first.empty()) {
      corner_face_.resize(mesh_.corners.size());
      for (Index f = 0; f < mesh_.face_count(); ++f)
        std::fill_n(corner_face_.begin() + first_corner(f), mesh_.face(f).size(), f);
    }
    is_lowest_.resize(mesh_.corners.size());
    corners_by_vertex_ = group_each<Index>(mesh_.vertex_count(), [&](auto&& visit) {
      for_each_listed([&](Index corner) { visit(vertex_at(corner), [&] { return corner; }); });
    });
  }

  template <class Take>
  void for_each_listed(Take&& take) {
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (!is_polygon(f)) continue;
      const Index first = first_corner(f), n = static_cast<Index>(mesh_.face(f).size());
      Index lowest = first;
      for (Index c = first + 1; c < first + n; ++c)
        if (vertex_at(c) < vertex_at(lowest)) lowest = c;
      is_lowest_[lowest] = true;
      if (is_degenerate_[f]) {
        take(lowest);
        continue;
      }
      for (Index c = first; c < first + n; ++c) take(c);
    }
  }

  // Looks at one vertex at a time, and what is around it.
  class VertexCounter {
   public:
    explicit VertexCounter(const StatisticsCounter& all) : all_(all), mesh_(all.mesh_) {}

    void look_at(Index vertex) {
      const std::size_t axes = std::min<std::size_t>(mesh_.position.count, 3);
      bool finite = true;
      for (std::size_t axis = 0; axis < axes; ++axis)
        finite &= std::isfinite(component(mesh_.position, vertex, axis));
      if (!finite) ++found.non_finite_vertices;
      look_at_fans(vertex);
      look_for_duplicates(vertex);
    }

    MeshStatistics found;

   private:
    // The vertices before and after this one in each polygon around it: fans are what these pairs
    // join.
    void look_at_fans(Index vertex) {
      sides_.clear();
      for (const Index corner : all_.polygons_at(vertex)) {
        const Index face = all_.face_of(corner);
        if (all_.is_degenerate_[face]) continue;
        const Index first = all_.first_corner(face),
                    last = first + static_cast<Index>(mesh_.face(face).size()) - 1;
        sides_.push_back(all_.vertex_at(corner == first ? last : corner - 1));
        sides_.push_back(all_.vertex_at(corner == last ? first : corner + 1));
      }
      number_neighbours();
      std::size_t fans = neighbours_.size();
      parent_.resize(neighbours_.size());
      std::iota(parent_.begin(), parent_.end(), Index{0});
      degree_.assign(neighbours_.size(), 0);
      for (std::size_t i = 0; i < sides_.size(); i += 2) {
        ++degree_[sides_[i]];
        ++degree_[sides_[i + 1]];
        const Index a = root(sides_[i]), b = root(sides_[i + 1]);
        if (a == b) continue;
        parent_[a] = b;
        --fans;
      }
      if (fans > 1) ++found.non_manifold_vertices;
      for (std::size_t n = 0; n < neighbours_.size(); ++n)
        if (degree_[n] > 2 && vertex < neighbours_[n]) ++found.non_manifold_edges;
    }

    // Replaces the vertices in sides_ by their places in neighbours_.
    void number_neighbours() {
      neighbours_.clear();
      constexpr std::size_t kFew = 64;
      if (sides_.size() > kFew) {
        neighbours_ = sides_;
        std::ranges::sort(neighbours_);
        neighbours_.erase(std::ranges::unique(neighbours_).begin(), neighbours_.end());
        for (Index& side : sides_)
          side =
              static_cast<Index>(std::ranges::lower_bound(neighbours_, side) - neighbours_.begin());
        return;
      }
      for (Index& side : sides_) {
        const auto at = std::ranges::find(neighbours_, side);
        const auto place = static_cast<Index>(at - neighbours_.begin());
        if (at == neighbours_.end()) neighbours_.push_back(side);
        side = place;
      }
    }

    Index root(Index i) {
      while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
      return i;
    }

    // Among the polygons whose lowest vertex this is.
    void look_for_duplicates(Index vertex) {
      sums_.clear();
      for (const Index corner : all_.polygons_at(vertex)) {
        if (!all_.is_lowest_[corner]) continue;
        const Index face = all_.face_of(corner);
        std::uint64_t sum = 0;
        for (const Index wedge : mesh_.face(face)) sum += mixed(mesh_.vertex_of(wedge));
        sums_.push_back({sum, face});
      }
      if (sums_.size() < 2) return;
      std::ranges::sort(sums_);
      for (std::size_t i = 0, end = 0; i < sums_.size(); i = end) {
        for (end = i + 1; end < sums_.size() && sums_[end].first == sums_[i].first;) ++end;
        if (end - i > 1) compare(std::span(sums_).subspan(i, end - i));
      }
    }

    void compare(std::span<const std::pair<std::uint64_t, Index>> faces) {
      std::vector<std::vector<Index>> loops;
      for (const auto& [sum, face] : faces) {
        std::vector<Index>& loop = loops.emplace_back();
        for (const Index wedge : mesh_.face(face)) loop.push_back(mesh_.vertex_of(wedge));
        std::ranges::sort(loop);
      }
      std::ranges::sort(loops);
      for (std::size_t i = 1; i < loops.size(); ++i)
        if (loops[i - 1] == loops[i]) ++found.duplicate_faces;
    }

    const StatisticsCounter& all_;
    const Mesh& mesh_;
    std::vector<Index> sides_, neighbours_, parent_, degree_;
    std::vector<std::pair<std::uint64_t, Index>> sums_;  // of the vertices of a face
  };

  const Mesh& mesh_;
  std::vector<bool> is_degenerate_;  // faces
  std::vector<bool> is_lowest_;      // corners: of the polygon's, the first at its lowest vertex
  std::vector<Index> corner_face_;   // empty: triangles
  Grouped<Index> corners_by_vertex_;
  std::vector<Index> sorted_;
  MeshStatistics out_;
};

}  // namespace

MeshStatistics& MeshStatistics::operator+=(const MeshStatistics& other) {
  for (const MeshStatisticKind& kind : kKinds) this->*kind.count += other.*kind.count;
  return *this;
}

std::span<const MeshStatisticKind> mesh_statistic_kinds() { return kKinds; }

MeshStatistics mesh_statistics(const Mesh& mesh, unsigned threads) {
  return StatisticsCounter(mesh).run(threads);
}

}  // namespace pstrips::inline codecs
