#pragma once

#include <optional>

#include "formats/pstrip/payload/compact/cells.h"
#include "formats/pstrip/payload/compact/octahedron.h"

// For formats/pstrip/payload/compact: the cells of a wedge attribute. [spec/compact.md §3]

namespace pstrips::inline formats {

/// Either each component has a cell of its own, or three components are a direction, which has two
/// cells, the coordinates of a point of an Octahedron; a fourth component has its own.
class AttributeCells {
 public:
  /// Components of their own.
  AttributeCells(const Cells& cells, unsigned count) : own_(cells), count_(count) {}
  /// A direction. Precondition: can_be_directions().
  AttributeCells(const Octahedron& octahedron, unsigned count)
      : own_(ComponentType::f32, 0, true), octahedron_(octahedron), count_(count) {}

  static bool can_be_directions(const Attribute& format) {
    return format.type == ComponentType::f32 && (format.count == 3 || format.count == 4);
  }

  /// Directions if all elements are what a square of some size has, the fewest bits possible; else
  /// Cells::choose().
  static AttributeCells choose(const Attribute& attribute, unsigned bits);

  unsigned columns() const { return count_ - (octahedron_ ? 1 : 0); }
  bool exact() const { return own_.exact(); }
  /// Of components that are no direction's.
  const Cells& own() const { return own_; }
  const std::optional<Octahedron>& octahedron() const { return octahedron_; }

  /// out  columns()
  void cells_of(const Attribute& attribute, std::size_t element, std::int32_t* out) const;
  /// The element while bits below its cells are not known.
  void store(const std::int32_t* cells, Attribute& attribute, std::size_t element) const;

 private:
  Cells own_;
  std::optional<Octahedron> octahedron_;
  unsigned count_;
};

}  // namespace pstrips::inline formats
