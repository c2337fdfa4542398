#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codecs/simplify/complex.h"
#include "codecs/simplify/simplify.h"

namespace pstrips::inline codecs {

/// Which wedges the corners use and which stand at each vertex, and what their attributes cost.
///
/// Attribute k over a triangle is a linear function g·x + d. The sum over a wedge's triangles of
/// area · (g·x + d - a)², with x relative to its vertex and a to its own value, splits in a part in
/// x alone, which the vertex's quadric takes up, and  -2a (G·x + D) + a²W,  which stays here.
/// [Hoppe99b §3]
class WedgeTable {
 public:
  /// `input` must outlive it. Cost O(wedges and triangles).
  WedgeTable(const SimplifyInput& input, double diagonal);

  std::vector<Index> corner_wedge;  ///< by corner of the complex
  std::uint32_t attribute_count() const { return count_; }
  /// Attribute of a wedge, scaled to the complex's units.
  float attribute(Index wedge, std::uint32_t k) const {
    return attributes_[std::size_t{wedge} * count_ + k] * scale_;
  }
  /// Largest difference of one attribute of two wedges, in the input's scale.
  float largest_difference(Index a, Index b) const;

  void add_weight(Index wedge, float area) { weight_[wedge] += area; }
  /// Adds a triangle's area · g to G of attribute k.
  void add_gradient(Index wedge, std::uint32_t k, Vec3f gradient) {
    Term& term = terms_[std::size_t{wedge} * count_ + k];
    term.g = {term.g.x + gradient.x, term.g.y + gradient.y, term.g.z + gradient.z};
  }
  float weight(Index wedge) const { return weight_[wedge]; }

  /// What the wedges at a star's vertex add to the error when the vertex goes along an edge and
  /// ends at `x`: constant + 2 linear·x, which may be negative, since the other part is in the
  /// vertex's quadric.
  struct Cost {
    float constant = 0;
    Vec3f linear;
    float conflicts = 0;      ///< what merging different values costs, not part of the error
    float mapped_weight = 0;  ///< of the wedges that others replace
    float at(Vec3f x) const { return constant + 2 * dot(linear, x); }
  };
  Cost cost(const Star& star, const StarEdge& edge);
  /// Whether that turns a face over in the texture, or makes it a sliver there that it was not.
  bool breaks_texture(const Star& star, const StarEdge& edge);
  /// Of all wedges that the star uses.
  float live_weight(const Star& star);

  /// A vertex and its wedges move by `offset`.
  void move(Index vertex, Vec3f offset) {
    for (Index wedge = first_[vertex]; wedge != kNone; wedge = next_[wedge])
      shift_term(wedge, offset);
  }
  /// Performs the half of a collapse that concerns wedges: records a move of every wedge at the
  /// star's vertex, `kept` being the other vertex, and renames the surviving corners.
  ///
  /// offset   from the star's vertex to where `kept` stands, after a move() if it moved
  /// quadric  of the star's vertex; its linear term is moved to the new attribute values
  void collapse(const Complex& complex, const Star& star, Index kept, Vec3f offset,
                Quadric& quadric, std::vector<WedgeMove>& moves);

  /// Draws a new mark for `is_marked` and `mark`.
  void new_epoch() { ++epoch_; }
  bool is_marked(Index wedge) const { return mark_[wedge] == epoch_; }
  /// Marks a wedge and remembers a corner for it.
  void mark(Index wedge, Index corner) { mark_[wedge] = epoch_, other_[wedge] = corner; }
  Index other(Index wedge) const { return other_[wedge]; }
  /// Marks the wedge of a corner with another corner of its triangle, unless an earlier triangle
  /// has done so.
  void mark_first(Index corner, Index other_corner) {
    const Index wedge = corner_wedge[corner];
    if (!is_marked(wedge) || other_corner < other(wedge)) mark(wedge, other_corner);
  }

 private:
  struct Term {
    Vec3f g;
    float d = 0;
  };
  template <class Visit>
  void for_each_triangle(const Star& star, const StarEdge& edge, Visit&& visit) const;
  void add_cost(Index wedge, Index to, Cost& sum) const;
  float conflict(Index wedge, Index a, Index b) const;
  void replace(Index wedge, Index to, Vec3f offset, Quadric& quadric);
  void shift_term(Index wedge, Vec3f offset);

  std::span<const float> attributes_;
  std::uint32_t count_;
  std::uint32_t texture_;
  float scale_;
  std::vector<float> weight_;
  std::vector<Term> terms_;
  std::vector<Index> first_;  // of each vertex's wedges
  std::vector<Index> next_;   // of the same vertex
  std::vector<std::uint64_t> mark_;
  std::vector<Index> other_;
  std::uint64_t epoch_ = 0;
};

/// None when each vertex has one wedge and no attributes.
std::optional<WedgeTable> wedge_table(const SimplifyInput& input, double diagonal);

}  // namespace pstrips::inline codecs
