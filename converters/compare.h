#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene.h"

namespace pstrips::inline converters {

enum class Equivalence : std::uint8_t {
  exact,      ///< the same vertices, wedges and faces in the same order, every value equal
  reordered,  ///< the same sets of vertices, wedges and faces; loops may start at another corner
  different,
};

struct AttributeDifference {
  std::string semantic;
  double largest = 0;  ///< between components of wedges (faces) at the same index
};

struct Comparison {
  Equivalence equivalence = Equivalence::different;
  /// What differs, as phrases with figures ("vertices: 8 against 24"); empty unless different.
  std::vector<std::string> differences;
  /// Of attributes that both have, when the connectivity is the same and values are not.
  std::vector<AttributeDifference> attributes;
  bool scenes_equal = false;  ///< materials, images and nodes, to the last bit and name
  // Distances between the surfaces over the larger bounding-box diagonal; 0 unless different,
  // infinite when only one of the two has a surface.
  double hausdorff = 0;
  double rms = 0;
};

/// Compares the meshes of two models, where their nodes place them: instances count as copies
/// (place_meshes()). Values are compared as numbers, bit for bit once widened to
/// double, so that component types may differ. Meshes are paired in order; when their numbers
/// differ, each model's meshes count as one.
///
/// Texture coordinates from different corners of an image are compared as from one.
///
/// A vertex is the set of its wedges, a wedge its position and attributes, a face its loop of
/// wedges, its kind, its material's name and its attributes.
///
/// Beside the meshes, materials of one name in one place (factors and base color texture), and the
/// animations, skins, cameras and lights of a glTF count for equivalence.
///
/// samples  points on each surface for the distances
/// cost     O(n log n); deterministic
Comparison compare(const Model& a, const Model& b, std::size_t samples = 200'000);

}  // namespace pstrips::inline converters
