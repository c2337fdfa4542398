#include "formats/pstrip/container/header.h"

#include <algorithm>
#include <iterator>

#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {

std::uint64_t decoder_memory(std::span<const ProgressiveMesh> meshes, std::uint64_t largest_chunk) {
  std::uint64_t bytes = largest_chunk;
  for (const ProgressiveMesh& mesh : meshes) {
    std::uint64_t wedge_bytes = mesh.single_wedges ? 0 : sizeof(Index);
    for (const Attribute& a : mesh.wedge_attributes) wedge_bytes += a.element_bytes();
    // The index map twice: as stored and resolved.
    bytes += mesh.vertices * mesh.position.element_bytes() + mesh.wedges * wedge_bytes +
             sum_of_group_entries(mesh) * 2 * sizeof(Index);
  }
  return bytes;
}

std::uint8_t conformance_level(const FileHeader& header) {
  struct Bounds {
    std::uint64_t vertices, wedges, map_entries, memory;
  };
  constexpr Bounds kLevels[] = {{1u << 16, 1u << 17, 1u << 19, 1u << 24},
                                {1u << 20, 1u << 21, 1u << 23, 1u << 28},
                                {1u << 24, 1u << 25, 1u << 27, 1ull << 32}};
  const auto admits = [&](const Bounds& b) {
    return header.vertices <= b.vertices && header.wedges <= b.wedges &&
           header.map_entries <= b.map_entries && header.decoder_memory <= b.memory;
  };
  return static_cast<std::uint8_t>(std::ranges::find_if(kLevels, admits) - std::begin(kLevels));
}

}  // namespace pstrips::inline formats
