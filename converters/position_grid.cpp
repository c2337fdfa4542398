#include "converters/position_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "formats/pstrip/payload/compact/cells.h"

namespace pstrips::inline converters {
namespace {

bool is_float(ComponentType type) {
  return type == ComponentType::f32 || type == ComponentType::f64;
}

std::size_t axes_of(const Attribute& position) { return std::min<std::size_t>(3, position.count); }

bool is_anywhere_but_zero(const Attribute& position) {
  for (std::size_t i = 0; i < position.elements() * position.count; ++i)
    if (bits_of(position, 0, i) != 0) return true;
  return false;
}

struct Box {
  std::array<double, 3> low, high;
  bool is_finite = true;

  Box() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Attribute& position) {
    for (std::size_t v = 0; v < position.elements(); ++v)
      for (std::size_t c = 0; c < axes_of(position); ++c) {
        const double x = component(position, v, c);
        is_finite = is_finite && std::isfinite(x);
        if (!std::isfinite(x)) continue;
        low[c] = std::min(low[c], x);
        high[c] = std::max(high[c], x);
      }
  }
  double longest_side() const {
    double out = 0;
    for (std::size_t c = 0; c < 3; ++c) out = std::max(out, high[c] - low[c]);
    return out;
  }
  double farthest() const {
    double out = 0;
    for (std::size_t c = 0; c < 3; ++c)
      if (low[c] <= high[c]) out = std::max({out, std::abs(low[c]), std::abs(high[c])});
    return out;
  }
};

void place_origin(const Box& box, PositionGrid& grid) {
  for (std::size_t c = 0; c < 3; ++c)
    if (box.low[c] <= box.high[c])
      grid.origin[c] = std::llround((box.low[c] / 2 + box.high[c] / 2) / double{grid.step});
}

// Points as many as 24 bits tell, and as far from zero as a float is exact.
Result<PositionGrid> points(const Box& box, unsigned bits) {
  PositionGrid out;
  const double most = std::min(std::ldexp(1, static_cast<int>(bits)) - 1, 2.0 * kMaxCell - 2);
  double step = box.longest_side() / most;
  step = std::max({step, box.farthest() * 0x1p-24, double{std::numeric_limits<float>::min()}});
  out.step = static_cast<float>(step);
  if (!std::isfinite(out.step))
    return fail(ErrorCode::unsupported, "positions are too far apart for a grid");
  place_origin(box, out);
  return out;
}

// The coarsest grid that has all positions, if one has that is not finer than 2^16 steps along the
// longest side: below, bits are noise that had better come last.
std::optional<PositionGrid> own_points(const Model& model, const Box& box) {
  constexpr unsigned kBits = 16;
  int exponent = std::numeric_limits<int>::max();
  for (const Mesh& mesh : model.meshes) {
    if (!is_float(mesh.position.type)) continue;
    const Cells cells = Cells::choose(mesh.position, kBits);
    if (!cells.exact() || mesh.position.type != ComponentType::f32) return {};
    if (is_anywhere_but_zero(mesh.position)) exponent = std::min(exponent, cells.exponent());
  }
  PositionGrid out;
  constexpr int kOfZeros = 0;
  out.step = std::ldexp(1.f, exponent == std::numeric_limits<int>::max() ? kOfZeros : exponent);
  if (box.longest_side() > std::ldexp(double{out.step}, kBits)) return {};
  place_origin(box, out);
  return out;
}

// Cells of a power of two: 2^13 of them along the longest side, and numbers that 23 bits hold.
PositionGrid cells(const Box& box) {
  PositionGrid out;
  out.exact = false;
  constexpr int kCells = 13, kLargest = 22, kLeast = -126, kMost = 105;
  int exponent = kLeast;
  if (const double side = box.longest_side(); side > 0)
    exponent = std::max(exponent, std::ilogb(side) + 1 - kCells);
  if (const double farthest = box.farthest(); farthest > 0)
    exponent = std::max(exponent, std::ilogb(farthest) - kLargest);
  out.step = std::ldexp(1.f, std::min(exponent, kMost));
  return out;
}

// Of its cell on an axis, as the number that stands for it.
double number_of(const PositionCells& grid, Attribute& scratch, std::int32_t cell,
                 std::size_t axis) {
  set_bits(scratch, 0, axis, grid.component(cell, static_cast<unsigned>(axis)));
  return component(scratch, 0, axis);
}

Attribute one_element(const Attribute& position) {
  Attribute out = position.format();
  out.data.resize(out.element_bytes());
  return out;
}

}  // namespace

Result<PositionGrid> position_grid(const Model& model, unsigned bits) {
  Box box;
  bool any_floats = false;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const Attribute& position = model.meshes[m].position;
    const ComponentType type = position.type;
    any_floats = any_floats || is_float(type);
    if (bits > 0 && !is_float(type))
      return fail(ErrorCode::unsupported,
                  "positions of type " + std::string(name_of(type)) +
                      " are kept as they are, not quantized",
                  kNoOffset, "/meshes/" + std::to_string(m));
    if (is_float(type)) box.add(position);
    if (bits > 0 && !box.is_finite)
      return fail(ErrorCode::unsupported, "a position is no number, and cannot be quantized",
                  kNoOffset, "/meshes/" + std::to_string(m));
  }
  if (!any_floats) return PositionGrid{};
  if (bits > 0) return points(box, bits);
  return own_points(model, box).value_or(cells(box));
}

PositionGrid integer_grid(const Attribute& position) {
  if (size_of(position.type) < 4) return {};
  const Cells cells = Cells::choose(position, 23);
  return {.step = std::ldexp(1.f, cells.exponent()), .origin = {}, .exact = cells.exact()};
}

double move_to_grid(Mesh& mesh, const PositionGrid& grid) {
  const Attribute from = std::exchange(mesh.position, mesh.position.format());
  Attribute& to = mesh.position;
  to.type = ComponentType::f32;
  to.data.resize(to.element_bytes() * from.elements());
  const PositionCells cells(grid, to.type);
  double farthest = 0;
  for (std::size_t v = 0; v < from.elements(); ++v) {
    double square = 0;
    for (std::size_t c = 0; c < from.count; ++c) {
      const double x = component(from, v, c);
      set_component(to, v, c, x);
      if (c >= 3) continue;
      const auto axis = static_cast<unsigned>(c);
      set_bits(to, v, c, cells.component(cells.cell_of(bits_of(to, v, c), axis), axis));
      const double moved = component(to, v, c) - x;
      square += moved * moved;
    }
    farthest = std::max(farthest, square);
  }
  return std::sqrt(farthest);
}

void place_in_the_middle(const Mesh& mesh, const PositionGrid& grid, CollapseSequence& sequence) {
  const Attribute& position = mesh.position;
  const std::size_t axes = axes_of(position);
  const PositionCells cells(grid, position.type);
  std::vector<std::array<std::int32_t, 3>> cell(position.elements());
  for (std::size_t v = 0; v < cell.size(); ++v)
    for (std::size_t c = 0; c < axes; ++c)
      cell[v][c] = cells.cell_of(bits_of(position, v, c), static_cast<unsigned>(c));
  Attribute at = one_element(position);
  sequence.placements.clear();
  for (const Collapse& pair : sequence.collapses)
    for (std::size_t c = 0; c < 3; ++c) {
      std::int32_t& kept = cell[pair.kept][c];
      kept += (cell[pair.removed][c] - kept) >> 1;
      sequence.placements.push_back(c < axes ? number_of(cells, at, kept, c) : 0);
    }
}

}  // namespace pstrips::inline converters
