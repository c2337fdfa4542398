#include "codecs/stripify/stats.h"

#include <algorithm>
#include <vector>

#include "core/strips.h"

namespace pstrips::inline codecs {
namespace {

// Calls visit(strip) for each run between restarts.
template <class Visit>
void for_each_strip(std::span<const Index> strips, Visit&& visit) {
  while (!strips.empty()) {
    const auto restart = std::find(strips.begin(), strips.end(), kRestart);
    const auto length = static_cast<std::size_t>(restart - strips.begin());
    visit(strips.first(length));
    strips = strips.subspan(std::min(length + 1, strips.size()));
  }
}

std::uint64_t triangles_in(std::span<const Index> strip) {
  std::uint64_t count = 0;
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const Index a = strip[i - 2], b = strip[i - 1], c = strip[i];
    count += a != b && b != c && a != c;
  }
  return count;
}

}  // namespace

StripStats strip_stats(std::span<const Index> strips) {
  StripStats stats;
  for_each_strip(strips, [&](std::span<const Index> strip) {
    const std::uint64_t triangles = triangles_in(strip);
    stats.triangles += triangles;
    stats.strips += 1;
    stats.singletons += triangles == 1;
    stats.entries += strip.size();
    stats.swaps += strip.size() - std::min<std::uint64_t>(strip.size(), triangles + 2);
  });
  stats.indices_sent = strips.size();
  stats.acmr16 = cache_misses_per_triangle(strips, 16);
  return stats;
}

double cache_misses_per_triangle(std::span<const Index> strips, std::uint32_t cache_entries) {
  Index wedges = 0;
  std::uint64_t triangles = 0;
  for_each_strip(strips, [&](std::span<const Index> strip) {
    for (const Index wedge : strip) wedges = std::max(wedges, wedge + 1);
    triangles += triangles_in(strip);
  });
  // A wedge is cached while fewer than `cache_entries` loads came after its own.
  std::vector<std::uint64_t> loaded(wedges);
  std::uint64_t loads = 0;
  for (const Index entry : strips) {
    if (entry == kRestart) continue;
    if (loaded[entry] != 0 && loads - loaded[entry] < cache_entries) continue;
    loaded[entry] = ++loads;
  }
  return triangles == 0 ? 0 : static_cast<double>(loads) / static_cast<double>(triangles);
}

}  // namespace pstrips::inline codecs
