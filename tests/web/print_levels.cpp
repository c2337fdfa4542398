// Feeds files in slices to the decoder and prints each level, positions as bits; print_levels.mjs
// does the same in WebAssembly. Linked with nothing but the decoder.

#include <algorithm>
#include <bit>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "web/decoder.h"

namespace {

constexpr std::size_t kSlice = 100;

void print(const char* name, std::span<const std::uint32_t> numbers) {
  std::fputs(name, stdout);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::printf("%s%u", i > 0 ? " " : "", static_cast<unsigned>(numbers[i]));
  std::fputs("\n", stdout);
}

void print_level(PstripsViewer* viewer) {
  std::printf("packets %u\n", static_cast<unsigned>(pstrips_packets(viewer)));
  for (std::uint32_t mesh = 0; mesh < pstrips_meshes(viewer); ++mesh) {
    const float* positions = pstrips_positions(viewer, mesh);
    std::vector<std::uint32_t> bits(std::size_t{3} * pstrips_vertex_count(viewer, mesh));
    std::transform(positions, positions + bits.size(), bits.begin(),
                   [](float x) { return std::bit_cast<std::uint32_t>(x); });
    print("positions ", bits);
    const std::uint32_t* strips = pstrips_strips(viewer, mesh);
    print("strips ", {strips, pstrips_entries(viewer)});
    const std::uint32_t* triangles = pstrips_triangles(viewer, mesh);
    print("triangles ", {triangles, pstrips_entries(viewer)});
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    const std::vector<char> file(std::istreambuf_iterator<char>(in), {});
    const std::span<const std::byte> bytes = std::as_bytes(std::span(file));
    PstripsViewer* viewer = pstrips_open();
    for (std::size_t at = 0; at < bytes.size(); at += kSlice) {
      const std::size_t size = std::min(kSlice, bytes.size() - at);
      if (pstrips_feed(viewer, bytes.data() + at, size) != 0) break;
      if (pstrips_update(viewer) != 0) print_level(viewer);
    }
    std::printf("end %s\n", pstrips_error(viewer));
    pstrips_close(viewer);
  }
}
