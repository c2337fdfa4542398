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
constexpr double kMemory = 1 << 30;
// In the order of pstrips::ErrorCode.
constexpr const char* kCodes[] = {"bad argument", "io",          "truncated",  "corrupt",
                                  "over limit",   "unsupported", "interrupted"};

void print(const char* name, std::span<const std::uint32_t> numbers) {
  std::fputs(name, stdout);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::printf("%s%u", i > 0 ? " " : "", static_cast<unsigned>(numbers[i]));
  std::fputs("\n", stdout);
}

void print_level(const PstripsViewer* viewer) {
  std::printf("packets %u\n", static_cast<unsigned>(pstrips_packets(viewer)));
  for (std::uint32_t i = 0; i < pstrips_meshes(viewer); ++i) {
    const PstripsMesh& mesh = *pstrips_mesh(viewer, i);
    std::vector<std::uint32_t> numbers(std::size_t{3} * mesh.wedges);
    std::transform(mesh.positions, mesh.positions + numbers.size(), numbers.begin(),
                   [](float x) { return std::bit_cast<std::uint32_t>(x); });
    print("positions ", numbers);
    print("triangles ", {mesh.triangle_list, std::size_t{3} * mesh.triangles});
    numbers.resize(mesh.groups);
    for (std::size_t g = 0; g < mesh.groups; ++g)
      numbers[g] = mesh.group_first[g + 1] - mesh.group_first[g];
    print("groups ", numbers);
    print("strips ", {mesh.strips, mesh.strip_entries});
  }
}

void print_end(PstripsViewer* viewer) {
  const int code = pstrips_error_code(viewer);
  if (code < 0)
    std::printf("end \n");
  else
    std::printf("end %s %.0f %s\n", kCodes[code], pstrips_error_offset(viewer),
                pstrips_error(viewer));
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    const std::vector<char> file(std::istreambuf_iterator<char>(in), {});
    const std::span<const std::byte> bytes = std::as_bytes(std::span(file));
    PstripsViewer* viewer = pstrips_open(kMemory, 1);
    for (std::size_t at = 0; at < bytes.size(); at += kSlice) {
      const std::size_t size = std::min(kSlice, bytes.size() - at);
      if (pstrips_feed(viewer, bytes.data() + at, size) != 0) break;
      if (pstrips_update(viewer) != 0) print_level(viewer);
    }
    print_end(viewer);
    pstrips_close(viewer);
  }
}
