#include "codecs/stripify/check.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/strips.h"

namespace pstrip {
namespace {

using Triangle = std::array<Index, 3>;

Triangle lowest_first(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

}  // namespace

std::string find_strip_fault(const StripInput& input, std::span<const Index> strips) {
  const std::size_t count = input.triangles.size() / 3;
  std::vector<Index> group(input.group.begin(), input.group.end());
  group.resize(count);
  std::vector<std::pair<Index, Triangle>> expected(count), found;
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = input.triangles[3 * t + k];
    expected[t] = {group[t], lowest_first(triangle)};
  }
  std::ranges::sort(expected);
  std::ranges::sort(group);

  if (!strips.empty() && strips.back() == kRestart) return "ends with a restart";
  std::vector<Index> strip;
  for (std::size_t i = 0; i <= strips.size() && !strips.empty(); ++i) {
    if (i < strips.size() && strips[i] != kRestart) {
      if (strips[i] >= input.wedge_count) return "has an entry that is no wedge";
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
      if (found.size() == count) return "has too many triangles";
      if (group[found.size()] != group[first]) return "has a strip across groups";
      found.push_back({group[first], lowest_first(triangle)});
    }
    if (found.size() == first) return "has a strip without a triangle";
    strip.clear();
  }
  if (found.size() < count) return "has too few triangles";
  std::ranges::sort(found);
  if (found != expected) return "has other triangles or windings";
  return {};
}

}  // namespace pstrip
