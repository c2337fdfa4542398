#include "formats/pstrip/payload/compact/fine.h"

#include <algorithm>
#include <cstring>

namespace pstrips::inline formats {
namespace {

/// Where the last position of each vertex stands: where it was born, or what the last split of it
/// left.
class LastPositions {
 public:
  explicit LastPositions(const ProgressiveMesh& mesh) {
    if (mesh.placement != Placement::optimal) return;
    last_split_.assign(mesh.position.elements(), kNone);
    for (Index i = 0; i < mesh.vsplits.size(); ++i)
      if (const Index parent = mesh.vsplits[i].parent; parent != mesh.base_vertices + i)
        last_split_[parent] = i;
  }

  /// Calls visit(bytes of the first component) for each vertex.
  template <class Mesh, class Visit>
  void for_each(Mesh& mesh, Visit&& visit) const {
    const std::size_t size = mesh.position.element_bytes();
    for (std::size_t v = 0; v < mesh.position.elements(); ++v) {
      const bool moved = !last_split_.empty() && last_split_[v] != kNone;
      auto* const at = moved ? mesh.parent_position.data() + last_split_[v] * size
                             : mesh.position.data.data() + v * size;
      visit(at);
    }
  }

 private:
  std::vector<Index> last_split_;  // of each vertex; empty: none moves
};

/// Calls visit(cells, first byte) for each component that has bits below its cell.
template <class Mesh, class Visit>
void for_each_number(Mesh& mesh, const MeshCells& cells, Visit&& visit) {
  if (const auto& of_positions = cells.positions.cells(); of_positions && !of_positions->exact())
    LastPositions(mesh).for_each(mesh, [&](auto* at) {
      for (std::size_t c = 0; c < mesh.position.count; ++c)
        visit(*of_positions, at + c * size_of(mesh.position.type));
    });
  for (std::size_t a = 0; a < mesh.wedge_attributes.size(); ++a) {
    auto& attribute = mesh.wedge_attributes[a];
    const Cells& of_attribute = cells.attributes[a].own();
    if (of_attribute.exact()) continue;
    const std::size_t size = size_of(attribute.type);
    for (std::size_t at = 0; at + size <= attribute.data.size(); at += size)
      visit(of_attribute, attribute.data.data() + at);
  }
}

std::uint64_t component_at(const Cells& cells, const std::byte* at) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, at, size_of(cells.type()));
  return bits;
}

std::uint64_t bits_below(const ProgressiveMesh& mesh, const MeshCells& cells) {
  std::uint64_t bits = 0;
  for_each_number(mesh, cells, [&](const Cells& of, const std::byte* at) {
    bits += of.low_bits(of.cell_of(component_at(of, at)));
  });
  return bits;
}

}  // namespace

MeshCells cells_of(const ProgressiveMesh& mesh) {
  constexpr unsigned kAttributeBits = 12;
  MeshCells cells{PositionCells(mesh.grid, mesh.position.type), {}};
  for (const Attribute& a : mesh.wedge_attributes)
    cells.attributes.push_back(AttributeCells::choose(a, kAttributeBits));
  return cells;
}

bool is_exact(const MeshCells& cells) {
  const auto& of_positions = cells.positions.cells();
  return (!of_positions || of_positions->exact()) &&
         std::ranges::all_of(cells.attributes, &AttributeCells::exact);
}

std::uint64_t fine_bytes(const ProgressiveMesh& mesh, const MeshCells& cells) {
  return (bits_below(mesh, cells) + 7) / 8;
}

void write_fine(const ProgressiveMesh& mesh, const MeshCells& cells, std::span<std::byte> out) {
  std::uint64_t window = 0;
  unsigned filled = 0;
  std::size_t next = 0;
  // At most 32 bits at a time, so that the window never overflows.
  const auto put = [&](std::uint64_t value, unsigned bits) {
    window |= value << filled;
    for (filled += bits; filled >= 8; filled -= 8, window >>= 8)
      out[next++] = static_cast<std::byte>(window & 0xff);
  };
  for_each_number(mesh, cells, [&](const Cells& of, const std::byte* at) {
    const std::uint64_t number = component_at(of, at);
    const unsigned bits = of.low_bits(of.cell_of(number));
    const std::uint64_t low = of.low_of(number);
    put(low & 0xffff'ffff, std::min(bits, 32u));
    if (bits > 32) put(low >> 32, bits - 32);
  });
  if (filled > 0) out[next] = static_cast<std::byte>(window);
}

bool read_fine(ByteView bytes, const MeshCells& cells, ProgressiveMesh& mesh) {
  const std::uint64_t bits = bits_below(mesh, cells);
  if (bytes.size() != (bits + 7) / 8) return false;
  if (bits % 8 != 0 && std::to_integer<unsigned>(bytes.back()) >> bits % 8 != 0) return false;
  std::uint64_t window = 0;
  unsigned filled = 0;
  std::size_t next = 0;
  const auto take = [&](unsigned wanted) {
    for (; filled < wanted; filled += 8)
      window |= std::to_integer<std::uint64_t>(bytes[next++]) << filled;
    const std::uint64_t value = window & ((std::uint64_t{1} << wanted) - 1);
    window >>= wanted;
    filled -= wanted;
    return value;
  };
  for_each_number(mesh, cells, [&](const Cells& of, std::byte* at) {
    const std::int32_t cell = of.cell_of(component_at(of, at));
    const unsigned width = of.low_bits(cell);
    std::uint64_t low = take(std::min(width, 32u));
    if (width > 32) low |= take(width - 32) << 32;
    const std::uint64_t number = of.component(cell, low);
    std::memcpy(at, &number, size_of(of.type()));
  });
  return true;
}

}  // namespace pstrips::inline formats
