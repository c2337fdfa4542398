#pragma once

#include <array>
#include <cstddef>

namespace pstrips::inline core {

/// 4 × 4, column-major.
using Matrix4 = std::array<double, 16>;
inline constexpr Matrix4 kIdentity4 = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// What `b` and then `a` do.
inline Matrix4 product(const Matrix4& a, const Matrix4& b) {
  Matrix4 out{};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k)
        out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return out;
}

}  // namespace pstrips::inline core
