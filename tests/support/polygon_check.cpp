#include "tests/support/polygon_check.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/strips.h"

namespace pstrips::test {
namespace {

using Triangle = std::array<Index, 3>;

Triangle lowest_first(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

using Placed = std::pair<Index, Triangle>;  // with its group

// The triangles that `strips` show, sorted; `group` is that of each triangle to come, sorted.
std::string decode(std::span<const Index> strips, Index wedge_count, std::span<const Index> group,
                   std::vector<Placed>& found) {
  if (!strips.empty() && strips.back() == kRestart) return "ends with a restart";
  std::vector<Index> strip;
  for (std::size_t i = 0; i <= strips.size() && !strips.empty(); ++i) {
    if (i < strips.size() && strips[i] != kRestart) {
      if (strips[i] >= wedge_count) return "has an entry that is no wedge";
      strip.push_back(strips[i]);
      continue;
    }
    // Groups come in ascending order, so how many triangles came before tells the group.
    const std::size_t first = found.size();
    for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
      Triangle triangle{strip[k], strip[k + 1], strip[k + 2]};
      if (k % 2 == 1) std::swap(triangle[0], triangle[1]);
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2])
        continue;
      if (found.size() == group.size()) return "has too many triangles";
      if (group[found.size()] != group[first]) return "has a strip across groups";
      found.push_back({group[first], lowest_first(triangle)});
    }
    if (found.size() == first) return "has a strip without a triangle";
    strip.clear();
  }
  if (found.size() < group.size()) return "has too few triangles";
  std::ranges::sort(found);
  return {};
}

// Shares triangles out among polygons. A face that can be made in one way only takes its triangles
// first; where all can be made in several, one is chosen and taken back if it leads nowhere.
class PolygonCover {
 public:
  PolygonCover(const PolygonInput& input, const std::vector<Placed>& found) : input_(input) {
    for (const Placed& t : found) {
      if (kinds_.empty() || kinds_.back() != t) {
        kinds_.push_back(t);
        left_.push_back(0);
      }
      ++left_.back();
    }
    for (std::size_t f = 0; f + 1 < input.face_first.size(); ++f) open_.push_back(f);
  }

  bool exists() {
    while (!open_.empty()) {
      const std::size_t before = open_.size();
      std::vector<std::size_t> still_open;
      for (const std::size_t f : open_) {
        const auto ways = ways_to_make(f);
        if (ways.empty()) return false;
        if (ways.size() > 1)
          still_open.push_back(f);
        else
          take(ways[0]);
      }
      open_ = std::move(still_open);
      if (open_.size() == before) return try_each_way();
    }
    return true;
  }

 private:
  using Way = std::vector<std::size_t>;  // places in kinds_

  bool try_each_way() {
    const std::size_t f = open_.back();
    open_.pop_back();
    for (const Way& way : ways_to_make(f)) {
      PolygonCover rest = *this;
      rest.take(way);
      if (rest.exists()) return true;
    }
    return false;
  }

  void take(const Way& way) {
    for (const std::size_t kind : way) --left_[kind];
  }

  // Two at most, which is as good as many.
  std::vector<Way> ways_to_make(std::size_t f) const {
    const std::size_t first = input_.face_first[f], end = input_.face_first[f + 1];
    return ways_between(f, first, end - 1);
  }

  // Of the part of a face between the corners i and j and the edge from j to i.
  std::vector<Way> ways_between(std::size_t f, std::size_t i, std::size_t j) const {
    if (j == i + 1) return {{}};
    std::vector<Way> out;
    for (std::size_t k = i + 1; k < j && out.size() < 2; ++k) {
      const std::size_t kind = find(f, {input_.corners[i], input_.corners[k], input_.corners[j]});
      if (kind == kinds_.size() || left_[kind] == 0) continue;
      const auto left = ways_between(f, i, k);
      if (left.empty()) continue;
      for (const Way& b : ways_between(f, k, j))
        for (const Way& a : left) {
          out.push_back(a);
          out.back().insert(out.back().end(), b.begin(), b.end());
          out.back().push_back(kind);
        }
    }
    if (out.size() > 2) out.resize(2);
    return out;
  }

  std::size_t find(std::size_t f, Triangle t) const {
    const Placed placed{input_.group.empty() ? 0 : input_.group[f], lowest_first(t)};
    const auto at = std::ranges::lower_bound(kinds_, placed);
    return at != kinds_.end() && *at == placed ? static_cast<std::size_t>(at - kinds_.begin())
                                               : kinds_.size();
  }

  const PolygonInput& input_;
  std::vector<Placed> kinds_;  // sorted
  std::vector<std::size_t> left_;
  std::vector<std::size_t> open_;  // faces that are not made yet
};

}  // namespace

std::string find_strip_fault(const PolygonInput& input, std::span<const Index> strips) {
  std::vector<Index> group;
  for (std::size_t f = 0; f + 1 < input.face_first.size(); ++f)
    group.insert(group.end(), input.face_first[f + 1] - input.face_first[f] - 2,
                 input.group.empty() ? 0 : input.group[f]);
  std::ranges::sort(group);
  std::vector<Placed> found;
  if (std::string fault = decode(strips, input.wedge_count, group, found); !fault.empty())
    return fault;
  if (!PolygonCover(input, found).exists()) return "has triangles that do not make up the faces";
  return {};
}

}  // namespace pstrips::test
