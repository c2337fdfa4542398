#pragma once

#include <vector>

#include "formats/gltf/accessors.h"

namespace pstrips::inline formats::gltf {

/// Where the primitives of the file stand in the model, for the way back.
struct PrimitiveMap {
  struct Place {
    Index mesh = kNone, group = kNone;  ///< kNone: without positions, so in no mesh
  };
  std::vector<std::vector<Place>> meshes;  ///< the primitives of each glTF mesh
  struct Layout {
    Index targets = 0;              ///< morph targets, empty ones included
    std::vector<std::string> mat2;  ///< attributes of four components that are MAT2, not VEC4
  };
  std::vector<Layout> layouts;  ///< of each of the model's meshes

  Bytes write() const;
  static Result<PrimitiveMap> read(ByteView bytes);
  /// Whether every group of every mesh is the place of exactly one primitive, and
  /// no primitive stands elsewhere.
  bool fits(const std::vector<Mesh>& model) const;
};

/// Makes the model's meshes out of the document's, as gltf.h says.
Result<PrimitiveMap> read_meshes(Data& data, const Document& document, const Limits& limits,
                                 Budget& budget, std::vector<Mesh>& out,
                                 std::vector<std::string>& dropped);

}  // namespace pstrips::inline formats::gltf
