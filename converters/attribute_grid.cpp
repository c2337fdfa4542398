#include "converters/attribute_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "formats/pstrip/payload/compact/attribute_cells.h"

namespace pstrips::inline converters {
namespace {

bool is_direction(std::string_view semantic) {
  return semantic == "NORMAL" || semantic == "TANGENT";
}

bool is_float(const Attribute& a) {
  return a.type == ComponentType::f32 || a.type == ComponentType::f64;
}

// A step of 2^exponent for which the widest range takes `bits` bits; such that cells can hold the
// farthest number.
int exponent_for(const std::vector<std::pair<double, double>>& ranges, unsigned bits) {
  constexpr int kLeast = -126, kCellBits = 22;
  double range = 0, farthest = 0;
  for (const auto& [low, high] : ranges) {
    range = std::max(range, high - low);
    farthest = std::max({farthest, std::abs(low), std::abs(high)});
  }
  int exponent = kLeast;
  if (range > 0)
    exponent = std::max(exponent, std::ilogb(range / (std::ldexp(1, static_cast<int>(bits)) - 1)));
  if (farthest > 0) exponent = std::max(exponent, std::ilogb(farthest) - kCellBits);
  return exponent;
}

std::string why_not_numbers(const Attribute& a) {
  if (!is_float(a)) return "is of integers";
  for (std::size_t i = 0; i < a.elements(); ++i)
    for (std::size_t c = 0; c < a.count; ++c)
      if (!std::isfinite(static_cast<float>(component(a, i, c))))
        return "has an element that is no finite 32-bit float";
  return {};
}

using Direction = std::array<double, 3>;

Direction direction_of(const Attribute& a, std::size_t i) {
  return {component(a, i, 0), component(a, i, 1), component(a, i, 2)};
}

double length_of(const Direction& d) { return std::hypot(d[0], d[1], d[2]); }

std::string why_not_directions(const Attribute& a) {
  constexpr double kShortest = 1e-200;  // that can be divided by
  if (!is_float(a) || (a.count != 3 && a.count != 4)) return "is not of three or four floats";
  for (std::size_t i = 0; i < a.elements(); ++i) {
    const double length = length_of(direction_of(a, i));
    if (!(length > kShortest) || !std::isfinite(length))
      return "has an element without a direction";
    if (a.count == 4 && std::abs(component(a, i, 3)) != 1)
      return "has a fourth component that is no sign";
  }
  return {};
}

// The angle between two directions, degrees.
double angle(const Direction& a, const Direction& b) {
  const Direction cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0]};
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return std::atan2(length_of(cross), dot) * 180 / std::numbers::pi;
}

// Of the points around the one that integers find, the nearest.
Direction nearest(const Octahedron& octahedron, const Direction& wanted) {
  const double scale = 0x1p30 / length_of(wanted);
  const Octahedron::Point middle =
      octahedron.near({std::llround(wanted[0] * scale), std::llround(wanted[1] * scale),
                       std::llround(wanted[2] * scale)});
  Direction best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t u = middle.u - 1; u <= middle.u + 1; ++u)
    for (std::int32_t v = middle.v - 1; v <= middle.v + 1; ++v) {
      const Octahedron::Vector unit = octahedron.unit(octahedron.placed(u, v));
      const Direction here = {std::ldexp(static_cast<double>(unit[0]), -24),
                              std::ldexp(static_cast<double>(unit[1]), -24),
                              std::ldexp(static_cast<double>(unit[2]), -24)};
      const double off = angle(here, wanted);
      if (off >= least) continue;
      least = off;
      best = here;
    }
  return best;
}

double move_directions(const Attribute& from, Attribute& to, unsigned bits) {
  const Octahedron octahedron(bits);
  double farthest = 0;
  for (std::size_t i = 0; i < from.elements(); ++i) {
    const Direction before = direction_of(from, i), after = nearest(octahedron, before);
    farthest = std::max(farthest, angle(before, after));
    for (std::size_t c = 0; c < from.count; ++c)
      set_component(to, i, c, c < 3 ? after[c] : component(from, i, c));
  }
  return farthest;
}

