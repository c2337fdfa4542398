#include "formats/pstrip/payload/compact/attribute_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace pstrips::inline formats {
namespace {

constexpr double kUnit = 0x1p24;

// The point whose direction an element may be.
Octahedron::Point point_of(const Octahedron& octahedron, const Attribute& a, std::size_t element) {
  Octahedron::Vector direction{};
  for (unsigned k = 0; k < 3; ++k) {
    const double x = component(a, element, k) * kUnit;
    if (std::abs(x) <= 2 * kUnit) direction[k] = std::llround(x);
  }
  return octahedron.near(direction);
}

std::uint64_t float_bits(std::int64_t in_units) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(in_units) / static_cast<float>(kUnit));
}

bool is_direction(const AttributeCells& cells, const Attribute& a, std::size_t element) {
  const Octahedron& octahedron = *cells.octahedron();
  const Octahedron::Vector unit = octahedron.unit(point_of(octahedron, a, element));
  for (unsigned k = 0; k < 3; ++k)
    if (float_bits(unit[k]) != bits_of(a, element, k)) return false;
  if (a.count == 3) return true;
  const std::uint64_t last = bits_of(a, element, 3);
  return cells.own().component(cells.own().cell_of(last), 0) == last;
}

}  // namespace

AttributeCells AttributeCells::choose(const Attribute& attribute, unsigned bits) {
  if (can_be_directions(attribute) && attribute.elements() > 0)
    for (unsigned n = Octahedron::kMinBits; n <= Octahedron::kMaxBits; ++n) {
      const AttributeCells out(Octahedron(n), attribute.count);
      std::size_t i = 0;
      while (i < attribute.elements() && is_direction(out, attribute, i)) ++i;
      if (i == attribute.elements()) return out;
    }
  return {Cells::choose(attribute, bits), attribute.count};
}

void AttributeCells::cells_of(const Attribute& attribute, std::size_t element,
                              std::int32_t* out) const {
  unsigned k = 0;
  if (octahedron_) {
    const Octahedron::Point at = point_of(*octahedron_, attribute, element);
    *out++ = at.u;
    *out++ = at.v;
    k = 3;
  }
  for (; k < count_; ++k) *out++ = own_.cell_of(bits_of(attribute, element, k));
}

void AttributeCells::store(const std::int32_t* cells, Attribute& attribute,
                           std::size_t element) const {
  unsigned k = 0;
  if (octahedron_) {
    const Octahedron::Vector unit = octahedron_->unit(octahedron_->placed(cells[0], cells[1]));
    for (; k < 3; ++k) set_bits(attribute, element, k, float_bits(unit[k]));
    cells += 2;
  }
  for (; k < count_; ++k) set_bits(attribute, element, k, own_.middle(*cells++));
}

}  // namespace pstrips::inline formats
