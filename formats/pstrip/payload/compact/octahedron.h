#pragma once

#include <array>
#include <cstdint>

// For formats/pstrip/payload/compact: directions as points of a square, by way of an octahedron
// whose lower half is folded out. [Meyer10; Cigolle14 §3; spec/compact.md §3]

namespace pstrips::inline formats {

/// A grid on the square. Coordinates are from -reach() to reach(); the middle is +z, the corners
/// are -z. Arithmetic is on integers, so that results are the same on every machine.
class Octahedron {
 public:
  static constexpr unsigned kMinBits = 4, kMaxBits = 16;
  using Vector = std::array<std::int64_t, 3>;
  struct Point {
    std::int32_t u = 0, v = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };

  /// bits  kMinBits to kMaxBits: the square has 2^bits - 1 points along a side
  explicit Octahedron(unsigned bits) : bits_(bits), reach_((1 << (bits - 1)) - 1) {}

  unsigned bits() const { return bits_; }
  std::int32_t reach() const { return reach_; }

  /// The point of the square for any two numbers: coordinates too large count as the largest.
  /// Points of the rim that are one on the octahedron become one.
  Point placed(std::int64_t u, std::int64_t v) const;

  /// The point on the octahedron: the sum of the components, without their signs, is reach().
  Vector on_faces(Point p) const;

  /// The direction of unit length, in 2^-24, each component to the nearest but for 2^-25 of its
  /// size.
  Vector unit(Point p) const;

  /// The point next to a direction, not always the very nearest; the middle for none.
  ///
  /// direction  components below 2^40
  Point near(const Vector& direction) const;

  /// The square with its other half in the middle. Its own inverse but for points that are one.
  Point turned(Point p) const;
  /// Nearer to -z than to +z.
  bool is_below(Point p) const;

 private:
  unsigned bits_;
  std::int32_t reach_;
};

}  // namespace pstrips::inline formats
