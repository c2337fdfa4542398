#pragma once

#include <cstdint>
#include <optional>

#include "core/mesh.h"
#include "core/progressive_strips.h"

// For formats/pstrip/payload/compact: numbers of an attribute as cells, small integers that packets
// carry, and the bits below them, which FINE carries. [spec/compact.md §3]

namespace pstrips::inline formats {

/// No cell is farther from zero: differences fit 25 bits, which the widths of the predictors rest
/// on.
inline constexpr std::int32_t kMaxCell = (1 << 23) - 1;

/// The cells of an attribute whose components have one type. A component is given as its bits, in
/// the low size_of(type) bytes.
///
/// Floats: the cell of x is x / 2^exponent without its fraction, so that cell 0 is twice as wide as
/// the others. What has no cell (NaN, infinity, -0, too far away) is in cell 0 with all of its
/// bits. Integers: the cell of n is n / 2^exponent, rounded down.
class Cells {
 public:
  /// exponent  is_valid()
  /// exact     no value has bits below its cell
  Cells(ComponentType type, int exponent, bool exact)
      : type_(type), exponent_(exponent), exact_(exact) {}

  /// The coarsest cells in which all elements are exact, if there are any; else such that the
  /// widest component takes about `bits` bits.
  static Cells choose(const Attribute& attribute, unsigned bits);

  /// The largest cells are finite numbers, the smallest no finer than the type.
  static bool is_valid(ComponentType type, int exponent);

  ComponentType type() const { return type_; }
  int exponent() const { return exponent_; }
  bool exact() const { return exact_; }

  std::int32_t cell_of(std::uint64_t component) const;
  /// How many bits of a component its cell does not tell: at most 64.
  unsigned low_bits(std::int32_t cell) const;
  /// The low_bits() of a component that are left.
  std::uint64_t low_of(std::uint64_t component) const;
  /// cell  |cell| <= kMaxCell; what the type cannot hold gives some value
  std::uint64_t component(std::int32_t cell, std::uint64_t low) const;
  /// What stands for a component while its low bits are not known: about the middle of the cell, a
  /// value whose cell it is.
  std::uint64_t middle(std::int32_t cell) const;

 private:
  bool is_float() const { return type_ == ComponentType::f32 || type_ == ComponentType::f64; }

  ComponentType type_;
  int exponent_;
  bool exact_;
};

/// A component as its bits, and back.
std::uint64_t bits_of(const Attribute& attribute, std::size_t element, std::size_t component);
void set_bits(Attribute& attribute, std::size_t element, std::size_t component, std::uint64_t bits);

/// Positions on a grid or in cells, whichever the mesh has.
class PositionCells {
 public:
  /// A grid with a step of 0 stands for none: then integers are their own cells. Those of 32 bits
  /// have cells of a step.
  PositionCells(const PositionGrid& grid, ComponentType type);

  /// The grid can be used: its step is finite and positive, a power of two if it is of cells, and
  /// points of the grid are floats.
  static bool is_valid(const PositionGrid& grid, ComponentType type);

  std::int32_t cell_of(std::uint64_t component, unsigned axis) const;
  /// A position while its low bits, of which an exact grid has none, are not known.
  std::uint64_t component(std::int32_t cell, unsigned axis) const;
  /// Cells that bits are left of, or nothing.
  const std::optional<Cells>& cells() const { return cells_; }

 private:
  PositionGrid grid_;
  std::optional<Cells> cells_;
};

}  // namespace pstrips::inline formats
