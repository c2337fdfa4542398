#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progressive_strips.h"
#include "formats/pstrip/container/header.h"
#include "formats/pstrip/payload/geometry.h"

namespace pstrips::inline formats {

/// Memory for the lists of meshes before what fills them is there: as much as the bytes of the file
/// can justify, all meshes together. What is not reserved grows as it is read.
class Reservation {
 public:
  Reservation() = default;
  /// rows    of PIDX: first one a mesh, then the packets; their meshes are in range
  /// budget  bytes that may be reserved
  Reservation(std::span<const IndexRow> rows, std::size_t meshes, std::uint64_t budget);

  /// vsplits  that the packets bring to the mesh
  /// cost     O(attributes)
  void reserve(ProgressiveMesh& mesh, Index index, std::uint64_t vsplits,
               const GeometryCodec& codec);

 private:
  struct Packets {
    std::uint64_t count = 0, payload_bytes = 0;
  };
  std::vector<Packets> packets_;  // of each mesh
  std::uint64_t budget_ = 0;
};

}  // namespace pstrips::inline formats
