#pragma once

#include <array>
#include <limits>

#include "core/scene.h"

namespace pstrips::inline converters {

/// An axis-aligned box; empty as it is made.
struct BoundingBox {
  std::array<double, 3> min{kNothing, kNothing, kNothing};
  std::array<double, 3> max{-kNothing, -kNothing, -kNothing};

  bool is_empty() const { return min[0] > max[0]; }
  double diagonal() const;  ///< 0 when empty
  void add(const std::array<double, 3>& point);
  friend bool operator==(const BoundingBox&, const BoundingBox&) = default;

 private:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();
};

/// What holds all finite vertices of a model in the units of its scene: a mesh counts wherever
/// nodes place it, by the box of its own box there, and one that no node names as it stands.
BoundingBox bounding_box(const Model& model);

}  // namespace pstrips::inline converters
