#include "converters/packets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pstrips::inline converters {
namespace {

float blurred(float bound, double blur) {
  constexpr float kMost = std::numeric_limits<float>::max();
  if (blur == 0 || bound == kMost) return bound;
  const float sum = bound + static_cast<float>(blur);
  return std::min(kMost, std::nextafter(sum, kMost));
}

}  // namespace

std::vector<Packet> packets_of(const Recording& recording, std::span<const ErrorBounds> bounds,
                               Index mesh, const PacketCut& cut) {
  const auto all = static_cast<Index>(recording.mesh.vsplits.size());
  const auto packet_at = [&](Index first, Index vsplits) {
    const Index done = first + vsplits;
    const LevelCounts& level = recording.levels[done];
    const std::size_t collapses = bounds.size() - 1;
    const ErrorBounds& bound = bounds[collapses - std::min<std::size_t>(collapses, done)];
    const double blur = done == all ? 0 : cut.blur;
    return Packet{.mesh = mesh,
                  .first_vsplit = first,
                  .vsplits = vsplits,
                  .vertices = recording.mesh.base_vertices + done,
                  .triangles = level.triangles,
                  .strips = level.strips,
                  .error = blurred(bound.two_sided, blur),
                  .one_sided_error = blurred(bound.one_sided, blur)};
  };
  std::vector<Packet> out{packet_at(0, 0)};
  Index first = 0;
  for (const Index batch : cut.batches) {
    out.push_back(packet_at(first, batch));
    first += batch;
  }
  while (first < all) {
    const double wanted = cut.growth * (recording.mesh.base_vertices + first);
    Index size = std::max(cut.least, static_cast<Index>(wanted));
    if (all - first < size + size / 2) size = all - first;  // no dwarf at the end
    out.push_back(packet_at(first, size));
    first += size;
  }
  return out;
}

}  // namespace pstrips::inline converters
