#pragma once

#include <cstdint>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/result.h"

namespace pstrips::inline converters {

/// How much work a mesh is.
struct WorkSize {
  std::uint64_t vertices = 0, wedges = 0;
  std::uint64_t triangles = 0;          ///< that its polygons are cut into, at most
  std::uint64_t attribute_numbers = 0;  ///< of a wedge
};

WorkSize work_size(const Mesh& mesh);

/// Bytes that encoding takes at its peak besides the mesh, as measured with the dearest placement
/// and metric; the default ones take two thirds.
std::uint64_t encoding_bytes(const WorkSize& size);

/// Whether a mesh of that size can be encoded: its triangles' corners can be counted with an index,
/// and encoding_bytes() are granted.
///
/// errors  over_limit, with the figure that does not fit
Result<void> check_capacity(const WorkSize& size, std::uint64_t memory_bytes);

/// Bytes that stripifying alone takes besides the mesh, as measured with the algorithm `best`.
std::uint64_t stripping_bytes(const WorkSize& size);

/// The same question for stripifying a mesh.
Result<void> check_stripping_capacity(const WorkSize& size, std::uint64_t memory_bytes);

}  // namespace pstrips::inline converters
