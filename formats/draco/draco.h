#pragma once

#include <vector>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/result.h"

namespace pstrips::inline formats {

/// What a Draco attribute is for, as its file says.
enum class DracoMeaning : std::uint8_t { position, normal, color, texcoord, generic };

struct DracoAttribute {
  std::uint32_t id = 0;  ///< unique in the payload; glTF names attributes by it
  DracoMeaning meaning = DracoMeaning::generic;
  Attribute values;  ///< one element a point; without a name
};

/// Points, their attributes, and triangles over them; none of a point cloud.
struct DracoGeometry {
  Index points = 0;
  std::vector<Index> triangles;  ///< corners, all below `points`
  std::vector<DracoAttribute> attributes;
};

/// Decodes a Draco payload: a .drc file, or what glTF embeds. The library's exceptions end here.
///
/// The counts in the payload are compared with `limits` before the library sees it, since it
/// allocates by them.
///
/// errors  corrupt, truncated, over_limit; unsupported for another version of the bitstream
/// cost    O(size of the result)
Result<DracoGeometry> decode_draco(ByteView payload, const Limits& limits = {});

}  // namespace pstrips::inline formats
