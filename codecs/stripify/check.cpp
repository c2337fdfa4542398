#include "codecs/stripify/check.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/strips.h"

namespace pstrips::inline codecs {
namespace {

using Triangle = std::array<Index, 3>;

Triangle lowest_first(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

struct Found {
  std::string fault;
  std::vector<std::pair<Index, Triangle>> triangles;  // with their groups
};

// `group` has one for each triangle there should be, ascending: groups come in that order, so the
// number of triangles before one gives its group.
Found decode(std::span<const Index> strips, std::span<const Index> group, Index wedge_count) {
  Found out;
  const auto fault = [&](const char* what) {
    out.fault = what;
    return out;
  };
  if (!strips.empty() && strips.back() == kRestart) return fault("ends with a restart");
  std::vector<Index> strip;
  for (std::size_t i = 0; i <= strips.size() && !strips.empty(); ++i) {
    if (i < strips.size() && strips[i] != kRestart) {
      if (strips[i] >= wedge_count) return fault("has an entry that is no wedge");
      strip.push_back(strips[i]);
      continue;
    }
    const std::size_t first = out.triangles.size();
    for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
      Triangle triangle{strip[k], strip[k + 1], strip[k + 2]};
      if (k % 2 == 1) std::swap(triangle[0], triangle[1]);
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2])
        continue;
      if (out.triangles.size() == group.size()) return fault("has too many triangles");
      if (group[out.triangles.size()] != group[first]) return fault("has a strip across groups");
      out.triangles.push_back({group[first], lowest_first(triangle)});
    }
    if (out.triangles.size() == first) return fault("has a strip without a triangle");
    strip.clear();
  }
  if (out.triangles.size() < group.size()) return fault("has too few triangles");
  return out;
}

// From wedge to wedge, within a group.
using Edge = std::array<Index, 3>;

// The edges, one of a pair taken away for each that runs the other way.
std::vector<Edge> without_pairs(std::vector<Edge> edges) {
  const auto low_first = [](const Edge& e) {
    return Edge{e[0], std::min(e[1], e[2]), std::max(e[1], e[2])};
  };
  std::ranges::sort(edges, [&](const Edge& a, const Edge& b) {
    const Edge x = low_first(a), y = low_first(b);
    return x != y ? x < y : a < b;
  });
  std::vector<Edge> out;
  for (std::size_t i = 0, end; i < edges.size(); i = end) {
    for (end = i; end < edges.size() && low_first(edges[end]) == low_first(edges[i]);) ++end;
    const auto rising =
        static_cast<std::size_t>(std::count_if(edges.begin() + static_cast<std::ptrdiff_t>(i),
                                               edges.begin() + static_cast<std::ptrdiff_t>(end),
                                               [](const Edge& e) { return e[1] < e[2]; }));
    const std::size_t falling = end - i - rising;  // sorted last
    if (rising > falling) out.insert(out.end(), rising - falling, edges[i]);
    if (falling > rising) out.insert(out.end(), falling - rising, edges[end - 1]);
  }
  return out;
}

}  // namespace

std::string find_strip_fault(const StripInput& input, std::span<const Index> strips) {
  const std::size_t count = input.triangles.size() / 3;
  std::vector<Index> group(input.group.begin(), input.group.end());
  group.resize(count);
  std::vector<std::pair<Index, Triangle>> expected(count);
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = input.triangles[3 * t + k];
    expected[t] = {group[t], lowest_first(triangle)};
  }
  std::ranges::sort(expected);
  std::ranges::sort(group);
  Found found = decode(strips, group, input.wedge_count);
  if (!found.fault.empty()) return found.fault;
  std::ranges::sort(found.triangles);
  return found.triangles == expected ? "" : "has other triangles or windings";
}

std::string find_polygon_strip_fault(const PolygonInput& input, std::span<const Index> strips) {
  std::vector<Index> group;
  std::vector<Edge> expected, found;
  for (std::size_t f = 0; f + 1 < input.face_first.size(); ++f) {
    const Index g = input.group.empty() ? 0 : input.group[f];
    const auto face =
        input.corners.subspan(input.face_first[f], input.face_first[f + 1] - input.face_first[f]);
    group.insert(group.end(), face.size() - 2, g);
    for (std::size_t k = 0; k < face.size(); ++k)
      expected.push_back({g, face[k], face[(k + 1) % face.size()]});
  }
  std::ranges::sort(group);
  const Found decoded = decode(strips, group, input.wedge_count);
  if (!decoded.fault.empty()) return decoded.fault;
  for (const auto& [g, triangle] : decoded.triangles)
    for (std::size_t k = 0; k < 3; ++k) found.push_back({g, triangle[k], triangle[(k + 1) % 3]});
  return without_pairs(std::move(found)) == without_pairs(std::move(expected))
             ? ""
             : "has other faces or windings";
}

}  // namespace pstrips::inline codecs
