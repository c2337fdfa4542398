#include "formats/pstrip/payload/compact/cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace pstrips::inline formats {
namespace {

/// How a float is laid out: sign, exponent, mantissa.
struct FloatLayout {
  int mantissa_bits;  ///< without the leading one
  int exponent_bits;
  int min_exponent;  ///< of the last bit of the mantissa of a denormal number
  int max_exponent;  ///< of a cell: the largest one is a finite number

  std::uint64_t mantissa_mask() const { return (std::uint64_t{1} << mantissa_bits) - 1; }
  std::uint64_t exponent_mask() const { return (std::uint64_t{1} << exponent_bits) - 1; }
  int bits() const { return 1 + exponent_bits + mantissa_bits; }
};
constexpr FloatLayout kFloat{23, 8, -149, 105}, kDouble{52, 11, -1074, 1001};

constexpr const FloatLayout& layout_of(ComponentType type) {
  return type == ComponentType::f64 ? kDouble : kFloat;
}

int length_of(std::uint64_t bits) { return static_cast<int>(std::bit_width(bits)); }

/// |x| = mantissa * 2^exponent.
struct Parts {
  std::uint64_t mantissa = 0;
  int exponent = 0;
  bool negative = false;
  bool finite = true;
};

Parts parts_of(std::uint64_t component, const FloatLayout& layout) {
  const std::uint64_t exponent = component >> layout.mantissa_bits & layout.exponent_mask();
  Parts out;
  out.mantissa = component & layout.mantissa_mask();
  out.exponent = layout.min_exponent;
  out.negative = (component >> (layout.bits() - 1) & 1) != 0;
  out.finite = exponent != layout.exponent_mask();
  if (exponent > 0) {
    out.mantissa |= std::uint64_t{1} << layout.mantissa_bits;
    out.exponent += static_cast<int>(exponent) - 1;
  }
  return out;
}

std::uint64_t float_of(const Parts& parts, const FloatLayout& layout) {
  std::uint64_t mantissa = parts.mantissa;
  int exponent = parts.exponent;
  // Numbers of fewer bits have an exponent of their own, down to the denormal ones.
  const int spare = layout.mantissa_bits + 1 - length_of(mantissa);
  const int shift = std::clamp(exponent - layout.min_exponent, 0, std::max(spare, 0));
  mantissa <<= shift;
  exponent -= shift;
  std::uint64_t biased = 0;
  if (mantissa >> layout.mantissa_bits != 0)
    biased = static_cast<std::uint64_t>(exponent - layout.min_exponent + 1);
  biased = std::min(biased, layout.exponent_mask());
  return std::uint64_t{parts.negative} << (layout.bits() - 1) | biased << layout.mantissa_bits |
         (mantissa & layout.mantissa_mask());
}

std::int32_t signed_cell(bool negative, std::uint64_t size) {
  const auto cell = static_cast<std::int32_t>(size);
  return negative ? -cell : cell;
}

std::uint64_t size_of_cell(std::int32_t cell) {
  return static_cast<std::uint64_t>(cell < 0 ? -std::int64_t{cell} : std::int64_t{cell});
}

/// x / 2^exponent without its fraction, 0 when that is too large.
std::int32_t float_cell(const Parts& x, int exponent) {
  if (!x.finite || x.mantissa == 0) return 0;
  const int shift = exponent - x.exponent;
  if (shift >= 64) return 0;
  if (shift >= 0) {
    const std::uint64_t size = x.mantissa >> shift;
    return size > kMaxCell ? 0 : signed_cell(x.negative, size);
  }
  // Longer than a cell can be.
  if (length_of(x.mantissa) - shift > 23) return 0;
  return signed_cell(x.negative, x.mantissa << -shift);
}

/// 0: it is none.
std::size_t size_of_integer(ComponentType type) {
  return type == ComponentType::f32 || type == ComponentType::f64 ? 0 : size_of(type);
}

bool is_signed(ComponentType type) {
  return type == ComponentType::i8 || type == ComponentType::i16 || type == ComponentType::i32;
}

std::int64_t integer_of(std::uint64_t component, ComponentType type) {
  if (!is_signed(type)) return static_cast<std::int64_t>(component);
  const unsigned unused = 64 - 8 * static_cast<unsigned>(size_of(type));
  return static_cast<std::int64_t>(component << unused) >> unused;
}

std::uint64_t mask_of(unsigned bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

/// What all components of a float attribute have in common.
struct Extent {
  int lowest_bit = std::numeric_limits<int>::max();  ///< exponent of the last bit set of any
  int highest_bit = std::numeric_limits<int>::min();
  bool all_have_cells = true;
  double range = 0;  ///< of the widest component
};

Extent extent_of(const Attribute& attribute) {
  const FloatLayout& layout = layout_of(attribute.type);
  Extent out;
  for (std::size_t c = 0; c < attribute.count; ++c) {
    double low = 0, high = 0;
    bool any = false;
    for (std::size_t i = 0; i < attribute.elements(); ++i) {
      const std::uint64_t bits = bits_of(attribute, i, c);
      const Parts x = parts_of(bits, layout);
      if (!x.finite || (x.mantissa == 0 && x.negative)) out.all_have_cells = false;
      if (!x.finite || x.mantissa == 0) continue;
      out.lowest_bit = std::min(out.lowest_bit, x.exponent + std::countr_zero(x.mantissa));
      out.highest_bit = std::max(out.highest_bit, x.exponent + length_of(x.mantissa) - 1);
      const double value = std::ldexp(static_cast<double>(x.mantissa), x.exponent);
      const double signed_value = x.negative ? -value : value;
      low = any ? std::min(low, signed_value) : signed_value;
      high = any ? std::max(high, signed_value) : signed_value;
      any = true;
    }
    out.range = std::max(out.range, high - low);
  }
  return out;
}

}  // namespace

std::uint64_t bits_of(const Attribute& attribute, std::size_t element, std::size_t component) {
  const std::size_t size = size_of(attribute.type);
  std::uint64_t bits = 0;
  std::memcpy(&bits, attribute.data.data() + (element * attribute.count + component) * size, size);
  return bits;
}

void set_bits(Attribute& attribute, std::size_t element, std::size_t component,
              std::uint64_t bits) {
  const std::size_t size = size_of(attribute.type);
  std::memcpy(attribute.data.data() + (element * attribute.count + component) * size, &bits, size);
}

bool Cells::is_valid(ComponentType type, int exponent) {
  if (type == ComponentType::f32 || type == ComponentType::f64)
    return exponent >= layout_of(type).min_exponent && exponent <= layout_of(type).max_exponent;
  return exponent >= 0 && exponent <= (size_of(type) == 4 ? 9 : 0);
}

Cells Cells::choose(const Attribute& attribute, unsigned bits) {
  const ComponentType type = attribute.type;
  if (type != ComponentType::f32 && type != ComponentType::f64) {
    std::int64_t low = 0, high = 0;
    for (std::size_t i = 0; i < attribute.elements() * attribute.count; ++i) {
      const std::int64_t n = integer_of(bits_of(attribute, 0, i), type);
      low = std::min(low, n);
      high = std::max(high, n);
    }
    int exponent = 0;
    while (low >> exponent < -kMaxCell || high >> exponent > kMaxCell) ++exponent;
    return {type, exponent, exponent == 0};
  }
  const Extent extent = extent_of(attribute);
  if (extent.highest_bit < extent.lowest_bit)  // nothing but zeros, or no numbers
    return {type, layout_of(type).min_exponent, extent.all_have_cells};
  if (extent.all_have_cells && extent.highest_bit - extent.lowest_bit < 23)
    return {type, extent.lowest_bit, true};
  int exponent = extent.highest_bit - 22;
  if (extent.range > 0) {
    const int of_range = std::ilogb(extent.range) + 1 - static_cast<int>(bits);
    exponent = std::max(exponent, of_range);
  }
  return {type, std::clamp(exponent, layout_of(type).min_exponent, layout_of(type).max_exponent),
          false};
}

std::int32_t Cells::cell_of(std::uint64_t component) const {
  if (is_float()) return float_cell(parts_of(component, layout_of(type_)), exponent_);
  const std::int64_t cell = integer_of(component, type_) >> exponent_;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(cell, -kMaxCell, kMaxCell));
}

