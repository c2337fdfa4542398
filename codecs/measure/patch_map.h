#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codecs/measure/fan_map.h"
#include "core/mesh.h"
#include "core/point.h"

namespace pstrips::inline codecs {

/// Relates two small sets of triangles of which one replaces the other: each part of a triangle of
/// either set is mapped linearly into a triangle of the other set, as near as can be.
///
/// For any triangles, also where a FanMap finds no plane or moves points farther than it has to;
/// slower by an order of magnitude.
struct PatchMap {
  struct Patch {
    std::array<Point, 3> corner;
    DisplacementBox box;
    Index face = kNone;      ///< the caller's name for it, with its corners in the same order
    bool is_changed = true;  ///< false: stands in both sets as it is
  };
  std::vector<Patch> before, after;

  /// Sets the boxes of what has changed in `after` to displacements since those of `before` were
  /// last known, and widens the other ones.
  ///
  /// near_enough  below it nothing is gained
  /// work         triangles that may be looked at; less by those that were. When it is too little
  ///              each triangle goes where its corners go
  /// Precondition: `after` is not empty.
  void run(double near_enough, std::uint64_t& work);

 private:
  using Triangle = std::array<Point, 3>;
  enum class Direction { forward, backward };
  struct Image {
    Patch* patch = nullptr;
    Triangle corner{};
    double distance = 0;        ///< of the farthest corner, squared
    double least_distance = 0;  ///< that of the corner that is farthest from all triangles
  };
  static Image nearest_image(const Triangle& part, std::vector<Patch>& others);
  void map_parts(Patch& patch, Direction direction, std::uint64_t& work);
  void relate(Patch& patch, const Triangle& part, const Image& image, Direction direction);
  void cut(const Triangle& part, const std::vector<Patch>& others);
  void map_corners();

  std::vector<Triangle> parts_;
  double enough_ = 0;
};

}  // namespace pstrips::inline codecs