double sum_of(const Attribute& a, std::size_t i) {
  double sum = 0;
  for (std::size_t c = 0; c < a.count; ++c) sum += component(a, i, c);
  return sum;
}

// The largest component makes up for what rounding did to the sum.
void restore_sum(Attribute& a, std::size_t i) {
  std::size_t largest = 0;
  for (std::size_t c = 1; c < a.count; ++c)
    if (component(a, i, c) > component(a, i, largest)) largest = c;
  set_component(a, i, largest, component(a, i, largest) + 1 - sum_of(a, i));
}

double move_numbers(const Attribute& from, Attribute& to, int exponent) {
  constexpr double kNearlyOne = 1e-3;
  const bool are_weights = from.semantic.starts_with("WEIGHTS_") && exponent <= 0;
  double farthest = 0;
  for (std::size_t i = 0; i < from.elements(); ++i) {
    for (std::size_t c = 0; c < from.count; ++c)
      // No -0: it has no place on the grid.
      set_component(
          to, i, c,
          std::ldexp(std::nearbyint(std::ldexp(component(from, i, c), -exponent)), exponent) + 0.0);
    if (are_weights && std::abs(sum_of(from, i) - 1) < kNearlyOne) restore_sum(to, i);
    for (std::size_t c = 0; c < from.count; ++c)
      farthest = std::max(farthest, std::abs(component(to, i, c) - component(from, i, c)));
  }
  return farthest;
}

}  // namespace

bool AttributeBits::is_valid() const {
  const auto fits = [](unsigned bits, unsigned most) {
    return bits == 0 || (bits >= kMin && bits <= most);
  };
  return fits(normal, kMaxDirection) && fits(texture, kMax) && fits(color, kMax) &&
         fits(other, kMax);
}

unsigned AttributeBits::of(std::string_view semantic) const {
  if (is_direction(semantic)) return normal;
  if (semantic.starts_with("TEXCOORD_")) return texture;
  if (semantic.starts_with("COLOR_")) return color;
  return other;
}

AttributeGrids::AttributeGrids(const Model& model, const AttributeBits& bits) : bits_(bits) {
  for (const Mesh& mesh : model.meshes)
    for (const Attribute& a : mesh.wedge_attributes) {
      if (bits.of(a.semantic) == 0 || is_direction(a.semantic) || !why_not_numbers(a).empty())
        continue;
      if (find(a.semantic) == nullptr) grids_.push_back({a.semantic, {}, 0});
      widen(*std::ranges::find(grids_, a.semantic, &Grid::semantic), a);
    }
  for (Grid& grid : grids_) grid.exponent = exponent_for(grid.ranges, bits.of(grid.semantic));
}

void AttributeGrids::widen(Grid& grid, const Attribute& a) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (grid.ranges.size() < a.count) grid.ranges.resize(a.count, {kInfinity, -kInfinity});
  for (std::size_t i = 0; i < a.elements(); ++i)
    for (std::size_t c = 0; c < a.count; ++c) {
      auto& [low, high] = grid.ranges[c];
      low = std::min(low, component(a, i, c));
      high = std::max(high, component(a, i, c));
    }
}

const AttributeGrids::Grid* AttributeGrids::find(std::string_view semantic) const {
  const auto found = std::ranges::find(grids_, semantic, &Grid::semantic);
  return found == grids_.end() ? nullptr : &*found;
}

std::vector<QuantizedAttribute> AttributeGrids::apply(Mesh& mesh) const {
  std::vector<QuantizedAttribute> out;
  for (Attribute& a : mesh.wedge_attributes) {
    const unsigned bits = bits_.of(a.semantic);
    if (bits == 0) continue;
    QuantizedAttribute& done = out.emplace_back(QuantizedAttribute{a.semantic, bits, 0, {}});
    const bool turns = is_direction(a.semantic);
    done.kept = turns ? why_not_directions(a) : why_not_numbers(a);
    if (!done.kept.empty()) continue;
    const Attribute from = std::exchange(a, a.format());
    a.type = ComponentType::f32;
    a.data.resize(a.element_bytes() * from.elements());
    done.error = turns ? move_directions(from, a, bits)
                       : move_numbers(from, a, find(from.semantic)->exponent);
  }
  return out;
}

}  // namespace pstrips::inline converters