unsigned Cells::low_bits(std::int32_t cell) const {
  if (exact_) return 0;
  if (!is_float()) return static_cast<unsigned>(exponent_);
  const FloatLayout& layout = layout_of(type_);
  if (cell == 0) return static_cast<unsigned>(layout.bits());
  const int of_cell = length_of(size_of_cell(cell));
  return static_cast<unsigned>(
      std::max(0, std::min(layout.mantissa_bits + 1 - of_cell, exponent_ - layout.min_exponent)));
}

std::uint64_t Cells::low_of(std::uint64_t component) const {
  const unsigned bits = low_bits(cell_of(component));
  if (!is_float()) return static_cast<std::uint64_t>(integer_of(component, type_)) & mask_of(bits);
  const FloatLayout& layout = layout_of(type_);
  if (bits == static_cast<unsigned>(layout.bits())) return component;
  return parts_of(component, layout).mantissa & mask_of(bits);
}

std::uint64_t Cells::component(std::int32_t cell, std::uint64_t low) const {
  const unsigned bits = low_bits(cell);
  if (!is_float()) {
    const std::int64_t n = (std::int64_t{cell} << exponent_) + static_cast<std::int64_t>(low);
    return static_cast<std::uint64_t>(n) & mask_of(8 * static_cast<unsigned>(size_of(type_)));
  }
  const FloatLayout& layout = layout_of(type_);
  if (cell == 0) return exact_ ? 0 : low;
  const Parts parts{size_of_cell(cell) << bits | low, exponent_ - static_cast<int>(bits), cell < 0,
                    true};
  return float_of(parts, layout);
}

