#include "codecs/measure/survey.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pstrip {
namespace {

constexpr SurveyKind kKinds[] = {
    {&Survey::non_manifold_edges, "non-manifold edges", "kept; simplified like borders"},
    {&Survey::non_manifold_vertices, "non-manifold vertices", "kept"},
    {&Survey::duplicate_faces, "duplicate faces", "kept, each of them"},
    {&Survey::degenerate_faces, "degenerate faces", "kept, in the full model only"},
    {&Survey::isolated_vertices, "isolated vertices", "kept, not collapsed"},
    {&Survey::non_finite_vertices, "non-finite vertices", "kept bit for bit, not collapsed"},
    {&Survey::other_faces, "other faces than triangles", "kept, triangulated in the levels"},
    {&Survey::components, "components", "simplified together"},
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

// Items in buckets, those of a bucket one after the other.
template <class Item>
class Buckets {
 public:
  /// Calls `each` twice with a function that takes a bucket's number and an item: to count and to
  /// fill.
  template <class Each>
  Buckets(std::size_t buckets, Each&& each) : end_(buckets + 1, 0) {
    each([&](Index bucket, const Item&) { ++end_[bucket + 1]; });
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    items_.resize(end_.back());
    // While they fill, end_[b] is where the next item goes; afterwards it is the bucket's end.
    each([&](Index bucket, const Item& item) { items_[end_[bucket]++] = item; });
  }
  std::span<Item> operator[](std::size_t bucket) {
    const std::uint64_t first = bucket == 0 ? 0 : end_[bucket - 1];
    return std::span(items_).subspan(first, end_[bucket] - first);
  }

 private:
  std::vector<std::uint64_t> end_;
  std::vector<Item> items_;
};

class Surveyor {
 public:
  explicit Surveyor(const Mesh& mesh) : mesh_(mesh), vertex_(mesh.corners.size()) {
    for (std::size_t c = 0; c < vertex_.size(); ++c) vertex_[c] = mesh.vertex_of(mesh.corners[c]);
  }

  Survey run() {
    look_at_vertices();
    look_at_faces();
    look_at_edges();
    look_for_duplicates();
    return out_;
  }

 private:
  bool is_polygon(Index face) const {
    return mesh_.groups[mesh_.group_of(face)].kind == FaceKind::polygons &&
           mesh_.face(face).size() >= 3;
  }
  Index first_corner(Index face) const {
    return static_cast<Index>(mesh_.face(face).data() - mesh_.corners.data());
  }

  void look_at_vertices() {
    const Attribute& position = mesh_.position;
    const std::size_t axes = std::min<std::size_t>(position.count, 3);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      bool finite = true;
      for (std::size_t axis = 0; axis < axes; ++axis)
        finite &= std::isfinite(component(position, v, axis));
      if (!finite) ++out_.non_finite_vertices;
    }
  }

  void look_at_faces() {
    Sets connected(mesh_.vertex_count());
    std::vector<bool> is_used(mesh_.vertex_count());
    is_degenerate_.resize(mesh_.face_count());
    std::vector<Index> sorted;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const auto loop = std::span(vertex_).subspan(first_corner(f), mesh_.face(f).size());
      for (const Index v : loop) {
        connected.join(loop[0], v);
        is_used[v] = true;
      }
      if (!is_polygon(f) || loop.size() != 3) ++out_.other_faces;
      if (!is_polygon(f)) continue;
      sorted.assign(loop.begin(), loop.end());
      std::ranges::sort(sorted);
      is_degenerate_[f] = std::ranges::adjacent_find(sorted) != sorted.end();
      if (is_degenerate_[f]) ++out_.degenerate_faces;
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (!is_used[v]) ++out_.isolated_vertices;
      if (is_used[v] && connected.find(v) == v) ++out_.components;
    }
  }

  struct Side {       // of a polygon, in the bucket of the lower vertex
    Index other;      // the higher vertex
    Index low, high;  // the polygon's corners at both
  };

  void look_at_edges() {
    const auto for_each_side = [&](auto&& take) {
      for (Index f = 0; f < mesh_.face_count(); ++f) {
        if (!is_polygon(f) || is_degenerate_[f]) continue;
        const Index first = first_corner(f), n = static_cast<Index>(mesh_.face(f).size());
        for (Index k = 0; k < n; ++k) {
          Index a = first + k, b = first + (k + 1 == n ? 0 : k + 1);
          if (vertex_[a] > vertex_[b]) std::swap(a, b);
          take(vertex_[a], Side{vertex_[b], a, b});
        }
      }
    };
    Buckets<Side> sides(mesh_.vertex_count(), for_each_side);
    Sets fans(vertex_.size());  // of corners
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const std::span<Side> at = sides[v];
      std::ranges::sort(at, {}, &Side::other);
      for (std::size_t i = 0, end = 0; i < at.size(); i = end) {
        for (end = i; end < at.size() && at[end].other == at[i].other; ++end) {
          fans.join(at[i].low, at[end].low);
          fans.join(at[i].high, at[end].high);
        }
        if (end - i > 2) ++out_.non_manifold_edges;
      }
    }
    count_fans(fans);
  }

  void count_fans(Sets& fans) {
    std::vector<std::uint8_t> count(mesh_.vertex_count(), 0);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (!is_polygon(f) || is_degenerate_[f]) continue;
      const Index first = first_corner(f);
      for (std::size_t c = first; c < first + mesh_.face(f).size(); ++c) {
        std::uint8_t& fans_here = count[vertex_[c]];
        if (fans.find(static_cast<Index>(c)) != c || fans_here == 2) continue;
        if (++fans_here == 2) ++out_.non_manifold_vertices;
      }
    }
  }

  // Uses up vertex_.
  void look_for_duplicates() {
    const auto loop_of = [&](Index f) {
      return std::span(vertex_).subspan(first_corner(f), mesh_.face(f).size());
    };
    for (Index f = 0; f < mesh_.face_count(); ++f) std::ranges::sort(loop_of(f));
    Buckets<Index> faces(mesh_.vertex_count(), [&](auto&& take) {
      for (Index f = 0; f < mesh_.face_count(); ++f)
        if (is_polygon(f)) take(loop_of(f)[0], f);
    });
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const std::span<Index> at = faces[v];
      std::ranges::sort(at, [&](Index a, Index b) {
        return std::ranges::lexicographical_compare(loop_of(a), loop_of(b));
      });
      for (std::size_t i = 1; i < at.size(); ++i)
        if (std::ranges::equal(loop_of(at[i - 1]), loop_of(at[i]))) ++out_.duplicate_faces;
    }
  }

  const Mesh& mesh_;
  std::vector<Index> vertex_;  // of each corner
  std::vector<bool> is_degenerate_;
  Survey out_;
};

}  // namespace

Survey& Survey::operator+=(const Survey& other) {
  for (const SurveyKind& kind : kKinds) this->*kind.count += other.*kind.count;
  return *this;
}

std::span<const SurveyKind> survey_kinds() { return kKinds; }

Survey survey(const Mesh& mesh) { return Surveyor(mesh).run(); }

}  // namespace pstrip
