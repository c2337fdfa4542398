#pragma once

#include <array>
#include <cstddef>

#include "core/mesh.h"

namespace pstrips::inline formats {

using Digest = std::array<std::byte, 32>;

/// SHA-256 over the canonical bytes of a fully decoded mesh, in decoded numbering. Two meshes have
/// the same digest when they agree bit for bit in all but names, groups' names and materials; the
/// short and the long form of an optional list count as the same. [spec/model.md §8]
///
/// cost  O(size); constant extra memory
Digest digest(const Mesh& decoded);

}  // namespace pstrips::inline formats