std::uint64_t Cells::middle(std::int32_t cell) const {
  const unsigned bits = low_bits(cell);
  if (bits == 0 || cell == 0) return component(cell, 0);
  return component(cell, std::uint64_t{1} << (bits - 1));
}

PositionCells::PositionCells(const PositionGrid& grid, ComponentType type) : grid_(grid) {
  if (grid.step == 0)
    cells_ = Cells(type, 0, true);
  else if (!grid.exact || size_of_integer(type) > 0)
    cells_ = Cells(type, std::ilogb(grid.step), grid.exact);
}

bool PositionCells::is_valid(const PositionGrid& grid, ComponentType type) {
  const std::size_t integer_bytes = size_of_integer(type);
  if (grid.step == 0) return integer_bytes > 0 && integer_bytes < 4;
  if (!std::isfinite(grid.step) || grid.step < 0) return false;
  int exponent = 0;
  const bool is_power = std::frexp(grid.step, &exponent) == 0.5f;
  const bool is_at_zero = grid.origin == PositionGrid{}.origin;
  if (integer_bytes > 0)
    return integer_bytes == 4 && is_power && is_at_zero && Cells::is_valid(type, exponent - 1) &&
           grid.exact == (grid.step == 1);
  if (grid.exact) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 29;
    return type == ComponentType::f32 && std::ranges::all_of(grid.origin, [](std::int64_t o) {
             return o >= -kFarthest && o <= kFarthest;
           });
  }
  return is_power && is_at_zero && Cells::is_valid(type, exponent - 1);
}

std::int32_t PositionCells::cell_of(std::uint64_t component, unsigned axis) const {
  if (cells_) return cells_->cell_of(component);
  const float x = std::bit_cast<float>(static_cast<std::uint32_t>(component));
  const double steps =
      std::nearbyint(double{x} / double{grid_.step}) - static_cast<double>(grid_.origin[axis]);
  if (!(steps >= -kMaxCell && steps <= kMaxCell)) return 0;
  return static_cast<std::int32_t>(steps);
}

std::uint64_t PositionCells::component(std::int32_t cell, unsigned axis) const {
  if (cells_) return cells_->middle(cell);
  // The product is exact: 30 bits times 24.
  const double x = static_cast<double>(grid_.origin[axis] + cell) * double{grid_.step};
  return std::bit_cast<std::uint32_t>(static_cast<float>(x));
}

}  // namespace pstrips::inline formats
