#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/point.h"

namespace pstrips::inline codecs {

/// An axis-aligned box of displacement vectors, rounded outwards.
struct DisplacementBox {
  std::array<float, 3> low{}, high{};

  /// Grows so as to hold each sum of a vector of `other` and one between `low_step`, `high_step`.
  void add(const DisplacementBox& other, const Point& low_step, const Point& high_step);
  /// Length of the longest vector in it, rounded up.
  double longest() const;
};

/// The piecewise linear map from a fan of triangles around a vertex to the fan of the same rim
/// around one of the rim's corners, and how far it moves points.
///
/// The centre collapses onto corner 0 of the rim. In a plane in which no triangle of either fan is
/// turned over, the one fan lies over the other: the map takes each point to the one above it. Both
/// fans are linear on each piece of that overlay, so displacements are extreme where two edges
/// cross, and those of a piece are bounded by its corners'.
///
/// An open fan lies at a border; the rim then ends with the centre's other neighbour on it, and the
/// centre goes to a point between that one and corner 0.
struct FanMap {
  struct Corner {
    std::array<double, 2> plane{};  ///< where it stands in the plane
    Point position{};
    DisplacementBox box;  ///< what is known of the triangle (centre, this, next corner)
  };
  bool closed = true;
  std::array<double, 2> centre_plane{};
  Point centre{};
  std::vector<Corner> rim;  ///< counter-clockwise in the plane
  Point target{};           ///< where corner 0 stands afterwards

  /// For triangle (corner 0, corner i, corner i + 1) the displacements since the triangles that it
  /// covers were last known, and those in `box`. Of the rim's size; only 1 to rim.size() - 2 count.
  std::vector<DisplacementBox> after;

  /// Fills `after`. False when there is no such map in this plane.
  /// Cost O(rim) to O(rim²) by where the centre lies. Precondition: 3 corners or more.
  bool run();

 private:
  struct Side;
  bool is_unfolded() const;
  std::size_t find_triangle_of_centre() const;
  bool displacement_at_centre(std::size_t triangle, Point& out) const;
  bool crossing(std::size_t diagonal, std::size_t corner, Point& out) const;
  bool cover_side(const Side& side, std::size_t last, const Point& at_centre);
  void cover(std::size_t to, std::size_t from, std::span<const Point> steps);

  std::vector<Point> row_, next_row_;
  double slack_ = 0;
};

}  // namespace pstrips::inline codecs
