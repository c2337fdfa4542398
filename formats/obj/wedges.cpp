#include "formats/obj/wedges.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/group_by.h"

namespace pstrips::inline formats::obj {
namespace {

/// Builds the wedges of one vertex after the other.
class WedgeBuilder {
 public:
  explicit WedgeBuilder(const CornerTuples& in) : in_(in) {
    out_.corners.resize(in.corner_vertex.size());
  }

  WedgeTable build() && {
    if (in_.corner_texcoord.empty() && in_.corner_normal.empty()) return one_wedge_each();
    const Grouped<Index> by_vertex = group_by(in_.vertex_count, in_.corner_vertex.size(),
                                              [&](Index c) { return in_.corner_vertex[c]; });
    for (Index v = 0; v < in_.vertex_count; ++v) {
      const std::span<const Index> corners = by_vertex[v];
      constexpr std::size_t kFew = 32;
      if (corners.empty())
        add_wedge(v, kNone, kNone, true);
      else if (corners.size() <= kFew)
        assign_by_scan(v, corners);
      else
        assign_by_sorting(v, corners);
    }
    return std::move(out_);
  }

 private:
  WedgeTable one_wedge_each() {
    out_.vertex.resize(in_.vertex_count);
    std::iota(out_.vertex.begin(), out_.vertex.end(), 0u);
    out_.texcoord.assign(in_.vertex_count, kNone);
    out_.normal.assign(in_.vertex_count, kNone);
    out_.cornerless.assign(in_.vertex_count, true);
    for (const Index v : in_.corner_vertex) out_.cornerless[v] = false;
    out_.corners.assign(in_.corner_vertex.begin(), in_.corner_vertex.end());
    return std::move(out_);
  }

  void assign_by_scan(Index v, std::span<const Index> corners) {
    const std::size_t first = out_.vertex.size();
    for (const Index c : corners) {
      const Index vt = texcoord(c), vn = normal(c);
      std::size_t w = first;
      while (w < out_.vertex.size() &&
             (!same_texcoord(out_.texcoord[w], vt) || !same_normal(out_.normal[w], vn)))
        ++w;
      if (w == out_.vertex.size()) add_wedge(v, vt, vn, false);
      out_.corners[c] = static_cast<Index>(w);
    }
  }

  /// For vertices with very many corners, of which a stranger may make any number.
  void assign_by_sorting(Index v, std::span<const Index> corners) {
    std::vector<Index> sorted(corners.begin(), corners.end());
    std::ranges::sort(sorted, [&](Index a, Index b) {
      const int order = compare(a, b);
      return order != 0 ? order < 0 : a < b;
    });
    for (std::size_t i = 0, leader = 0; i < sorted.size(); ++i) {
      if (compare(sorted[leader], sorted[i]) != 0) leader = i;
      out_.corners[sorted[i]] = sorted[leader];
    }
    for (const Index c : corners) {
      const Index leader = out_.corners[c];
      out_.corners[c] =
          leader == c ? add_wedge(v, texcoord(c), normal(c), false) : out_.corners[leader];
    }
  }

  int compare(Index a, Index b) const {
    const int order = compare_texcoord(texcoord(a), texcoord(b));
    return order != 0 ? order : compare_tuple(in_.normal, normal(a), normal(b));
  }
  static int compare_tuple(std::span<const double> values, Index a, Index b) {
    if (a == b) return 0;
    if (a == kNone || b == kNone) return a == kNone ? -1 : 1;
    return std::memcmp(&values[std::size_t{3} * a], &values[std::size_t{3} * b],
                       3 * sizeof(double));
  }
  int compare_texcoord(Index a, Index b) const {
    const int order = compare_tuple(in_.texcoord, a, b);
    if (order != 0 || a == b) return order;
    return int{in_.texcoord_flags[a]} - int{in_.texcoord_flags[b]};
  }
  bool same_texcoord(Index a, Index b) const { return compare_texcoord(a, b) == 0; }
  bool same_normal(Index a, Index b) const { return compare_tuple(in_.normal, a, b) == 0; }

  Index texcoord(Index corner) const {
    return in_.corner_texcoord.empty() ? kNone : in_.corner_texcoord[corner];
  }
  Index normal(Index corner) const {
    return in_.corner_normal.empty() ? kNone : in_.corner_normal[corner];
  }

  Index add_wedge(Index v, Index vt, Index vn, bool cornerless) {
    out_.vertex.push_back(v);
    out_.texcoord.push_back(vt);
    out_.normal.push_back(vn);
    out_.cornerless.push_back(cornerless);
    return static_cast<Index>(out_.vertex.size() - 1);
  }

  const CornerTuples& in_;
  WedgeTable out_;
};

}  // namespace

WedgeTable build_wedges(const CornerTuples& in) { return WedgeBuilder(in).build(); }

}  // namespace pstrips::inline formats::obj
