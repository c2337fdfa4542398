#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh.h"
#include "core/scene.h"

namespace pstrips::inline converters {

/// To how many bits wedge attributes are quantized; 0: they stay as they are.
struct AttributeBits {
  static constexpr unsigned kMin = 4, kMaxDirection = 16, kMax = 23;

  unsigned normal = 0;   ///< NORMAL and TANGENT: kMin to kMaxDirection for each side of a square
  unsigned texture = 0;  ///< TEXCOORD_n, like the next two kMin to kMax
  unsigned color = 0;    ///< COLOR_n
  unsigned other = 0;    ///< all the rest

  bool any() const { return normal > 0 || texture > 0 || color > 0 || other > 0; }
  bool is_valid() const;
  unsigned of(std::string_view semantic) const;
  friend bool operator==(const AttributeBits&, const AttributeBits&) = default;
};

/// What came of one attribute of a mesh that was to be quantized.
struct QuantizedAttribute {
  std::string semantic;
  unsigned bits = 0;
  /// The largest difference of a component; of directions the largest angle, in degrees.
  double error = 0;
  std::string kept;  ///< why it stays as it is, a phrase; empty: it was quantized
};

/// The grids of the attributes of a file: one for all meshes, so that what is equal stays equal.
class AttributeGrids {
 public:
  AttributeGrids() = default;
  /// bits  is_valid()
  AttributeGrids(const Model& model, const AttributeBits& bits);

  /// Moves the wedge attributes of a mesh of the model to their grids: directions to the points of
  /// an octahedron, others to multiples of a power of two, of which 2^bits or a few more lie in the
  /// range of the attribute in the model. Weights that add up to one still do. Doubles become f32.
  ///
  /// Integers stay as they are, as do attributes with an element that has no place: NaN, infinity,
  /// a direction of no length.
  std::vector<QuantizedAttribute> apply(Mesh& mesh) const;

 private:
  struct Grid {
    std::string semantic;
    std::vector<std::pair<double, double>> ranges;  // of the components
    int exponent = 0;
  };
  static void widen(Grid& grid, const Attribute& a);
  const Grid* find(std::string_view semantic) const;

  AttributeBits bits_;
  std::vector<Grid> grids_;
};

}  // namespace pstrips::inline converters
