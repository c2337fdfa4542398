#pragma once

#include <vector>

#include "core/notes.h"
#include "formats/gltf/fit.h"

namespace pstrips::inline formats::gltf {

/// Changes the values of attributes that glTF forbids. [glTF 2.0 §3.7.2.1]
///
/// NaN and infinity  become 0 (1 in colours); an attribute of nothing else is left out
/// NORMAL            of unit length; where it has none it is computed from the faces at the wedge,
///                   and where no face gives a direction it is 0 0 1, which nothing shows; left out
///                   when no wedge had one
/// TANGENT           of unit length, its sign 1 or -1; left out when one has no direction or the
///                   mesh has no normals
/// COLOR_n           from 0 to 1
/// WEIGHTS_n         of the sum 1; left out with JOINTS_n when that cannot be, or one lacks the
/// other
///
/// What came from glTF is changed in NaN and infinity only: its bits return, and what is wrong with
/// them is said. Precondition: positions are finite. Cost O(size)
void mend_values(const Mesh& mesh, bool from_gltf, std::vector<Fitted>& attributes, Notes& notes);

}  // namespace pstrips::inline formats::gltf
