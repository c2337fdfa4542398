#include "core/color_range.h"

#include <algorithm>
#include <cmath>

namespace pstrips::inline core {
namespace {

constexpr std::size_t kAlpha = 3;

bool is_float(const Attribute& a) {
  return a.type == ComponentType::f32 || a.type == ComponentType::f64;
}

/// Over components [first, end) of all elements.
double range_of(const Attribute& color, std::size_t first, std::size_t end) {
  double largest = 0;
  bool whole = true;
  for (std::size_t i = 0; i < color.elements(); ++i)
    for (std::size_t c = first; c < end; ++c) {
      const double value = component(color, i, c);
      if (value > largest) largest = value;
      whole &= value == std::floor(value);
    }
  return color_range(largest, whole);
}

}  // namespace

double color_range(double largest, bool whole) {
  constexpr double kOvershoot = 2, kByte = 255, kShort = 65535;
  if (largest <= 1) return 1;
  if (largest <= kByte && (whole || largest > kOvershoot)) return kByte;
  return whole && largest <= kShort ? kShort : 1;
}

double color_range(const Attribute& color) {
  return is_float(color) ? range_of(color, 0, std::min<std::size_t>(color.count, kAlpha)) : 1;
}

Attribute color_shares(const Attribute& color) {
  if (!is_float(color)) return color;
  Attribute out = color;
  const double range = color_range(color);
  const double alpha = range_of(color, std::min<std::size_t>(color.count, kAlpha), color.count);
  for (std::size_t i = 0; i < color.elements(); ++i)
    for (std::size_t c = 0; c < color.count; ++c) {
      const double share = component(color, i, c) / (c < kAlpha ? range : alpha);
      if (!std::isnan(share)) set_component(out, i, c, std::clamp(share, 0.0, 1.0));
    }
  return out;
}

}  // namespace pstrips::inline core
