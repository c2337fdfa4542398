#pragma once

#include "core/mesh.h"

namespace pstrips::inline core {

/// What full intensity is in colours that are no integers of a fixed size: 1, or 255 or 65535 where
/// the numbers are those of 8 or 16 bits. Numbers up to 2 are shares that overshoot, unless all are
/// whole.
///
/// largest  of the red, green and blue numbers
/// whole    all of them are
double color_range(double largest, bool whole);

/// The same of an attribute's red, green and blue; 1 for integers. cost O(size)
double color_range(const Attribute& color);

/// Colours as shares: divided by their range, an alpha beyond 1 too, and cut off at 0 and 1. NaN
/// stays.
Attribute color_shares(const Attribute& color);

}  // namespace pstrips::inline core
