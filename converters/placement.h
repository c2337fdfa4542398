#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline converters {

/// Whether the scene shows each of so many meshes once and where it stands, so that nodes say no
/// more than names.
///
/// errors  as place_meshes()
Result<bool> is_placed(const Scene& scene, std::size_t meshes);

/// A model without nodes whose meshes stand where the nodes of `model` show them, for formats that
/// have no nodes; nothing when is_placed().
///
/// Each place of a mesh becomes a mesh, in the order of the nodes; where that gives a mesh several
/// times, each has its node's name, made unique. Positions become f64; a matrix that leaves a mesh
/// where it is changes no bit of it. Normals are turned by the inverse transpose and keep their
/// length, tangents by the matrix; polygons that a matrix mirrors are wound the other way. Of a
/// glTF the default scene is placed, its instances included.
///
/// converted  receives what was applied
/// dropped    receives what is shown nowhere, or at places that are no numbers
/// errors     over_limit when the places would take more than `limits` grant; corrupt for instances
///            of a glTF that do not hold together
/// cost       O(size of the result)
Result<std::optional<Model>> place_meshes(const Model& model, const Limits& limits,
                                          std::vector<std::string>& converted,
                                          std::vector<std::string>& dropped);

}  // namespace pstrips::inline converters
