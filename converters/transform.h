#pragma once

#include "core/matrix4.h"
#include "core/mesh.h"

namespace pstrips::inline converters {

/// Moves a mesh by an affine matrix, as place_meshes() says: positions, normals, tangents, morph
/// targets, and the winding where the matrix mirrors. The identity changes no bit, a translation
/// nothing but positions. Precondition: the matrix is finite. Cost O(size)
void transform(Mesh& mesh, const Matrix4& matrix);

}  // namespace pstrips::inline converters
